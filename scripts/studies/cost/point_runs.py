"""Runs one point of the sweep: its error, and its cost in iterations, residuals and time."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from harness.indentation.histories import curves
from harness.models.document import Model
from harness.models.interface import InterfaceType
from harness.models.parts import Param
from harness.post import compare
from harness.run.runner import Runner, RunResult
from harness.validate import checks
from studies import timing
from studies.cost.points import TIMES_33, Parameter, Point, Problem, finest

PAIRS = 3
"""How often a run of 3.1 or 3.2 and that of the conforming reference are timed, in turn, and a short run of 3.3."""


@dataclass(frozen=True)
class Datum:
    """What came of a point."""

    problem: str
    interface: str
    parameter: str
    value: float
    ended: bool
    contact_error: float
    """3.1, 3.2: largest difference of c from the conforming reference of the same mesh and steps, relative to c*; nan
    for 3.3."""
    error: float
    """3.1, 3.2: largest error of c against the closed form, relative to c*. 3.3: largest relative difference from the
    finest run, of the force and of the solute in both bodies at 1 and 100 s."""
    steps: int
    iterations: int
    residuals: int
    retries: int
    wall: float
    cpu: float
    """Wall and processor time of one thread, s; medians of some runs, of 3.3 the wall time of one. On an idle machine
    they agree."""
    cpu_low: float
    cpu_high: float
    """Least and largest of the processor times of 3.3, s, of one run where that is not short; nan for 3.1 and 3.2."""
    ratio: float
    ratio_low: float
    ratio_high: float
    """Median, least and largest of the ratios of this run's processor time and the conforming reference's, run in turn;
    nan for 3.3."""


def measure(points: Sequence[Point], runner: Runner) -> list[Datum]:
    """Run points and what they are compared with; short runs of 3.3 are repeated in turn.

    Raises HarnessError without an engine or plugin, or where the reference does not run.
    """
    runs = {point: runner(point.model(), check=False) for point in points}
    whole = {p: run for p, run in runs.items() if p.problem is Problem.INDENTATION and run.report.normal}
    times = timing.in_turn(whole, PAIRS)
    return [_datum(point, run, times.get(point, [run.cpu]), runner) for point, run in runs.items()]


def _datum(point: Point, run: RunResult, times: Sequence[float], runner: Runner) -> Datum:
    ended, contact_error, error, ratios = run.report.normal, math.nan, math.nan, (math.nan,) * 3
    wall, (cpu, cpu_low, cpu_high) = run.wall, timing.spread(times)
    if point.problem is not Problem.INDENTATION:
        cpu_low = cpu_high = math.nan
    if ended and point.problem is Problem.INDENTATION:
        error = _error_33(run, runner(finest()))
    elif ended:
        reference = runner(point.model(InterfaceType.CONFORMING))
        contact_error = compare.largest_difference(run, reference, "c1")
        error = _error_closed(point, run)
        wall, cpu, ratios = _pairs(run.model, reference.model)
    setting = (point.problem.value, point.interface.value, point.parameter.value, point.value)
    report = run.report
    counts = (report.steps, report.iterations, report.residuals, report.retries)
    return Datum(*setting, ended, contact_error, error, *counts, wall, cpu, cpu_low, cpu_high, *ratios)


def _error_closed(point: Point, run: RunResult) -> float:
    if point.problem is Problem.CONVECTION:
        return compare.error_at(run, "c1", checks.exact_convection(run, 1))
    return compare.error_at(run, "c1", checks.exact_diffusion(run, float(run.nodes.times[-1])))


def _error_33(run: RunResult, reference: RunResult) -> float:
    own, best = curves(run), curves(reference)
    errors = []
    for time in TIMES_33:
        i, j = run.nodes.at(time), reference.nodes.at(time)
        errors.append(own.force[i] / best.force[j] - 1.0)
        errors += [(a[i] - b[j]) / best.slab[0] for a, b in ((own.slab, best.slab), (own.cylinder, best.cylinder))]
    return float(np.max(np.abs(errors)))


def _pairs(model: Model, reference: Model) -> tuple[float, float, tuple[float, float, float]]:
    """Median wall and processor time (s) of a model; median, least, largest ratio of the latter to its reference's."""
    own, others = timing.interleave({"own": model, "reference": reference}, PAIRS).values()
    walls, times = (run.wall for run, _ in own), (run.cpu for run, _ in own)
    return median(walls), median(times), timing.spread(timing.ratios(own, others))


def settings_of(datum: Datum) -> tuple[Param, ...]:
    """The parameters of the contact that a datum was measured with."""
    return Point(
        Problem(datum.problem), InterfaceType(datum.interface), Parameter(datum.parameter), datum.value
    ).settings.params()
