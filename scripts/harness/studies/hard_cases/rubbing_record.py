"""One hard case of friction on one mesh: how it ends, its checks, and the same scene without friction beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from harness.errors import HarnessError
from harness.post.compare import Measure
from harness.run import diagnosis
from harness.run.runner import Runner, RunResult
from harness.studies.hard_cases import invariants
from harness.studies.hard_cases.rubbing import CASES
from harness.studies.hard_cases.scene import Fineness, Interface

MOST_ITERATIONS = 1.3
"""Newton iterations with friction over those without."""
BALANCE = 1e-12
"""By how much more the flows of the two sides may be out of balance than without friction."""


@dataclass(frozen=True)
class Count:
    """How a run went.

    Attributes
    ----------
    ended : bool
    steps, iterations, retries : int
    failures : str
        How attempts failed.
    """

    ended: bool
    steps: int
    iterations: int
    retries: int
    failures: str


@dataclass(frozen=True)
class Record:
    """What came of a case on one mesh.

    Attributes
    ----------
    case, mesh : str
    friction, frictionless : Count
        With sliding-mixture.
    febio : dict of str to Count
        With FEBio's friction, by interface.
    costs : list of Measure
        Iterations and retries beside those without friction.
    measures : list of Measure
        Balances, and what the scene asks for.
    """

    case: str
    mesh: str
    friction: Count
    frictionless: Count
    febio: dict[str, Count]
    costs: list[Measure]
    measures: list[Measure]

    @property
    def passed(self) -> bool:
        """Whether it ends with friction, and all checks are met."""
        checks = [*self.costs, *self.measures]
        return self.friction.ended and bool(checks) and all(measure.passed for measure in checks)

    @property
    def beats_febio(self) -> bool:
        """Whether it takes no more iterations than each of FEBio's runs that ends."""
        most = [count.iterations for count in self.febio.values() if count.ended]
        return self.friction.ended and all(self.friction.iterations <= each for each in most)


def make(runner: Runner, name: str, mesh: Fineness, febio: Sequence[Interface] = ()) -> Record:
    """Run a case with friction and without, and with FEBio's.

    Raises
    ------
    HarnessError
        For an unknown case, or without an engine or plugin.
    """
    if name not in CASES:
        raise HarnessError(f"'{name}' is no hard case of friction; there is {', '.join(CASES)}")
    case = CASES[name]
    run = runner(case.scene.model(mesh, Interface.MIXTURE), check=False)
    plain = runner(case.frictionless.model(mesh, Interface.MIXTURE), check=False)
    others = {each.value: _count(runner(case.scene.model(mesh, each), check=False)) for each in febio}
    both = run.report.normal and plain.report.normal
    measures = [*_balances(run, plain), *case.scene.bounds(run)] if both else []
    return Record(name, mesh.value, _count(run), _count(plain), others, _costs(run, plain) if both else [], measures)


def _count(run: RunResult) -> Count:
    report = run.report
    return Count(report.normal, report.steps, report.iterations, report.retries, diagnosis.summary(run.log))


def _costs(run: RunResult, plain: RunResult) -> list[Measure]:
    """Iterations and retries beside those of the same scene without friction."""
    own, other = run.report, plain.report
    ratio, note = own.iterations / other.iterations, f"{own.iterations}, without friction {other.iterations}"
    return [
        Measure("iterations over those without friction", ratio, MOST_ITERATIONS, note=note),
        Measure("retries more than without friction", float(own.retries - other.retries), 0.0),
    ]


def _balances(run: RunResult, plain: RunResult) -> list[Measure]:
    """Balances beside those of the same scene without friction."""
    (force, flow), (_, plain_flow) = invariants.cancellation(run), invariants.cancellation(plain)
    return [
        force,
        Measure("flows of both sides, sum, more than without friction", flow.value - plain_flow.value, BALANCE),
        *invariants.finite_and_bounded(run, 2.0)[:1],
        *invariants.mass(run),
    ]


def table(records: Sequence[Record]) -> str:
    """A Markdown table: a row for each case and mesh."""
    others = list(dict.fromkeys(name for record in records for name in record.febio))
    heads = ["case", "mesh", "friction", "without", *others, "misses"]
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    for record in records:
        cells = [_cell(record.friction), _cell(record.frictionless)]
        cells += [_cell(record.febio[name]) if name in record.febio else "" for name in others]
        lines.append(f"| {CASES[record.case].about} | {record.mesh} | {' | '.join(cells)} | {_missed(record)} |")
    return "\n".join(lines)


def line(record: Record) -> str:
    """A record in a line: steps / iterations / retries with friction and without, and what it misses."""
    result = "passes" if record.passed else f"misses {_missed(record)}" if record.friction.ended else "fails"
    return f"{record.case}, {record.mesh}: {result}; {_cell(record.friction)}, without {_cell(record.frictionless)}"


def _missed(record: Record) -> str:
    checks = [*record.costs, *record.measures]
    return "; ".join(f"{m.name} {m.value:.2g} ({m.tolerance:.2g})" for m in checks if not m.passed)


def _cell(count: Count) -> str:
    """Steps / iterations / retries, or how it failed."""
    numbers = f"{count.steps} / {count.iterations} / {count.retries}"
    return numbers if count.ended else f"fails, {numbers}"
