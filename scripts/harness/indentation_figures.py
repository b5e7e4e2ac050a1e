"""Draws figure 3.4 of Ateshian, Maas and Weiss (2012), and what problem 3.3 is judged by over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection, TriMesh
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from harness.indentation_results import Curves
from harness.models.indentation import TIMES
from harness.models.mesh import Ids
from harness.runner import Outcome

Array = NDArray[np.float64]
FIELDS, CURVES = "figure-3.4", "indentation-curves"
COLOURS = ("#0b5fa5", "#d1495b", "#2a7f62", "#8d5aa8")
MAP = "viridis"


def draw(outcome: Outcome, curves: Curves, folder: Path) -> list[Path]:
    """Both figures of a plane problem, as PNG files in `folder`, which is made where needed."""
    folder.mkdir(parents=True, exist_ok=True)
    return [draw_fields(outcome, folder / f"{FIELDS}.png"), draw_curves(curves, folder / f"{CURVES}.png")]


def draw_fields(outcome: Outcome, path: Path, times: Sequence[float] = TIMES) -> Path:
    """Concentration over the deformed bodies; both halves are shown, and times that were not reached are left out."""
    history = outcome.nodes
    reached = [time for time in times if time <= history.times[-1] * (1.0 + 1e-6)]
    if not reached:
        reached = [float(history.times[-1])]
    rows = (len(reached) + 1) // 2
    figure = Figure(figsize=(9.6, 2.1 * rows + 0.2), layout="constrained")
    places = figure.subplots(rows, min(2, len(reached)), squeeze=False, sharex=True, sharey=True).ravel()
    drawn = None
    for axes, time in zip(places, reached, strict=False):
        state = history.at(time)
        positions = np.stack([history["x"][state], history["y"][state]], axis=1)
        drawn = _bodies(axes, outcome, positions, history["c1"][state])
        axes.set_title(f"{time:g} s", fontsize=10)
    for axes in places[len(reached) :]:
        axes.set_visible(False)
    if drawn is not None:
        figure.colorbar(drawn, ax=places.tolist(), label=r"$\tilde c$ [mM]", shrink=0.9, extend="both")
    figure.savefig(path, dpi=160)
    return path


def _bodies(axes: Axes, outcome: Outcome, positions: Array, values: Array) -> TriMesh:
    """The bodies and their mirror images at the plane of symmetry, with the edges of their elements."""
    drawn = None
    for part in outcome.model.mesh.parts:
        quads = _front(outcome, part.elements)
        triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        for side in (1.0, -1.0):
            x, y = side * positions[:, 0], positions[:, 1]
            mesh = Triangulation(x, y, triangles)
            drawn = axes.tripcolor(mesh, values, shading="gouraud", cmap=MAP, vmin=0.0, vmax=1.0, rasterized=True)
            outlines = np.stack([x[quads], y[quads]], axis=-1)
            edges = PolyCollection(list(outlines), facecolors="none", edgecolors="black", linewidths=0.15)
            axes.add_collection(edges)
            axes.add_collection(LineCollection(_outline(quads, x, y), colors="black", linewidths=0.9))
    axes.set_aspect("equal")
    axes.axis("off")
    assert drawn is not None
    return drawn


def _front(outcome: Outcome, elements: Ids) -> Ids:
    """Corners (from 0) of the faces of a layer of elements in the plane z = 0."""
    corners = elements[:, :8] - 1
    flat = np.abs(outcome.model.mesh.nodes[corners, 2]) < 1e-9
    front = np.all(flat[:, :4], axis=1)
    return np.where(front[:, None], corners[:, :4], corners[:, 4:])


def _outline(quads: Ids, x: Array, y: Array) -> list[Array]:
    """Edges that belong to one face only."""
    edges = np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)])
    _, index, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    single = [edge for edge in edges[index[count == 1]] if np.any(np.abs(x[edge]) > 1e-9)]
    return [np.stack([x[edge], y[edge]], axis=1) for edge in single]


@dataclass(frozen=True)
class _Panel:
    """One pair of axes: its label and the curves in it."""

    label: str
    curves: tuple[tuple[str, Array], ...]


def draw_curves(curves: Curves, path: Path) -> Path:
    """Force, half-width, contents and outflow, extremes, over time from the first step on."""
    panels = (
        _Panel("force [N]", (("", curves.force),)),
        _Panel("contact half-width [mm]", (("", curves.half_width),)),
        _Panel(
            "solute [nmol]",
            (
                ("slab", curves.slab),
                ("cylinder", curves.cylinder),
                ("outflow", curves.outflow),
                ("sum", curves.slab + curves.cylinder + curves.outflow),
            ),
        ),
        _Panel(r"$\tilde c$ [mM]", (("largest", curves.highest), ("smallest", curves.lowest))),
    )
    figure = Figure(figsize=(9.6, 6.2), layout="constrained")
    for axes, panel in zip(figure.subplots(2, 2, sharex=True).ravel(), panels, strict=True):
        _panel(axes, curves.times, panel)
    figure.savefig(path, dpi=160)
    return path


def _panel(axes: Axes, times: Array, panel: _Panel) -> None:
    for (name, values), colour in zip(panel.curves, COLOURS, strict=False):
        axes.plot(times[1:], values[1:], color=colour, linewidth=1.4, label=name)
    axes.set_xscale("log")
    axes.set_xlabel("time [s]")
    axes.set_ylabel(panel.label)
    axes.axvline(1.0, color="0.8", linewidth=0.8, zorder=0)
    axes.spines[["top", "right"]].set_visible(False)
    if len(panel.curves) > 1:
        axes.legend(fontsize=8, frameon=False)
