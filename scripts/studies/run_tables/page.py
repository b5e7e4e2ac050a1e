"""The page with a row for each run of the pages of evidence: docs/reference/runs.md."""

from collections.abc import Mapping
from pathlib import Path

from studies import files
from studies.cost import page as cost
from studies.cost.point_runs import Datum
from studies.friction import curves, curves_table
from studies.friction import page as friction
from studies.hard_cases import outcomes
from studies.hard_cases import page as hard_cases
from studies.hard_cases.outcomes import Outcome
from studies.pages.evidence import DATA, EvidencePage

SOURCES = (hard_cases.SOURCE, cost.SOURCE, friction.CASES_SOURCE, friction.MODELS_SOURCE, curves_table.SOURCE)


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    return {
        "hard_cases": outcomes.table(files.read_csv(DATA / hard_cases.SOURCE, Outcome), hard_cases.ABOUT),
        **cost.tables(files.read_csv(DATA / cost.SOURCE, Datum)),
        **friction.tables(),
        **curves_table.spheres(files.read_csv(DATA / curves_table.SOURCE, curves.Row)),
    }


PAGE = EvidencePage("reference/runs.md", SOURCES, Path(__file__).with_name("page.md"), figures, compares_sources=False)
