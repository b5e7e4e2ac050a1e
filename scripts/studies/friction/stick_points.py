"""Elastic slip and time by tangential penalty and with AUGLAG."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from harness.models.interface import ContactSettings, InterfaceType, automatic
from harness.models.parts import Param
from harness.post import compare
from harness.run.runner import Runner, RunResult
from studies import files, tables, timing
from studies.cost import pareto
from studies.cost.points import AUGLAG_START
from studies.models.partial_slip import FRICTION as PARTIAL
from studies.models.partial_slip import PartialSlip
from studies.models.sheared_blocks import FRICTION as HIGH
from studies.models.sheared_blocks import SHEAR, Kind, ShearedBlocks
from studies.post import slip_zones
from studies.stamps import at_limit

SOURCE = "friction-cost.csv"  # below docs/data
PAIRS = 3  # how often a sheared block and its conforming reference are timed, in turn, and a short run of partial slip
ELEMENTS = 8  # over half the width of the contact in partial slip


class Problem(str, Enum):
    """What is measured."""

    STICK = "stick"  # a biphasic block, pressed and sheared, split: nothing should slip
    PARTIAL = "partial slip"  # a cylinder in partial slip: half-width of the zone that sticks


class Parameter(str, Enum):
    """What is varied."""

    DEFAULT = "default"
    TANGENTIAL = "tangential_penalty"
    PENALTY = "penalty factor"
    AUGLAG = "AUGLAG tolerance"


VALUES: dict[Parameter, tuple[float, ...]] = {
    Parameter.DEFAULT: (0.0,),
    Parameter.TANGENTIAL: (1e-3, 1e-2, 1.0, 10.0, 100.0),
    Parameter.PENALTY: (10.0, 100.0, 1e4),
    Parameter.AUGLAG: (1e-1, 1e-3, 1e-5, 1e-7),
}


@dataclass(frozen=True)
class Point:
    """One setting of one problem; in the stick problem with FEBio's interface, too."""

    problem: Problem
    interface: InterfaceType
    parameter: Parameter
    value: float

    @property
    def settings(self) -> ContactSettings:
        """Parameters of the contact."""
        friction = (Param("fric_coeff", HIGH if self.problem is Problem.STICK else PARTIAL),)
        return replace(self._penalties, extra=(*self._penalties.extra, *friction))

    @property
    def _penalties(self) -> ContactSettings:
        porous = self.problem is Problem.STICK
        if self.parameter is Parameter.TANGENTIAL:
            return ContactSettings(extra=(Param(Parameter.TANGENTIAL.value, self.value),))
        if self.parameter is Parameter.PENALTY:
            return _scaled(self.value, porous)
        if self.parameter is Parameter.AUGLAG:
            return replace(_scaled(AUGLAG_START, porous), laugon="AUGLAG", tolerance=self.value, maxaug=50)
        return ContactSettings() if self.interface is InterfaceType.MIXTURE else _scaled(1000.0, porous)

    def run(self, runner: Runner) -> RunResult:
        """Run it, or read back what an earlier run left."""
        name = f"friction-cost-{self.problem.name}-{self.interface.slug}-{self.parameter.name}-{self.value:g}".lower()
        if self.problem is Problem.PARTIAL:
            return runner(PartialSlip(ELEMENTS, settings=self.settings, name=name).model(), check=False)
        return runner(ShearedBlocks(Kind.BIPHASIC, self.interface, self.settings, name=name).model(), check=False)


def _scaled(factor: float, porous: bool) -> ContactSettings:
    """Automatic penalties, in a porous body of the pressure, too."""
    return replace(automatic(factor), concentration_penalty=None, pressure_penalty=factor if porous else None)


def points() -> list[Point]:
    """All settings."""
    own = [
        Point(problem, InterfaceType.MIXTURE, parameter, value)
        for problem in Problem
        for parameter, values in VALUES.items()
        for value in values
    ]
    theirs = [
        Point(Problem.STICK, InterfaceType.BIPHASIC, parameter, value)
        for parameter in (Parameter.DEFAULT, Parameter.PENALTY, Parameter.AUGLAG)
        for value in VALUES[parameter]
    ]
    return [*own, *theirs]


