"""Draws figure 3.4 of Ateshian, Maas and Weiss (2012), and what problem 3.3 is judged by over time."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from harness.arrays import Array
from harness.indentation.histories import Curves
from harness.models.indentation import TIMES
from harness.post.section_figures import Section, draw_bodies
from harness.run.runner import RunResult

FIELDS, CURVES = "figure-3.4", "indentation-curves"
COLOURS = ("#0b5fa5", "#d1495b", "#2a7f62", "#8d5aa8")
PLANE = Section(mirrored=True)  # the plane z = 0 and its mirror image


def draw(result: RunResult, curves: Curves, folder: Path) -> list[Path]:
    """Both figures of a plane problem, as PNG files in `folder`, which is made where needed."""
    folder.mkdir(parents=True, exist_ok=True)
    return [draw_fields(result, folder / f"{FIELDS}.png"), draw_curves(curves, folder / f"{CURVES}.png")]


def draw_fields(result: RunResult, path: Path) -> Path:
    """Concentration over the deformed bodies; both halves are shown, and times that were not reached are left out."""
    history = result.nodes
    reached = [time for time in TIMES if time <= history.times[-1] * (1.0 + 1e-6)]
    if not reached:
        reached = [float(history.times[-1])]
    rows = (len(reached) + 1) // 2
    figure = Figure(figsize=(9.6, 2.1 * rows + 0.2), layout="constrained")
    places = figure.subplots(rows, min(2, len(reached)), squeeze=False, sharex=True, sharey=True).ravel()
    drawn = None
    for axes, time in zip(places, reached, strict=False):
        state = history.at(time)
        positions = np.stack([history[axis][state] for axis in "xyz"], axis=1)
        drawn = draw_bodies(axes, result.model.mesh, PLANE, positions, history["c1"][state])
        axes.set_title(f"{time:g} s", fontsize=10)
    for axes in places[len(reached) :]:
        axes.set_visible(False)
    if drawn is not None:
        figure.colorbar(drawn, ax=places.tolist(), label=r"$\tilde c$ [mM]", shrink=0.9, extend="both")
    figure.savefig(path, dpi=160)
    return path


def draw_curves(curves: Curves, path: Path) -> Path:
    """Force, half-width, contents and outflow, extremes, over time from the first step on."""
    total = curves.slab + curves.cylinder + curves.outflow
    contents = {"slab": curves.slab, "cylinder": curves.cylinder, "outflow": curves.outflow, "sum": total}
    panels = {
        "force [N]": {"": curves.force},
        "contact half-width [mm]": {"": curves.half_width},
        "solute [nmol]": contents,
        r"$\tilde c$ [mM]": {"largest": curves.highest, "smallest": curves.lowest},
    }
    figure = Figure(figsize=(9.6, 6.2), layout="constrained")
    for axes, (label, lines) in zip(figure.subplots(2, 2, sharex=True).ravel(), panels.items(), strict=True):
        _panel(axes, curves.times, label, lines)
    figure.savefig(path, dpi=160)
    return path


def _panel(axes: Axes, times: Array, label: str, lines: dict[str, Array]) -> None:
    for (name, values), colour in zip(lines.items(), COLOURS, strict=False):
        axes.plot(times[1:], values[1:], color=colour, linewidth=1.4, label=name)
    axes.set_xscale("log")
    axes.set_xlabel("time [s]")
    axes.set_ylabel(label)
    axes.axvline(1.0, color="0.8", linewidth=0.8, zorder=0)
    axes.spines[["top", "right"]].set_visible(False)
    if len(lines) > 1:
        axes.legend(fontsize=8, frameon=False)
