"""The page of what friction costs: docs/evidence/friction.md, from docs/data/friction-cases.csv."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from harness.pages.evidence import DATA, EvidencePage
from harness.studies import files
from harness.studies.hard_cases.rubbing import CASES

SOURCE = "friction-cases.csv"


@dataclass(frozen=True)
class Row:
    """A scene with friction, and without it (``plain``): steps, Newton iterations, steps tried again."""

    case: str
    steps: int
    iterations: int
    retries: int
    plain_steps: int
    plain_iterations: int
    plain_retries: int

    @property
    def ratio(self) -> float:
        """Iterations with friction over those without."""
        return self.iterations / self.plain_iterations

    @property
    def line(self) -> str:
        """A row of the page's table."""
        counts = (f"{self.steps} / {self.iterations} / {self.retries}", f"{self.plain_steps} / {self.plain_iterations}")
        return f"| {CASES[self.case].about} | {counts[0]} | {counts[1]} / {self.plain_retries} | {self.ratio:.2f} |"


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    rows = files.read_csv(DATA / SOURCE, Row)
    more = sum(row.retries > row.plain_retries for row in rows)
    least, most = min(row.ratio for row in rows), max(row.ratio for row in rows)
    headline = (
        f"{len(rows)} scenes end with {least:.2f} to {most:.2f} times the iterations of the same scene without "
        f"friction. Scenes with more steps tried again than without: {more}."
    )
    return {"headline": headline, "table": "\n".join(row.line for row in rows)}


PAGE = EvidencePage("evidence/friction.md", (SOURCE,), Path(__file__).with_name("rubbing_page.md"), figures)
