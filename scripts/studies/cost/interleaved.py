"""Longer runs of 3.1 and 3.2 by all interfaces, interleaved: ratios of processor time above the scatter."""

from __future__ import annotations

import math
import re
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from statistics import quantiles

from harness.models.interface import InterfaceType
from harness.post import compare
from harness.run import engine
from harness.run.runner import Runner
from studies.cost.pareto import LEVELS, comparable, error_of
from studies.cost.point_runs import Datum
from studies.cost.points import INTERFACES, Parameter, Point, Problem, Size
from studies.timing import execute

PROBLEMS = (Problem.DIFFUSION, Problem.CONVECTION)


class Kind(str, Enum):
    """Sizes of the problems."""

    SHORT = "short"
    """That of the sweep; its instructions are counted."""
    COLUMN = "column"
    """One facet in contact, many elements and steps."""
    WIDE = "wide"
    """Many facets in contact."""


SIZES = {Kind.SHORT: Size(), Kind.COLUMN: Size(elements=20, steps=100), Kind.WIDE: Size(width=4)}
"""Runs of the two that are timed take ten times as long as those of the sweep."""
OTHERWISE = ((Parameter.DEFAULT, 0.0), (Parameter.PREDICTOR, 1.0), (Parameter.INTEGRATION, 0.0))
"""Settings of ours that are always timed."""
_COUNT = re.compile(r"refs:\s+([\d,]+)")


Setting = tuple[str, str, float]
"""Interface, parameter and value."""


@dataclass(frozen=True)
class Timing:
    """One run.

    Attributes
    ----------
    problem, interface, parameter : str
    value : float
    size : str
        Value of `Kind`.
    round : int
        From 1; 0 where instructions were counted.
    contact_error : float
        Largest difference of c from the conforming reference, relative to c*; nan for a run that failed.
    iterations, residuals : int
    cpu : float
        Processor time of one thread, s.
    instructions : float
        Instructions executed, which do not scatter; nan where they were not counted.
    """

    problem: str
    interface: str
    parameter: str
    value: float
    size: str
    round: int
    contact_error: float
    iterations: int
    residuals: int
    cpu: float
    instructions: float

    @property
    def setting(self) -> Setting:
        """What was set in which interface."""
        return (self.interface, self.parameter, self.value)


def contenders(data: Sequence[Datum], problem: Problem) -> list[Point]:
    """The conforming reference; ours by default, with the predictor, with Gauss points; and what reached each error.

    Of settings that reached it the one that took the fewest iterations.
    """
    own = comparable(data, problem)
    best = (_fewest([d for d in own if d.interface == i.value], e) for i in INTERFACES for e in LEVELS)
    chosen = [(InterfaceType.CONFORMING, Parameter.DEFAULT, 0.0)]
    chosen += [(InterfaceType.MIXTURE, parameter, value) for parameter, value in OTHERWISE]
    chosen += [(InterfaceType(d.interface), Parameter(d.parameter), d.value) for d in best if d]
    return [Point(problem, *one) for one in dict.fromkeys(chosen)]


def _fewest(data: Sequence[Datum], error: float) -> Datum | None:
    good = [d for d in data if error_of(d) <= error]
    parameters = [parameter.value for parameter in Parameter]  # the first of those that are equal
    return min(good, key=lambda d: (d.iterations, d.residuals, parameters.index(d.parameter), d.value), default=None)


def one_round(points: Sequence[Point], kind: Kind, number: int, runner: Runner) -> list[Timing]:
    """Time each point once, one after the other.

    Raises
    ------
    HarnessError
        Without an engine or plugin, or where the conforming reference does not run.
    """
    sized = [replace(point, size=SIZES[kind]) for point in points]
    runs = [execute(point.model(), check=False, processor_limit=runner.processor_limit)[0] for point in sized]
    return [_timed(point, kind, number, run, runner) for point, run in zip(sized, runs, strict=True)]


