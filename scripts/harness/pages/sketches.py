"""Sketches of the explanation: the interface, averages around nodes, Gauss points and segments."""

from __future__ import annotations

from itertools import product
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

FOLDER = "images/sketches"
DARK, MIDDLE, LIGHT = "#1d2f49", "#4f74a3", "#dfe7f0"
ARROW = {"arrowstyle": "-|>", "color": DARK, "lw": 1.4}


def draw(folder: Path) -> list[Path]:
    """Draw all of them below `folder`, as SVG."""
    mpl.use("Agg")
    mpl.rcParams["svg.hashsalt"] = "sketches"
    goal = folder / FOLDER
    goal.mkdir(parents=True, exist_ok=True)
    return [
        _saved(interface(), goal / "interface.svg"),
        _saved(averages(), goal / "averages.svg"),
        _saved(integration(), goal / "integration.svg"),
    ]


def _saved(figure: Figure, path: Path) -> Path:
    figure.savefig(path, metadata={"Date": None})
    return path


def _figure(width: float, height: float) -> Figure:
    return Figure(figsize=(width, height), layout="constrained", facecolor="white")


def interface() -> Figure:
    """Two bodies, the gap along the primary normal, and what passes."""
    figure = _figure(6.4, 3.4)
    axes = figure.subplots()
    x = np.linspace(-3.0, 3.0, 121)
    lower, upper = -0.1 * x**2, 0.55 + 0.16 * x**2
    axes.fill_between(x, lower, -2.0, color=LIGHT)
    axes.fill_between(x, upper, 3.0, color="#f0e6d8")
    axes.plot(x, lower, color=DARK, lw=2)
    axes.plot(x, upper, color="#8a5a2b", lw=2)
    _normal(axes)
    for at, text in ((-0.62, "traction"), (-0.02, "solvent"), (0.58, "solutes")):
        axes.annotate("", (at, 1.3), (at, -0.75), arrowprops={**ARROW, "color": MIDDLE, "arrowstyle": "<|-|>"})
        axes.text(at, -0.85, text, ha="center", va="top", fontsize=8, color=MIDDLE)
    axes.text(-2.9, -1.85, "primary body 1", fontsize=9)
    axes.text(-2.9, 2.75, "secondary body 2", fontsize=9)
    for side in (-2.75, 2.0):
        axes.text(side, 0.35, "ambient\n$\\tilde p^*$, $\\tilde c^*$", fontsize=8)
    axes.text(2.45, -0.98, "$\\gamma_1$", fontsize=10)
    axes.text(2.45, 1.25, "$\\gamma_2$", fontsize=10)
    axes.set_axis_off()
    axes.set(xlim=(-3, 3), ylim=(-2, 3))
    return figure


def _normal(axes: Axes) -> None:
    """A point, its normal, and the point that it faces."""
    foot = np.array([1.25, -0.1 * 1.25**2])
    normal = np.array([0.25, 1.0]) / np.hypot(0.25, 1.0)
    ray = foot + np.linspace(0.0, 3.0, 3001)[:, None] * normal
    head = ray[np.argmax(ray[:, 1] > 0.55 + 0.16 * ray[:, 0] ** 2)]
    axes.plot(*np.array([foot, head]).T, ":", color=DARK, lw=1)
    (x, y), (above, up) = foot, foot + 0.7 * normal
    axes.annotate("", (float(above), float(up)), (float(x), float(y)), arrowprops=ARROW)
    axes.plot(*np.array([foot, head]).T, "o", color=DARK, ms=4)
    _name(axes, foot, (0.12, -0.22), "$\\mathbf{x}_1$")
    _name(axes, head, (0.1, 0.12), "$\\mathbf{x}_2$")
    _name(axes, foot + 0.62 * normal, (0.1, 0.0), "$\\mathbf{n}_1$")
    _name(axes, head, (-0.38, -0.42), "$g$")


def _name(axes: Axes, at: NDArray[np.float64], shift: tuple[float, float], text: str) -> None:
    x, y = np.add(at, shift)
    axes.text(float(x), float(y), text, fontsize=9)


def averages() -> Figure:
    """The gap along a surface, the weights of the nodes, and the averages that the laws act on."""
    figure = _figure(6.4, 3.2)
    top, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.5, 1))
    nodes, x = np.arange(6.0), np.linspace(0.0, 5.0, 501)
    gap = 0.05 * (x - 2.2) ** 2 - 0.1 + 0.05 * np.sin(6.0 * x)
    top.plot(x, gap, color=MIDDLE, lw=1.2, label="gap at points")
    hats = [np.clip(1.0 - np.abs(x - node), 0.0, None) for node in nodes]
    means = [float((hat * gap).sum() / hat.sum()) for hat in hats]
    top.plot(nodes, means, "o", color=DARK, label="average at nodes, $g_a$")
    top.axhline(0.0, color="0.6", lw=0.7)
    for node, mean in zip(nodes, means, strict=True):
        top.text(node, mean + 0.06, "closed" if mean < 0 else "open", ha="center", fontsize=8)
    top.set_ylabel("gap [mm]")
    top.legend(fontsize=8, frameon=False, loc="upper center", ncols=2)
    top.set_ylim(-0.2, 0.62)
    for number, hat in enumerate(hats):
        below.plot(x, hat, color=DARK if number == 2 else "0.7", lw=1.6 if number == 2 else 0.9)
    below.fill_between(x, hats[2], color=LIGHT)
    below.text(2.0, 0.35, "$\\psi_a$", ha="center", fontsize=10)
    below.set(xlabel="primary surface, nodes at whole numbers [facets]", ylabel="weight [-]")
    for axes in (top, below):
        axes.spines[["top", "right"]].set_visible(False)
    return figure


def integration() -> Figure:
    """A primary facet over four secondary ones: fixed points, and points on the pieces."""
    figure = _figure(6.4, 3.3)
    left, right = figure.subplots(1, 2)
    cut = (0.35, 0.6)
    for axes, title in ((left, "Gauss points"), (right, "segments")):
        axes.text(0.5, 1.12, title, ha="center", fontsize=10)
        axes.add_patch(Rectangle((0, 0), 1, 1, facecolor=LIGHT, edgecolor=DARK, lw=2))
        axes.plot((cut[0], cut[0]), (-0.06, 1.06), (-0.06, 1.06), (cut[1], cut[1]), color="#8a5a2b", lw=1.2, ls="--")
        axes.set(xlim=(-0.15, 1.15), ylim=(-0.2, 1.22), aspect="equal")
        axes.set_axis_off()
    at = 0.5 + np.array([-1.0, 1.0]) / np.sqrt(12.0)
    left.plot(*np.array(list(product(at, at))).T, "o", color=DARK)
    for (x0, x1), (y0, y1) in product(((0, cut[0]), (cut[0], 1)), ((0, cut[1]), (cut[1], 1))):
        points = [(x0 + (x1 - x0) * s, y0 + (y1 - y0) * t) for s, t in product(at, at)]
        right.plot(*np.array(points).T, "o", color=DARK, ms=4)
        right.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, edgecolor=MIDDLE, lw=1.4))
    left.text(0.5, -0.16, "solid: primary facet, dashed: edges of secondary ones", ha="center", fontsize=7.5)
    right.text(0.5, -0.16, "each piece faces one secondary facet", ha="center", fontsize=7.5)
    return figure