@dataclass(frozen=True)
class Datum:
    """What came of a setting."""

    problem: str
    interface: str
    parameter: str
    value: float
    ended: bool
    error: float
    """Stick: largest difference of a displacement from the conforming reference, over the shear. Partial slip: error of
    the half-width of the zone that sticks, relative to the closed form's, on a mesh whose own error is part of it."""
    iterations: int
    retries: int
    augmentations: int
    time: float
    time_low: float
    time_high: float
    """Processor time; stick: over that of the conforming reference, run in turn, where the run ended; else s. Median,
    least and largest; of one run where that is not short."""


def measure(points: Sequence[Point], runner: Runner) -> list[Datum]:
    """Run points; short runs of partial slip are repeated in turn.

    Raises HarnessError without an engine or plugin, or where the conforming reference does not run.
    """
    runs = {point: point.run(runner) for point in points}
    slipping = {p: run for p, run in runs.items() if p.problem is Problem.PARTIAL and run.report.normal}
    times = timing.in_turn(slipping, PAIRS)
    return [_datum(point, run, times.get(point, [run.cpu]), runner) for point, run in runs.items()]


def _datum(point: Point, run: RunResult, times: Sequence[float], runner: Runner) -> Datum:
    report = run.report
    if report.normal and point.problem is Problem.STICK:
        error, times = _error_and_ratios(run, runner)
    else:
        error = slip_zones.zones(run).measures(1.0)[0].value if report.normal else math.nan
    setting = (point.problem.value, point.interface.value, point.parameter.value, point.value)
    counts = (report.iterations, report.retries, report.augmentations)
    return Datum(*setting, report.normal, error, *counts, *timing.spread(times))


def _error_and_ratios(run: RunResult, runner: Runner) -> tuple[float, list[float]]:
    """The error of a sheared block, and its times over those of the conforming reference, run in turn."""
    joined = ShearedBlocks(Kind.BIPHASIC, InterfaceType.CONFORMING, name="friction-cost-conforming")
    reference = runner(joined.model())
    own, others = timing.interleave({"own": run.model, "reference": reference.model}, PAIRS).values()
    return displaced(run, reference), timing.ratios(own, others)


LEVELS = (1e-2, 1e-3, 1e-4, 1e-6)  # errors at which interfaces are compared


def least_time(data: Sequence[Datum]) -> str:
    """A Markdown table: the least that each interface pays for an error in stick: setting, iterations, time.

    The last column names the interface that pays least.
    """
    names = list(dict.fromkeys(d.interface for d in data))
    rows = []
    for error in LEVELS:
        good = [d for d in data if d.problem == Problem.STICK.value and d.ended and d.error <= error]
        best = [min((d for d in good if d.interface == name), key=lambda d: d.time, default=None) for name in names]
        least = min(filter(None, best), key=lambda d: d.time, default=None)
        rows.append((f"{error:.0e}", *map(_paid, best), f"`{least.interface}`" if least else ""))
    return tables.markdown(("error", *(f"`{name}`" for name in names), "less time"), rows)


def _paid(datum: Datum | None) -> str:
    return f"{_setting(datum)}: {datum.iterations} it., {datum.time:.2f}" if datum else "not reached"


def _setting(datum: Datum) -> str:
    default = datum.parameter == Parameter.DEFAULT.value
    return datum.parameter if default else f"{datum.parameter} {datum.value:g}"


def failed(data: Sequence[Datum]) -> str:
    """The runs that did not end, in words."""
    return "; ".join(f"`{d.interface}`, {_setting(d)}{_stopped(d)}" for d in data if not d.ended) or "none"


def _stopped(datum: Datum) -> str:
    return " (ended by the limit)" if at_limit(datum.ended, datum.time) else ""


def value_of(data: Sequence[Datum], problem: Problem, parameter: Parameter, value: float) -> float:
    """The error of the plugin's interface with a setting."""
    wanted = (problem.value, InterfaceType.MIXTURE.value, parameter.value, value)
    return next(d.error for d in data if (d.problem, d.interface, d.parameter, d.value) == wanted)


