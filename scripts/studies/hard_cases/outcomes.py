"""How runs of hard cases ended, as rows of a table, and what the table says."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from studies import tables

HEADINGS = {
    "sliding-mixture": "`sliding-mixture`",
    "sliding-mixture-predictor": "with `predictor` 1",
    "febio-1": "FEBio, factor 1",
    "febio-1000": "FEBio, factor 1000",
}
"""Interfaces, as tables call them."""
OURS = "sliding-mixture"
FEBIO = ("febio-1", "febio-1000")


class End(str, Enum):
    """How a run ended."""

    PASSES = "passes all checks"
    MISSES = "completes, misses checks"
    FAILS = "fails"
    LIMIT = "stopped by the limit"


@dataclass(frozen=True)
class Attempt:
    """A case that was run on one mesh with one interface."""

    case: str
    mesh: str
    interface: str
    ended: bool  # whether the run ended normally
    reached: float  # part of the case's time that was reached
    limited: bool  # whether the limit ended it
    # Iterations and residuals are 0 where FEBio wrote no summary.
    steps: int
    iterations: int
    residuals: int
    retries: int

    @property
    def counts(self) -> str:
        """Steps / iterations / steps tried again; of a run that did not end the part of its time that it reached."""
        numbers = f"{self.steps} / {self.iterations} / {self.retries}"
        why = "limit" if self.limited else "fails"
        return numbers if self.ended else f"{why} at {100.0 * self.reached:.0f} %"


@dataclass(frozen=True)
class Outcome(Attempt):
    """An attempt as a row of the table."""

    missed: str  # checks that it misses, with semicolons between them

    @property
    def end(self) -> End:
        """How it ended."""
        if self.ended:
            return End.MISSES if self.missed else End.PASSES
        return End.LIMIT if self.limited else End.FAILS

    @property
    def short(self) -> str:
        """Iterations, with retries in brackets; of a run that did not end the part of its time that it reached."""
        if not self.ended:
            return f"to {100.0 * self.reached:.0f} %"
        return f"{self.iterations} ({self.retries})" if self.retries else f"{self.iterations}"


_MARKS = {End.PASSES: "", End.MISSES: "misses: ", End.FAILS: "fails: ", End.LIMIT: "limit: "}
Table = dict[tuple[str, str], dict[str, Outcome]]  # by case and mesh, then by interface


def arranged(outcomes: Sequence[Outcome]) -> Table:
    """Outcomes by case and mesh, in the order in which they come."""
    rows = tables.grouped(outcomes, lambda outcome: (outcome.case, outcome.mesh))
    return {key: {outcome.interface: outcome for outcome in row} for key, row in rows.items()}


def summary(outcomes: Sequence[Outcome]) -> str:
    """A Markdown table: how many runs end in which way, and the steps tried again, for each interface."""
    columns = ("interface", "runs", *(end.value for end in End), "repeated steps")
    rows = []
    for interface, heading in HEADINGS.items():
        own = [outcome for outcome in outcomes if outcome.interface == interface]
        ends = [sum(outcome.end is end for outcome in own) for end in End]
        rows.append((heading, len(own), *ends, sum(outcome.retries for outcome in own)))
    return tables.markdown(columns, rows)


def better(row: dict[str, Outcome]) -> list[Outcome]:
    """FEBio's runs that pass where ours does not, or pass with fewer iterations or fewer steps tried again."""
    ours = row.get(OURS)
    if ours is None:
        return []
    passing = [row[name] for name in FEBIO if name in row and row[name].end is End.PASSES]
    return [
        run
        for run in passing
        if ours.end is not End.PASSES or run.iterations < ours.iterations or run.retries < ours.retries
    ]


def table(outcomes: Sequence[Outcome], about: dict[str, str]) -> str:
    """A Markdown table: a row for each case and mesh, and where FEBio's interface is better."""
    heads = ["case", "mesh", *HEADINGS.values(), "better in FEBio's"]
    rows = []
    for (case, mesh), row in arranged(outcomes).items():
        cells = [f"{_MARKS[row[name].end]}{row[name].short}" if name in row else "not run" for name in HEADINGS]
        best = ", ".join(f"{run.short} with {HEADINGS[run.interface].split(', ')[1]}" for run in better(row))
        rows.append((about[case], mesh, *cells, best))
    return tables.markdown(heads, rows)
