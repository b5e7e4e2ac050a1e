"""Runs and published curves: torque over angle, forces over the way."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies import files
from studies.friction.curves import FEBIO_SERIES, SMOOTH_SPHERES, SPHERES, Row
from studies.friction.published import ABAQUS, AREIAS, FEBIO, SAUER

PICTURE = "images/friction-benchmarks.svg"
RED = "#7a1f1f"
LINES = {"coarse mesh": (":", "0.45"), "fine mesh": ("-", RED), FEBIO_SERIES: ("--", "#2f5d9e")}
MARKS = {FEBIO: "o", SAUER: "s", ABAQUS: "^", AREIAS: "x"}
PANELS = (
    ("torque", "angle [degrees]", "torque [N mm]", "twisting hemisphere"),
    (SPHERES, "displacement [mm]", "force [N]", "octant of concentric spheres"),
    (SMOOTH_SPHERES, "displacement [mm]", "force [N]", "the same without friction"),
)


def draw(rows: Sequence[Row], path: Path) -> Path:
    """A panel for each problem, as SVG."""
    figure = Figure(figsize=(5.4, 9.0), layout="constrained", facecolor="white")
    all_axes = figure.subplots(len(PANELS), 1)
    for axes, (problem, place, value, title) in zip(all_axes, PANELS, strict=True):
        _panel(axes, [row for row in rows if row.problem == problem])
        axes.set(xlabel=place, ylabel=value)
        axes.set_title(title, fontsize=10)
    found = {
        label: handle for axes in all_axes for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    figure.legend(found.values(), found, loc="outside upper center", ncols=2, fontsize=9, frameon=False)
    return files.save_figure(figure, path)


def _panel(axes: Axes, rows: Sequence[Row]) -> None:
    for series in dict.fromkeys(row.series for row in rows):
        own = [row for row in rows if row.series == series]
        places, values = [row.place for row in own], [row.value for row in own]
        if series in LINES:
            style, colour = LINES[series]
            axes.plot(places, values, style, color=colour, linewidth=1.4, label=series)
        else:
            axes.plot(places, values, MARKS[series], color="black", markerfacecolor="none", ms=5, label=series)
    axes.set_ylim(bottom=0.0)
    axes.spines[["top", "right"]].set_visible(False)
