"""Draws figures 3.2 and 3.3 of Ateshian, Maas and Weiss (2012): simulation over closed form."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from harness.arrays import Array
from harness.closed_forms import steady_convection, transient_diffusion
from harness.models import convection, diffusion
from harness.run.runner import RunResult
from harness.validate.checks import Context, convection_pair, diffusion_pair
from harness.validate.results import Profile

DIFFUSION = "figure-3.2"
CONVECTION = "figure-3.3"
TIMES = (100.0, 400.0, 1000.0, 2000.0, 4000.0, 8000.0)  # times of the curves of figure 3.2, s
COLOURS = ("#0b5fa5", "#d1495b", "#2a7f62", "#8d5aa8", "#c77d0a", "#4a4e52")
MARKS = ("o", "s", "^", "D", "v", "X")  # one for each curve, so that grey tells them apart


def diffusion_profiles(context: Context) -> list[Profile]:
    """Concentration along the column of problem 3.1 at `TIMES`."""
    split, _ = diffusion_pair(context)
    history = split.nodes
    return [_profile(DIFFUSION, time, split, history["c1"][history.at(time)]) for time in TIMES]


def convection_profiles(context: Context) -> list[Profile]:
    """Steady concentration along the column of problem 3.2 at each Peclet number."""
    found = []
    for peclet in convection.PRESSURES:
        split, _ = convection_pair(context, peclet)
        found.append(_profile(CONVECTION, peclet, split, split.nodes["c1"][-1]))
    return found


def _profile(figure: str, parameter: float, run: RunResult, c: Array) -> Profile:
    """The nodes of the edge x = y = 0, from below to above."""
    position = run.model.mesh.nodes
    edge = np.flatnonzero((position[:, 0] == 0.0) & (position[:, 1] == 0.0))
    order = edge[np.argsort(position[edge, 2], kind="stable")]
    return Profile(figure, float(parameter), position[order, 2].tolist(), c[order].tolist())


def draw(profiles: Sequence[Profile], folder: Path) -> list[Path]:
    """Draw both figures into a folder, which is made where needed; the lines need no simulation."""
    folder.mkdir(parents=True, exist_ok=True)
    return [_draw(name, profiles, folder / f"{name}.png") for name in _FIGURES]


def _exact_convection(z: Array, peclet: float) -> Array:
    return steady_convection.concentration(z, height=diffusion.HEIGHT, peclet=peclet, upstream=convection.UPSTREAM)


_FIGURES: Mapping[str, tuple[str, str, Sequence[float], Callable[[Array, float], Array], str]] = {
    DIFFUSION: (
        "Diffusion through two cubes in contact",
        "$c/c^*$",
        TIMES,
        partial(transient_diffusion.concentration, height=diffusion.HEIGHT, diffusivity=diffusion.DIFFUSIVITY),
        "{:g} s",
    ),
    CONVECTION: (
        "Steady convection through two cubes in contact",
        "$c/c_u$",
        tuple(convection.PRESSURES),
        _exact_convection,
        "Pe = {:g}",
    ),
}
"""Title, quantity, parameters of the curves, closed form, and a curve's label, by the name of a figure."""


def _draw(name: str, profiles: Sequence[Profile], path: Path) -> Path:
    """Closed forms as lines, and nodal values as open marks over them."""
    title, quantity, parameters, exact, label = _FIGURES[name]
    known = {profile.parameter: profile for profile in profiles if profile.figure == name}
    figure, axes = _canvas(title, quantity)
    z = np.linspace(-1.0, 1.0, 401)
    for parameter, colour, mark in zip(parameters, COLOURS, MARKS, strict=False):
        axes.plot(z, exact(z, parameter), color=colour, linewidth=1.3)
        found = known.get(float(parameter), Profile("", parameter, [], []))
        drawn = axes.plot(found.z, found.c, mark, color=colour, markersize=4.5, label=label.format(parameter))
        drawn[0].set(markerfacecolor="white", clip_on=False)
    axes.plot([], [], "-", color="0.3", label="closed form")
    figure.legend(loc="outside right upper", fontsize=8, frameon=False)
    figure.savefig(path, dpi=160)
    return path


def _canvas(title: str, quantity: str) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(7.0, 4.4), layout="constrained")
    axes = figure.add_subplot()
    axes.set_title(title, fontsize=11, pad=14)
    axes.set_xlabel("$z$ [mm]")
    axes.set_ylabel(quantity)
    axes.set_xlim(-1.0, 1.0)
    axes.set_ylim(-0.03, 1.06)
    axes.axvline(0.0, color="0.75", linewidth=0.8, zorder=0)
    place = ("data", "axes fraction")
    axes.annotate("contact", (0.0, 1.0), xycoords=place, ha="center", va="bottom", fontsize=8, color="0.4")
    axes.spines[["top", "right"]].set_visible(False)
    return figure, axes
