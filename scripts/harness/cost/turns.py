"""Longer runs of 3.1 and 3.2 by all interfaces in turn, whose ratios of processor time stand out of the scatter."""

from __future__ import annotations

import math
import re
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from statistics import median, quantiles

from harness import compare, engine
from harness.cost.measure import Datum, execute
from harness.cost.points import INTERFACES, Knob, Point, Problem
from harness.cost.report import LEVELS, cheapest, comparable
from harness.models.interface import Join
from harness.runner import Runner

WIDTHS = {Problem.DIFFUSION: 6, Problem.CONVECTION: 8}
"""Elements along x and y of the cubes: a run takes some seconds."""
_COUNT = re.compile(r"refs:\s+([\d,]+)")


@dataclass(frozen=True)
class Timing:
    """One run.

    Attributes
    ----------
    problem, interface, knob : str
    value : float
    turn : int
        From 1; 0 for a run of the sweep's size whose instructions were counted.
    contact_error : float
        Largest difference of c from the unsplit body, relative to the bath.
    iterations, residuals : int
    cpu : float
        Processor time of one thread, s.
    instructions : float
        Instructions executed, which do not scatter; nan where they were not counted.
    """

    problem: str
    interface: str
    knob: str
    value: float
    turn: int
    contact_error: float
    iterations: int
    residuals: int
    cpu: float
    instructions: float

    @property
    def setting(self) -> tuple[str, str, float]:
        """What was set in which interface."""
        return (self.interface, self.knob, self.value)


def contenders(data: Sequence[Datum], problem: Problem) -> list[Point]:
    """The unsplit body; ours without and with extrapolation; and what reached each error at the least cost."""
    own = comparable(data, problem)
    best = (cheapest([d for d in own if d.interface == i.value], e) for i in INTERFACES for e in LEVELS)
    chosen = [(Join.UNSPLIT, Knob.DEFAULT, 0.0)]
    chosen += [(Join.MIXTURE, Knob.EXTRAPOLATION, on) for on in (0.0, 1.0)]
    chosen += [(Join(d.interface), Knob(d.knob), d.value) for d in best if d]
    return [Point(problem, *one) for one in dict.fromkeys(chosen)]


def turn(points: Sequence[Point], number: int, runner: Runner) -> list[Timing]:
    """Time each point once on a wide mesh, one after the other.

    Raises
    ------
    HarnessError
        Without an engine or plugin, or where a run fails.
    """
    wide = [replace(point, width=WIDTHS[point.problem]) for point in points]
    return [_timed(point, number, execute(point.model(), runner.timeout), runner) for point in wide]


def count(points: Sequence[Point], runner: Runner) -> list[Timing]:
    """Count the instructions of each point on the mesh of the sweep; nothing without valgrind."""
    tool = shutil.which("valgrind")
    if tool is None:
        return []
    prefix = [tool, "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    return [_timed(point, 0, execute(point.model(), None, prefix), runner) for point in points]


def _timed(point: Point, number: int, run: engine.Run, runner: Runner) -> Timing:
    error = compare.largest_difference(runner(point.model()), runner(point.model(Join.UNSPLIT)), "c1")
    counted = _COUNT.search(run.output)
    return Timing(
        point.problem.value,
        point.interface.value,
        point.knob.value,
        point.value,
        number,
        error,
        run.report.iterations,
        run.report.residuals,
        run.cpu,
        float(counted[1].replace(",", "")) if counted else math.nan,
    )


def ratio_table(timings: Sequence[Timing]) -> str:
    """A Markdown table: our processor time over that of FEBio's faster interface, as accurate, run in the same turn.

    Medians, with quartiles in brackets; then the same ratio of instructions.
    """
    lines = [
        "| problem | error | the faster of FEBio's | ours | iterations | ratio of times | ratio of instructions |",
        "|---|---|---|---|---|---|---|",
    ]
    for problem in dict.fromkeys(t.problem for t in timings):
        own = [t for t in timings if t.problem == problem and t.interface != Join.UNSPLIT.value]
        lines += [
            row for error in LEVELS for row in _rows(problem, error, [t for t in own if t.contact_error <= error])
        ]
    return "\n".join(lines)


def _rows(problem: str, error: float, good: Sequence[Timing]) -> Iterator[str]:
    """A row for each setting of ours that is good enough, beside the best of FEBio's; none where there is none."""
    ours = dict.fromkeys(t.setting for t in good if t.interface == Join.MIXTURE.value)
    theirs = dict.fromkeys(t.setting for t in good if t.interface != Join.MIXTURE.value)
    if not theirs:
        return
    best = min(theirs, key=lambda setting: median(times(good, setting).values()))
    fewest = min(instructions(good, setting) for setting in theirs)
    for setting in ours:
        low, middle, high = ratios(good, setting, best)
        counted = instructions(good, setting) / fewest
        yield (
            f"| {problem} | {error:.0e} | {_told(best)}: {iterations(good, best)} | {_told(setting)} | "
            f"{iterations(good, setting)} | {middle:.3f} [{low:.3f}, {high:.3f}] | {counted:.3f} |"
        )


def times(timings: Sequence[Timing], setting: tuple[str, str, float]) -> dict[int, float]:
    """Processor time (s) of a setting by turn."""
    return {t.turn: t.cpu for t in timings if t.setting == setting and t.turn > 0}


def ratios(
    timings: Sequence[Timing], ours: tuple[str, str, float], theirs: tuple[str, str, float]
) -> tuple[float, float, float]:
    """Quartiles of the ratio of processor times in the turns that both were run in; needs two of them."""
    own, other = times(timings, ours), times(timings, theirs)
    low, middle, high = quantiles((own[n] / other[n] for n in own if n in other), n=4, method="inclusive")
    return low, middle, high


def instructions(timings: Sequence[Timing], setting: tuple[str, str, float]) -> float:
    """Instructions of a setting; nan where they were not counted."""
    return next((t.instructions for t in timings if t.setting == setting and t.turn == 0), math.nan)


def iterations(timings: Sequence[Timing], setting: tuple[str, str, float]) -> int:
    """Iterations of a setting."""
    return next(t.iterations for t in timings if t.setting == setting)


def _told(setting: tuple[str, str, float]) -> str:
    interface, knob, value = setting
    what = knob if knob == Knob.DEFAULT.value else f"{knob} {value:g}"
    return what if interface == Join.MIXTURE.value else f"`{interface}`, {what}"