def count(points: Sequence[Point], runner: Runner) -> list[Timing]:
    """Count the instructions of each point at the size of the sweep; nothing without valgrind."""
    tool = shutil.which("valgrind")
    if tool is None:
        return []
    prefix = [tool, "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    runs = [execute(point.model(), prefix, check=False)[0] for point in points]
    return [_timed(point, Kind.SHORT, 0, run, runner) for point, run in zip(points, runs, strict=True)]


def _timed(point: Point, kind: Kind, number: int, run: engine.Run, runner: Runner) -> Timing:
    kept, reference = runner(point.model(), check=False), runner(point.model(InterfaceType.CONFORMING))
    error = compare.largest_difference(kept, reference, "c1") if kept.report.normal else math.nan
    counted = _COUNT.search(run.output)
    return Timing(
        point.problem.value,
        point.interface.value,
        point.parameter.value,
        point.value,
        kind.value,
        number,
        error,
        run.report.iterations,
        run.report.residuals,
        run.cpu,
        float(counted[1].replace(",", "")) if counted else math.nan,
    )


def ratio_table(timings: Sequence[Timing]) -> str:
    """A Markdown table: our processor time over that of the faster of FEBio's, as accurate and run in the same round.

    Medians, with quartiles in brackets; beside them the ratio of the least costs, as other work on the machine can only
    add to a time. At the size of the sweep the ratio is one of instructions.
    """
    lines = [
        "| problem | size | errors | the best of FEBio's | ours | iterations | ratio | of the least |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for problem, size in dict.fromkeys((t.problem, t.size) for t in timings):
        own = [
            t
            for t in timings
            if (t.problem, t.size) == (problem, size) and t.interface != InterfaceType.CONFORMING.value
        ]
        reached: dict[str, list[float]] = {}  # the errors at which a row holds
        for error in LEVELS:
            for row in _rows([t for t in own if t.contact_error <= error]):
                reached.setdefault(row, []).append(error)
        lines += [f"| {problem} | {size} | {_range(errors)} | {row} |" for row, errors in reached.items()]
    return "\n".join(lines)


def _range(errors: Sequence[float]) -> str:
    return " to ".join(f"{error:.0e}" for error in dict.fromkeys((errors[0], errors[-1])))


def _rows(good: Sequence[Timing]) -> Iterator[str]:
    """For each setting of ours: the best of FEBio's, ours, iterations, ratio; none where FEBio's has none."""
    ours = dict.fromkeys(t.setting for t in good if t.interface == InterfaceType.MIXTURE.value)
    theirs = dict.fromkeys(t.setting for t in good if t.interface != InterfaceType.MIXTURE.value)
    if not theirs:
        return
    least = {setting: min(costs(good, setting).values()) for setting in (*ours, *theirs)}
    best = min(theirs, key=least.__getitem__)
    for setting in ours:
        low, middle, high = ratios(good, setting, best)
        spread = f" [{low:.3f}, {high:.3f}]" if high > low else ""
        ratio = f"{middle:.3f}{spread} | {least[setting] / least[best]:.3f}"
        yield " | ".join((_told(good, best), _told(good, setting, named=False), ratio))


def costs(timings: Sequence[Timing], setting: Setting) -> dict[int, float]:
    """By round, the processor time (s) of a setting; its instructions where they were counted."""
    return {t.round: t.cpu if math.isnan(t.instructions) else t.instructions for t in timings if t.setting == setting}


def ratios(timings: Sequence[Timing], ours: Setting, theirs: Setting) -> tuple[float, float, float]:
    """Quartiles of the ratio of costs in the rounds that both were run in."""
    own, other = costs(timings, ours), costs(timings, theirs)
    found = [own[n] / other[n] for n in own if n in other]
    low, middle, high = quantiles(found, n=4, method="inclusive") if len(found) > 1 else found * 3
    return low, middle, high


def _told(timings: Sequence[Timing], setting: Setting, *, named: bool = True) -> str:
    interface, parameter, value = setting
    iterations = next(t.iterations for t in timings if t.setting == setting)
    what = parameter if parameter == Parameter.DEFAULT.value else f"{parameter} {value:g}"
    return f"`{interface}`, {what}: {iterations} it." if named else f"{what} | {iterations}"