def figures(data: Sequence[Datum]) -> dict[str, str]:
    """What the text of a page leaves open."""
    told = {
        "default": (Problem.STICK, Parameter.DEFAULT, 0.0),
        "harder": (Problem.STICK, Parameter.TANGENTIAL, 100.0),
        "softer": (Problem.STICK, Parameter.TANGENTIAL, 1e-2),
        "partial": (Problem.PARTIAL, Parameter.DEFAULT, 0.0),
        "partial_softer": (Problem.PARTIAL, Parameter.TANGENTIAL, 1e-3),
    }
    return {
        "least_time": least_time(data),
        "failed": failed(data),
        **{f"stick_{name}": f"{value_of(data, *point):.1e}" for name, point in told.items()},
    }


def displaced(split: RunResult, reference: RunResult) -> float:
    """Largest difference of a displacement, relative to the shear."""
    return max(compare.largest_difference(split, reference, axis) for axis in ("ux", "uy", "uz")) / SHEAR


PICTURE = "images/friction-cost.svg"
LOOKS = {"sliding-mixture": "#7a1f1f", "sliding-biphasic": "#2f5d9e"}
"""Colours of the interfaces."""
LABELS = {
    Problem.STICK: (
        "elastic slip over the shear [-]",
        "processor time over that of the conforming reference [-]",
    ),
    Problem.PARTIAL: ("error of the half-width that sticks [-]", "processor time [s]"),
}


def draw(data: Sequence[Datum], path: Path) -> Path:
    """Both problems, one below the other, with a line for each interface, as SVG."""
    figure = Figure(figsize=(5.4, 6.6), layout="constrained", facecolor="white")
    for axes, problem in zip(figure.subplots(len(Problem), 1), Problem, strict=True):
        _panel(axes, [d for d in data if d.problem == problem.value and d.ended])
        _mark_failed(axes, [d for d in data if d.problem == problem.value and not d.ended])
        axes.set(xlabel=LABELS[problem][1], ylabel=LABELS[problem][0], xscale="log", yscale="log")
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 1.5, 2.0, 2.5, 3.0, 5.0)))
        axes.set_title(problem.value, fontsize=11, loc="left")
    handles = [Line2D([], [], color=colour, marker="o", markersize=4, label=name) for name, colour in LOOKS.items()]
    handles.append(Line2D([], [], color="0.3", marker="*", linestyle="", markersize=10, label="defaults"))
    figure.legend(handles=handles, fontsize=9, ncols=3, loc="outside upper center", frameon=False)
    return files.save_figure(figure, path)


def _panel(axes: Axes, data: Sequence[Datum]) -> None:
    """Settings as dots, the default as a star, and a line through those that no other one of the interface beats."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(alpha=0.25)
    for name, colour in LOOKS.items():
        own = [d for d in data if d.interface == name]
        axes.plot([d.time for d in own], [d.error for d in own], "o", color=colour, markersize=4, alpha=0.35, mew=0)
        best = pareto.front(own, lambda d: (d.time, d.error))
        line = {"color": colour, "marker": "o", "markersize": 4.5, "linewidth": 1.8}
        axes.step([d.time for d in best], [d.error for d in best], where="post", **line)
        default = [d for d in own if d.parameter == Parameter.DEFAULT.value]
        axes.plot([d.time for d in default], [d.error for d in default], "*", color=colour, markersize=12)


def _mark_failed(axes: Axes, data: Sequence[Datum]) -> None:
    """Runs that did not end, in a row at the upper right corner: they have neither an error nor a time to compare."""
    for number, datum in enumerate(data):
        drawn = axes.plot(1.0 - 0.04 * number, 1.0, "x", transform=axes.transAxes, clip_on=False)[0]
        drawn.set(color=LOOKS[datum.interface], markersize=6, gid=f"failed {datum.interface}")
    if data:
        axes.text(1.0, 0.96, "x: did not complete", transform=axes.transAxes, ha="right", va="top", fontsize=8)
