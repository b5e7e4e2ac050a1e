"""Error against time of friction: a panel for each problem."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter

from studies.friction.stick_points import Datum, Parameter, Problem

PICTURE = "images/friction-cost.svg"
LOOKS = {"sliding-mixture": ("#7a1f1f", "#7a1f1f"), "sliding-biphasic": ("#2f5d9e", "none")}
"""Colour of lines and of the inside of marks."""
MARKERS = {Parameter.DEFAULT: "*", Parameter.TANGENTIAL: "v", Parameter.PENALTY: "o", Parameter.AUGLAG: "^"}
LABELS = {
    Problem.STICK: (
        "slip that should not be, over the shear [-]",
        "processor time over that\nof the conforming reference [-]",
    ),
    Problem.PARTIAL: ("error of the half-width that sticks [-]", "processor time [s]"),
}


def draw(data: Sequence[Datum], path: Path) -> Path:
    """Both problems, as SVG."""
    figure = Figure(figsize=(8.6, 4.3), layout="constrained", facecolor="white")
    all_axes = figure.subplots(1, len(Problem))
    for axes, problem in zip(all_axes, Problem, strict=True):
        _panel(axes, [d for d in data if d.problem == problem.value and d.ended])
        _mark_failed(axes, [d for d in data if d.problem == problem.value and not d.ended])
        axes.set(xlabel=LABELS[problem][1], ylabel=LABELS[problem][0], xscale="log", yscale="log")
        axes.xaxis.set_major_formatter(ScalarFormatter())
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 3.0, 4.0, 5.0)))
        axes.set_title(problem.value, fontsize=10, pad=10)
    found = {label: line for axes in all_axes for line, label in zip(*axes.get_legend_handles_labels(), strict=True)}
    figure.legend(found.values(), found, fontsize=8, ncols=3, loc="outside lower center", frameon=False)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None})
    return path


def _panel(axes: Axes, data: Sequence[Datum]) -> None:
    axes.spines[["top", "right"]].set_visible(False)
    for interface, parameter in dict.fromkeys((d.interface, d.parameter) for d in data):
        own = [d for d in data if (d.interface, d.parameter) == (interface, parameter)]
        colour, fill = LOOKS[interface]
        default = parameter == Parameter.DEFAULT.value
        axes.errorbar(
            [d.time for d in own],
            [d.error for d in own],
            xerr=[[d.time - d.time_low for d in own], [d.time_high - d.time for d in own]],
            ecolor="#b0b0b0",
            elinewidth=0.7,
            marker=MARKERS[Parameter(parameter)],
            linestyle=":",
            linewidth=0.8,
            color=colour,
            markerfacecolor=fill,
            markersize=12 if default else 5,
            label=f"{interface}, {parameter}",
        )


def _mark_failed(axes: Axes, data: Sequence[Datum]) -> None:
    """Runs that did not end, in a row at the upper right corner: they have neither an error nor a time to compare."""
    for number, datum in enumerate(data):
        colour, fill = LOOKS[datum.interface]
        mark = MARKERS[Parameter(datum.parameter)]
        drawn = axes.plot(1.0 - 0.05 * number, 1.0, mark, transform=axes.transAxes, clip_on=False)[0]
        drawn.set(color=colour, markerfacecolor=fill, markersize=6, gid=f"failed {datum.interface}")
    if data:
        axes.text(1.0, 0.97, "did not end", transform=axes.transAxes, ha="right", va="top", fontsize=8)
