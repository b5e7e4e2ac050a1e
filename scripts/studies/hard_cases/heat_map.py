"""The hard cases as a picture: scenes by interface, each cell saying how its run ended."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle
from numpy.typing import NDArray

from harness.models.mesh import Ids, Mesh
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.outcomes import End, Outcome, arranged
from studies.hard_cases.scene import Fineness, Interface

LOOKS = {
    End.PASSES: ("#eef2f7", "black"),
    End.MISSES: ("#b3c6dd", "black"),
    End.FAILS: ("#4f74a3", "white"),
    End.LIMIT: ("#1d2f49", "white"),
}
"""Colour of a cell, from light to dark also in grey, and of the text in it."""
COLUMNS = {
    "sliding-mixture": "sliding-\nmixture",
    "sliding-mixture-predictor": "with\npredictor",
    "febio-1": "FEBio,\nfactor 1",
    "febio-1000": "FEBio,\nfactor 1000",
}
INKS = ("#1d2f49", "#8a5a2b", "#4f74a3")
"""Of the bodies of a scene."""
ROW = 0.36
"""Height of a row, inches."""
BOXES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
"""Edges of a hexahedron, by its corners."""
VIEW = np.array([[1.0, 0.0], [0.35, 0.25], [0.0, 1.0]])
"""Oblique view: x to the right, z up, y to the back."""


def draw(outcomes: Sequence[Outcome], path: Path) -> Path:
    """Draw how runs ended: a row for each case and mesh, a column for each interface, a thumbnail of each scene."""
    mpl.use("Agg")
    rows = arranged(outcomes)
    height = ROW * (len(rows) + 3)
    figure = Figure(figsize=(9.2, height), facecolor="white")
    axes = figure.add_axes((0.46, ROW / height, 0.53, ROW * len(rows) / height))
    axes.set(xlim=(0, len(COLUMNS)), ylim=(len(rows), 0), xticks=[], yticks=[])
    axes.set_axis_off()
    several = len({mesh for _, mesh in rows}) > 1
    for number, ((case, mesh), row) in enumerate(rows.items()):
        about = f"{CASES[case].about} ({mesh})" if several else CASES[case].about
        _label(figure, case, about, 1.0 - (2 + number + 1) * ROW / height, ROW / height)
        for column, name in enumerate(COLUMNS):
            if name in row:
                _cell(axes, column, number, row[name])
    for column, text in enumerate(COLUMNS.values()):
        axes.text(column + 0.5, -0.15, text, ha="center", va="bottom", fontsize=9)
    handles = [Patch(facecolor=colour, edgecolor="black", label=end.value) for end, (colour, _) in LOOKS.items()]
    figure.legend(handles=handles, loc="lower center", ncols=4, fontsize=9, frameon=False)
    figure.savefig(path)
    return path


def _cell(axes: Axes, column: int, row: int, outcome: Outcome) -> None:
    colour, ink = LOOKS[outcome.end]
    axes.add_patch(Rectangle((column + 0.02, row + 0.04), 0.96, 0.92, facecolor=colour, edgecolor="#555555", lw=0.5))
    axes.text(column + 0.5, row + 0.5, outcome.short, ha="center", va="center", fontsize=9, color=ink)


def _label(figure: Figure, case: str, about: str, bottom: float, height: float) -> None:
    """What a case is about, and its scene."""
    figure.text(0.385, bottom + 0.5 * height, _wrapped(about), ha="right", va="center", fontsize=7.5)
    inset = figure.add_axes((0.39, bottom + 0.06 * height, 0.065, 0.88 * height))
    inset.set_axis_off()
    inset.set_aspect("equal")
    scene = CASES[case].scene.model(Fineness.COARSE, Interface.MIXTURE)
    for number, part in enumerate(scene.mesh.parts):
        lines = _edges(scene.mesh, part.elements)
        inset.add_collection(
            LineCollection(lines, colors=("#1d2f49", "#8a5a2b", "#4f74a3")[number % 3], linewidths=0.4)
        )
    inset.autoscale_view()


def _wrapped(about: str) -> str:
    words, lines = about.split(), [""]
    for word in words:
        if len(lines[-1]) + len(word) > 58:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return "\n".join(lines)


def _edges(mesh: Mesh, elements: Ids) -> list[NDArray[np.float64]]:
    """Edges of the elements of a part that lie on its outline, as seen obliquely: those of one or two elements."""
    pairs = np.sort(np.concatenate([elements[:, list(pair)] for pair in BOXES]), axis=1)
    found, counts = np.unique(pairs, axis=0, return_counts=True)
    return list(mesh.nodes[found[counts <= 2] - 1] @ VIEW)
