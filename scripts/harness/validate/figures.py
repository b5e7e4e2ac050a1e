"""Draws figures 3.2 and 3.3 of Ateshian, Maas and Weiss (2012): simulation over closed form."""

from collections.abc import Callable, Sequence
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
TIMES = (100.0, 400.0, 1000.0, 2000.0, 4000.0, 8000.0)
"""Times of the curves of figure 3.2, s."""
COLOURS = ("#0b5fa5", "#d1495b", "#2a7f62", "#8d5aa8", "#c77d0a", "#4a4e52")
MARKS = ("o", "s", "^", "D", "v", "X")
"""One for each curve, so that grey tells them apart."""


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
    """Draw both figures; the lines stand there even where no simulation was run.

    folder: where the PNG files go; made where needed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    return [_diffusion(_of(profiles, DIFFUSION), folder), _convection(_of(profiles, CONVECTION), folder)]


def _of(profiles: Sequence[Profile], figure: str) -> dict[float, Profile]:
    return {profile.parameter: profile for profile in profiles if profile.figure == figure}


def _diffusion(profiles: dict[float, Profile], folder: Path) -> Path:
    def exact(z: Array, time: float) -> Array:
        return transient_diffusion.concentration(z, time, height=diffusion.HEIGHT, diffusivity=diffusion.DIFFUSIVITY)

    figure, axes = _canvas("Diffusion through two cubes in contact", "$c/c^*$")
    _curves(axes, TIMES, exact, profiles, lambda time: f"{time:g} s")
    return _save(figure, axes, folder / f"{DIFFUSION}.png")


def _convection(profiles: dict[float, Profile], folder: Path) -> Path:
    def exact(z: Array, peclet: float) -> Array:
        return steady_convection.concentration(z, height=diffusion.HEIGHT, peclet=peclet, upstream=convection.UPSTREAM)

    figure, axes = _canvas("Steady convection through two cubes in contact", "$c/c_u$")
    _curves(axes, tuple(convection.PRESSURES), exact, profiles, lambda peclet: f"Pe = {peclet:g}")
    return _save(figure, axes, folder / f"{CONVECTION}.png")


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


def _curves(
    axes: Axes,
    parameters: Sequence[float],
    exact: Callable[[Array, float], Array],
    profiles: dict[float, Profile],
    label: Callable[[float], str],
) -> None:
    """Closed forms as lines, and nodal values as open marks over them."""
    z = np.linspace(-1.0, 1.0, 401)
    for parameter, colour, mark in zip(parameters, COLOURS, MARKS, strict=False):
        axes.plot(z, exact(z, parameter), color=colour, linewidth=1.3)
        found = profiles.get(float(parameter), Profile("", parameter, [], []))
        drawn = axes.plot(found.z, found.c, mark, color=colour, markersize=4.5, clip_on=False, label=label(parameter))[
            0
        ]
        drawn.set_markerfacecolor("white")


def _save(figure: Figure, axes: Axes, path: Path) -> Path:
    axes.plot([], [], "-", color="0.3", label="closed form")
    figure.legend(loc="outside right upper", fontsize=8, frameon=False)
    figure.savefig(path, dpi=160)
    return path
