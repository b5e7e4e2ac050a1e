"""Sketches: the interface, the primary side, averages around nodes, Gauss points and segments."""

from itertools import product
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from studies import files

FOLDER = "images/sketches"
DARK, MIDDLE, LIGHT = "#1d2f49", "#4f74a3", "#dfe7f0"
BROWN, SAND, RED = "#8a5a2b", "#f0e6d8", "#b3261e"
CONTACT = 1.6  # half of the width in contact in the sketch of the interface
ARROW = {"arrowstyle": "-|>", "color": DARK, "lw": 1.4}


def draw(folder: Path) -> list[Path]:
    """Draw all of them below `folder`, as SVG."""
    mpl.rcParams["svg.hashsalt"] = "sketches"
    goal = folder / FOLDER
    drawn = {"interface": interface(), "primary": primary(), "averages": averages(), "integration": integration()}
    return [files.save_figure(figure, goal / f"{name}.svg") for name, figure in drawn.items()]


def _figure(width: float, height: float) -> Figure:
    return Figure(figsize=(width, height), layout="constrained", facecolor="white")


def interface() -> Figure:
    """Two bodies that touch: what passes in contact, and a gap at an open point, through which nothing passes."""
    figure = _figure(6.4, 3.6)
    axes = figure.subplots()
    x = np.linspace(-4.0, 4.0, 101)
    lower, upper = np.zeros_like(x), _outline(x)
    axes.fill_between(x, lower, -2.0, color=LIGHT)
    axes.fill_between(x, upper, 3.0, color=SAND)
    axes.plot(x, lower, color=DARK, lw=2)
    axes.plot(x, upper, color=BROWN, lw=2)
    axes.plot((-CONTACT, CONTACT), (0.0, 0.0), color="black", lw=4, solid_capstyle="butt")
    axes.text(0.0, 1.62, "in contact", ha="center", fontsize=9, weight="bold")
    for at, text in ((-1.0, "traction"), (0.0, "solvent"), (1.0, "solutes")):
        axes.annotate("", (at, 1.0), (at, -1.0), arrowprops={**ARROW, "color": MIDDLE, "arrowstyle": "<|-|>"})
        axes.text(at, -1.1, text, ha="center", va="top", fontsize=9, color=MIDDLE)
    _gap(axes)
    axes.text(-3.9, -1.85, "primary body 1", fontsize=9)
    axes.text(-3.9, 2.7, "secondary body 2", fontsize=9)
    axes.annotate(
        "open: ambient fluid,\n$\\tilde p^*$, $\\tilde c^*$",
        (-3.2, 0.25),
        (-3.9, -0.85),
        fontsize=8.5,
        arrowprops=ARROW,
    )
    axes.text(3.75, -0.3, r"$\gamma_1$", fontsize=10)
    axes.text(3.75, 1.42, r"$\gamma_2$", fontsize=10)
    axes.set_axis_off()
    axes.set(xlim=(-4, 4), ylim=(-2, 3))
    return figure


def _outline(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """The lower side of the upper body: flat where it touches, and rising outside."""
    return 0.18 * np.clip(np.abs(x) - CONTACT, 0.0, None) ** 2


def _gap(axes: Axes) -> None:
    """An open point, its normal, the point that it faces, and the gap between both."""
    foot, head = np.array([2.95, 0.0]), np.array([2.95, float(_outline(np.array(2.95)))])
    axes.plot(*np.array([foot, head]).T, ":", color=DARK, lw=1.4)
    axes.plot(*np.array([foot, head]).T, "o", color=DARK, ms=4)
    _name(axes, foot, (-0.1, -0.34), r"$\mathbf{x}_1$")
    _name(axes, head, (-0.1, 0.14), r"$\mathbf{x}_2$")
    _name(axes, 0.5 * (foot + head), (0.1, -0.1), "gap $g$")
    axes.annotate("", (2.3, 0.75), (2.3, 0.0), arrowprops=ARROW)
    _name(axes, np.array([2.3, 0.75]), (-0.32, 0.0), r"$\mathbf{n}_1$")


def primary() -> Figure:
    """A bump, finer than the facets of the other side: coarse averages overlook it, its own nodes do not."""
    figure = _figure(6.4, 3.5)
    left, right = figure.subplots(1, 2)
    bump = np.linspace(-3.0, 3.0, 151)
    for axes, depth, title in ((left, 0.32, "wrong: coarse side primary"), (right, 0.0, "right: fine side primary")):
        height = 0.55 - (0.55 + depth) * np.exp(-((bump / 0.34) ** 2)) + 0.02 * bump**2
        axes.fill_between(bump, height, 2.6, color=SAND)
        axes.fill_between(bump, 0.0, -1.5, color=LIGHT, zorder=0)
        axes.plot(bump, height, color=BROWN, lw=2)
        axes.plot((-3, 3), (0, 0), color=DARK, lw=2)
        axes.set_title(title, fontsize=10)
        axes.set_axis_off()
        axes.set(xlim=(-3, 3), ylim=(-1.7, 2.6))
    left.fill_between(
        bump, np.minimum(0.55 - 0.87 * np.exp(-((bump / 0.34) ** 2)) + 0.02 * bump**2, 0.0), 0.0, color=RED
    )
    coarse = np.arange(-3.0, 3.1, 2.0) + 0.0
    left.plot(coarse, np.zeros_like(coarse), "o", color=DARK, ms=6, clip_on=False)
    left.text(0.0, -0.75, "no force: the average gaps\nat these nodes are open", ha="center", va="top", fontsize=8.5)
    fine = np.linspace(-2.7, 2.7, 19)
    right.plot(fine, 0.55 - 0.55 * np.exp(-((fine / 0.34) ** 2)) + 0.02 * fine**2, "o", color=BROWN, ms=4)
    right.annotate("", (0.0, 0.95), (0.0, 0.05), arrowprops=ARROW)
    right.text(0.0, -0.75, "force at first touch: the node\nat the tip closes", ha="center", va="top", fontsize=8.5)
    return figure


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
        axes.plot((cut[0], cut[0]), (-0.06, 1.06), (-0.06, 1.06), (cut[1], cut[1]), color=BROWN, lw=1.2, ls="--")
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
