"""Draws what the gallery shows of a model: concentration over the deformed bodies, and curves over time."""

from collections.abc import Mapping
from itertools import cycle
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from harness.arrays import Array
from harness.models.document import Model
from harness.models.mesh import Mesh
from harness.models.parts import Mixture
from harness.post.section_figures import Section, draw_bodies
from harness.run.runner import RunResult
from studies.pages.gallery.entries import Curves, Entry

COLOURS = ("#0b5fa5", "#d1495b", "#2a7f62", "#8d5aa8")
STYLES = ("-", "--", ":")  # of lines, so that they differ in grey, too
DPI = 110
NAMES, LARGE = 11, 14
"""Points of text over bodies, and of titles and scales: a phone shows a picture at a third of its width."""
BOX = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1.5}
"""Behind names, so that they are read on every colour, and in grey."""
ROUND = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)  # lengths of a scale bar, mm


def draw(entry: Entry, result: RunResult, curves: Curves, folder: Path) -> list[Path]:
    """Both pictures of a run, as PNG files in `folder`, which is made where needed."""
    folder.mkdir(parents=True, exist_ok=True)
    name = result.model.name
    return [
        draw_section(entry, result, folder / f"{name}-section.png"),
        draw_curves(curves, folder / f"{name}-curves.png"),
    ]


def draw_section(entry: Entry, result: RunResult, path: Path) -> Path:
    """Effective concentration over the deformed bodies at those times of the entry that the run has, or at its end."""
    history = result.nodes
    times = [time for time in entry.times if history.has(time)] or [float(history.times[-1])]
    states = [history.at(time) for time in times]
    extent = [float(np.ptp(history["xyz"[axis]][states])) for axis in (entry.section.across, entry.section.up)]
    width = extent[0] * (2.0 if entry.section.mirrored else 1.0)
    rows, columns, size = _arrangement(extent[1] / width, len(times))
    figure = Figure(figsize=size, layout="constrained")
    places = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel()
    for axes in places[len(times) :]:
        axes.set_visible(False)
    drawn = None
    for axes, time, state in zip(places, times, states, strict=False):
        positions = np.stack([history[axis][state] for axis in "xyz"], axis=1)
        values = np.where(_without_solute(result.model), np.nan, history["c1"][state])
        drawn = draw_bodies(axes, result.model.mesh, entry.section, positions, values) or drawn
        axes.set_title(f"{time:g} s", fontsize=LARGE)
        if state == states[0]:
            _names(axes, result.model.mesh, entry.section, positions)
            _scale(axes)
    if drawn is not None:
        bar = figure.colorbar(drawn, ax=places.tolist(), shrink=0.9, extend="both")
        bar.set_label(r"$\tilde c$ [mM]", fontsize=LARGE)
        bar.ax.tick_params(labelsize=LARGE)
    figure.savefig(path, dpi=DPI)
    return path


def _names(axes: Axes, mesh: Mesh, section: Section, positions: Array) -> None:
    for part in mesh.parts:
        x, y = positions[np.unique(section.facets(mesh, part.elements))][:, [section.across, section.up]].T
        middle = 0.0 if section.mirrored else 0.5 * (x.min() + x.max())
        near = y[np.abs(x - middle) <= np.abs(x - middle).min() + 0.05 * np.ptp(x)]
        level = 0.5 * (near.min() + near.max())
        axes.text(middle, level, part.name, fontsize=NAMES, ha="center", va="center", bbox=BOX)


def _scale(axes: Axes) -> None:
    """A bar of a round length, below the bodies."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    length = max(step for step in ROUND if step <= 0.4 * (right - left))
    level = low - 0.04 * (high - low)
    axes.plot([right - length, right], [level, level], "k-", linewidth=1.8, solid_capstyle="butt")
    axes.text(
        right - 0.5 * length, level - 0.02 * (high - low), f"{length:g} mm", fontsize=NAMES, ha="center", va="top"
    )
    axes.set_ylim(low - 0.16 * (high - low), high)


def _without_solute(model: Model) -> NDArray[np.bool_]:
    """Nodes of parts without solutes, for which febio4 writes zero."""
    lacking = np.zeros(len(model.mesh.nodes), dtype=bool)
    for part in model.mesh.parts:
        lacking[part.elements - 1] = not isinstance(model.materials[part.material], Mixture)
    return lacking


def _arrangement(aspect: float, pictures: int) -> tuple[int, int, tuple[float, float]]:
    """Rows and columns of pictures of height/width `aspect`, wide ones two in a row; size of the figure, inch."""
    columns = pictures if aspect > 1.0 else min(2, pictures)
    rows = -(-pictures // columns)
    across = min(4.2, 8.6 / columns)
    height = min(across * aspect, 3.2)
    return rows, columns, (height / aspect * columns + 1.0, (height + 0.3) * rows)


def draw_curves(curves: Curves, path: Path) -> Path:
    """Content of each part, mean concentration on each contact surface, and the force if there is one, over time."""
    count = 2 if curves.force is None else 3
    figure = Figure(figsize=(5.4, 2.4 * count), layout="constrained")
    places = figure.subplots(count, 1)
    _panel(places[0], curves.times, curves.contents, "solute [nmol]")
    _panel(places[1], curves.times, curves.sides, r"mean $\tilde c$ of surface [mM]")
    if curves.force is not None:
        _panel(places[2], curves.times, {"": curves.force}, "force [N]")
    figure.savefig(path, dpi=DPI)
    return path


def _panel(axes: Axes, times: Array, lines: Mapping[str, Array], label: str) -> None:
    for (name, values), colour, style in zip(lines.items(), cycle(COLOURS), cycle(STYLES)):
        axes.plot(times, values, style, color=colour, linewidth=1.4, label=name)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(label)
    axes.spines[["top", "right"]].set_visible(False)
    if len(lines) > 1:
        axes.legend(fontsize=9, frameon=False)
