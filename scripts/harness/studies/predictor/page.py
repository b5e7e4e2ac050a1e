"""The page of models without and with the predictor: docs/evidence/predictor.md, from docs/data/predictor.csv."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from harness.pages.evidence import DATA, EvidencePage
from harness.studies import files
from harness.studies.predictor import paired_models, summary_table
from harness.studies.predictor.paired_models import Took

SOURCE = "predictor.csv"


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    pairs = paired_models.pairs(files.read_csv(DATA / SOURCE, Took))
    return {"summary": summary_table.summary(pairs), "table": summary_table.table(pairs)}


PAGE = EvidencePage("evidence/predictor.md", (SOURCE,), Path(__file__).with_name("page.md"), figures)
