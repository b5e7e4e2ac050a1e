"""Problem 3.3 in the configurations in which FEBio's own interfaces fail, run one after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from harness.models.indentation import END, Indentation
from harness.models.indentation_mesh import Primary
from harness.models.interface import ContactSettings, InterfaceType, automatic
from harness.run import febio_log
from harness.run.runner import Runner, RunResult
from studies import diagnosis

TIMEOUT = 180.0
"""s of wall time after which a run is ended."""


class Configuration(str, Enum):
    """What is changed in a run: the automatic penalties, two passes, the primary surface, AUGLAG (tolerance 0.05)."""

    PENALTY_1 = "penalty-1"
    TWO_PASS = "two-pass"
    SLAB = "slab-primary"
    PENALTY_10 = "penalty-10"
    AUGLAG = "auglag"

    @property
    def scale(self) -> float:
        """Common factor of the automatic penalties."""
        return 10.0 if self is Configuration.PENALTY_10 else 1.0

    @property
    def primary(self) -> Primary:
        """Which body has the primary surface."""
        return Primary.SLAB if self is Configuration.SLAB else Primary.CYLINDER

    def settings(self, scaled: bool = True) -> ContactSettings:
        """Parameters of the interface; without `scaled` the penalties are left to the interface."""
        base = automatic(self.scale) if scaled else ContactSettings()
        if self is Configuration.TWO_PASS:
            return replace(base, two_pass=True)
        if self is Configuration.AUGLAG:
            return replace(base, laugon="AUGLAG", tolerance=0.05)
        return base


@dataclass(frozen=True)
class Case:
    """One run of the table.

    Attributes
    ----------
    configuration : Configuration
    interface : InterfaceType
    module : str
    clamp : bool
        Whether negative concentrations are set to zero (always so in the module ``solute``).
    scaled : bool
        Whether FEBio's automatic penalties are used; otherwise the interface's own defaults.
    """

    configuration: Configuration
    interface: InterfaceType
    module: str
    clamp: bool = True
    scaled: bool = True

    @property
    def name(self) -> str:
        """Stem of the files."""
        parts = [self.interface.slug, self.module, self.configuration.value]
        parts += [] if self.clamp else ["unclamped"]
        return "-".join([*parts, *([] if self.scaled else ["default"])])

    def problem(self, base: Indentation) -> Indentation:
        """The problem of this case; all else as in `base`."""
        return replace(
            base,
            interface=self.interface,
            settings=self.configuration.settings(self.scaled),
            primary=self.configuration.primary,
            clamp=self.clamp,
            module=self.module,
            name=self.name,
        )


@dataclass(frozen=True)
class Row:
    """What came of a case: `reached` is the last time (s) with a converged step."""

    case: Case
    result: RunResult
    reached: float
    failures: str

    def line(self) -> str:
        """A row of a Markdown table."""
        report, case = self.result.report, self.case
        how = "done" if report.normal else f"fails at {self.reached:.3g} s"
        clamp = "yes" if case.clamp or case.module != "multiphasic" else "no"
        cells = (
            case.interface.value,
            case.module,
            clamp,
            case.configuration.value + ("" if case.scaled else ", default penalties"),
            how,
            str(report.steps),
            str(report.iterations),
            str(report.residuals),
            str(report.retries),
            f"{self.result.wall:.0f}",
            self.failures,
        )
        return "| " + " | ".join(cells) + " |"


HEADING = (
    "| interface | module | clamp | configuration | outcome | steps | iterations | residuals | retries | wall s | "
    "failed attempts |\n|---|---|---|---|---|---|---|---|---|---|---|"
)


def febio_cases(clamp: bool = True) -> list[Case]:
    """FEBio's two interfaces, each in its own module, in every configuration."""
    pairs = ((InterfaceType.MULTIPHASIC, "multiphasic"), (InterfaceType.SOLUTE, "solute"))
    return [
        Case(c, interface, module, clamp)
        for interface, module in pairs
        for c in Configuration
        if clamp or interface is InterfaceType.MULTIPHASIC
    ]


def mixture_cases(module: str, *, clamp: bool = True, scaled: bool = True) -> list[Case]:
    """The plugin's interface in every configuration; its default penalties know no penalty 10."""
    chosen = [c for c in Configuration if scaled or c is not Configuration.PENALTY_10]
    return [Case(c, InterfaceType.MIXTURE, module, clamp, scaled) for c in chosen]


def study(
    runner: Runner,
    cases: Sequence[Case],
    base: Indentation | None = None,
    finished: Callable[[Row], None] | None = None,
) -> list[Row]:
    """Run cases one after the other; set ``runner.timeout`` to bound each.

    Parameters
    ----------
    runner : Runner
    cases : sequence of Case
    base : Indentation, optional
        What the cases have in common.
    finished : callable, optional
        Called after each run.
    """
    rows = []
    for case in cases:
        rows.append(row(case, runner(case.problem(base or Indentation()).model(), check=False)))
        if finished:
            finished(rows[-1])
    return rows


def row(case: Case, result: RunResult) -> Row:
    """Reads the log of a run."""
    times = febio_log.CONVERGED.findall(result.log)
    reached = float(times[-1]) if times else 0.0
    if result.report.normal:
        reached = END
    return Row(case, result, reached, diagnosis.summary(result.log))


def table(rows: Iterable[Row]) -> str:
    """The rows as a Markdown table."""
    return "\n".join([HEADING, *(entry.line() for entry in rows)])
