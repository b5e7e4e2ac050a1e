"""One hard case of friction on one mesh: how it ends, its checks, and the same scene without friction beside it."""

from collections.abc import Sequence
from dataclasses import dataclass

from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from studies import diagnosis
from studies.hard_cases import invariants, record
from studies.hard_cases.outcomes import Attempt, Outcome
from studies.hard_cases.rubbing import CASES
from studies.hard_cases.scene import Fineness, Interface

MOST_ITERATIONS = 1.3  # Newton iterations with friction over those without
BALANCE = 1e-12  # by how much more the flows of the two sides may be out of balance than without friction
FRICTIONLESS = "sliding-mixture, no friction"
"""What joins the bodies in the scene without friction, as a table calls it."""


@dataclass(frozen=True)
class Record:
    """What came of a case on one mesh."""

    friction: Attempt
    frictionless: Attempt  # with sliding-mixture
    febio: list[Attempt]  # with FEBio's friction
    failures: str  # how attempts at steps failed with friction
    costs: list[Measure]  # iterations and retries beside those without friction
    measures: list[Measure]  # balances, and what the scene asks for

    @property
    def passed(self) -> bool:
        """Whether it ends with friction, and all checks are met."""
        checks = [*self.costs, *self.measures]
        return self.friction.ended and bool(checks) and all(measure.passed for measure in checks)

    @property
    def missed(self) -> str:
        """The checks that are not met."""
        return "; ".join(record.short(m) for m in [*self.costs, *self.measures] if not m.passed)

    @property
    def outcomes(self) -> list[Outcome]:
        """The record as rows of a table: what is checked is the run with friction."""
        others = [Outcome(**vars(each), missed="") for each in (self.frictionless, *self.febio)]
        return [Outcome(**vars(self.friction), missed=self.missed), *others]

    @property
    def line(self) -> str:
        """Steps / iterations / retries with friction and without, and what it misses."""
        result = "passes" if self.passed else f"misses {self.missed}" if self.friction.ended else self.failures
        counts = f"{self.friction.counts}, without {self.frictionless.counts}"
        return f"{self.friction.case}, {self.friction.mesh}: {result}; {counts}"


def make(runner: Runner, name: str, mesh: Fineness, febio: Sequence[Interface] = ()) -> Record:
    """Run a case with friction and without, and with FEBio's.

    Raises EngineNotFoundError, PluginNotFoundError: see `harness.run.engine`.
    """
    case = CASES[name]
    run = runner(case.scene.model(mesh, Interface.MIXTURE), check=False)
    plain = runner(case.frictionless.model(mesh, Interface.MIXTURE), check=False)
    theirs = {each.value: runner(case.scene.model(mesh, each), check=False) for each in febio}
    both = run.report.normal and plain.report.normal
    return Record(
        record.attempt(name, mesh, Interface.MIXTURE.value, run),
        record.attempt(name, mesh, FRICTIONLESS, plain),
        [record.attempt(name, mesh, interface, each) for interface, each in theirs.items()],
        diagnosis.summary(run.log),
        _costs(run, plain) if both else [],
        [*_balances(run, plain), *case.scene.bounds(run)] if both else [],
    )


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
