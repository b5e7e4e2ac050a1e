"""The page of models without and with the predictor: docs/evidence/predictor.md, from docs/data/predictor.csv."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from studies import files
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.scene import Fineness
from studies.pages.evidence import DATA, EvidencePage
from studies.predictor import paired_models, summary_table
from studies.predictor.paired_models import Took

SOURCE = "predictor.csv"


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    pairs = paired_models.pairs(files.read_csv(DATA / SOURCE, Took))
    return {
        "summary": summary_table.summary(pairs),
        "missing": _missing({pair.name for pair in pairs}),
        "most": f"{paired_models.MOST}",
    }


def _missing(measured: set[str]) -> str:
    """Models that the data lack; hard cases by their mesh where they lack all of them."""
    lacking = [name for name, _ in paired_models.known_models(list(Fineness)) if name not in measured]
    fine = [name for name in lacking if name.endswith(f", {Fineness.FINE.value}")]
    whole = len(fine) == len(CASES)
    named = [f"`{name}`" for name in lacking if not (whole and name in fine)]
    told = [*named, *(["hard cases on the fine mesh"] if whole else [])]
    return f"The data do not include {' and '.join(told)}." if told else "The data have all others."


PAGE = EvidencePage("evidence/predictor.md", (SOURCE,), Path(__file__).with_name("page.md"), figures)
