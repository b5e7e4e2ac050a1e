"""Error against time of friction: a panel for each problem."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter

from studies import files
from studies.cost import pareto
from studies.friction.stick_points import Datum, Parameter, Problem

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
