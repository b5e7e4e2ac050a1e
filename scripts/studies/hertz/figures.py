"""Runs over closed forms: half-width and peak pressure over time, and pressure over the contact."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies import files
from studies.hertz import elastic_profiles
from studies.hertz.elastic_profiles import ProfileRow
from studies.hertz.growth_records import LINES, SPHERES, Record
from studies.models.biphasic_hertz import BiphasicHertz

MARKERS = "ox^"
GREY = "0.25"


def draw(rows: Sequence[Record], path: Path) -> Path:
    """Half-width or radius and peak pressure, two panels for each shape of the contact, as SVG."""
    figure = Figure(figsize=(5.4, 10.4), layout="constrained", facecolor="white")
    all_axes = figure.subplots(4, 1)
    for (first, second), (problems, extent) in zip(
        (all_axes[:2], all_axes[2:]), ((LINES, "half-width [mm]"), (SPHERES, "radius [mm]")), strict=True
    ):
        _panel(first, rows, problems, ("half_width", 1.0))
        first.set_ylabel(extent)
        _panel(second, rows, problems, ("peak", 1e3))
        second.set_ylabel("peak pressure [kPa]")
        first.set_title("along a line" if problems is LINES else "over a circle", fontsize=10)
        first.legend(fontsize=9, frameon=False, loc="lower right")
    return files.save_figure(figure, path)


def draw_elastic(rows: Sequence[ProfileRow], path: Path) -> Path:
    """Pressure under a cylinder and under a sphere, both over those of the closed form, as SVG."""
    figure = Figure(figsize=(5.4, 5.8), layout="constrained", facecolor="white")
    for axes, problem in zip(figure.subplots(2, 1, sharex=True), elastic_profiles.PROBLEMS, strict=True):
        _profiles(axes, [row for row in rows if row.problem == problem])
        axes.set_title(f"{problem} on a block", fontsize=10)
        axes.set_ylabel("pressure / peak pressure [-]")
    figure.axes[-1].set_xlabel("distance from the middle / its half-width or radius [-]")
    return files.save_figure(figure, path)


def _profiles(axes: Axes, rows: Sequence[ProfileRow]) -> None:
    inside = np.linspace(0.0, 1.0, 201)
    axes.plot(inside, np.sqrt(1.0 - inside**2), "-", color=GREY, linewidth=1.4, label="Hertz, closed form")
    for mesh, marker in zip(dict.fromkeys(row.mesh for row in rows), "ox", strict=True):
        own = [row for row in rows if row.mesh == mesh and row.place < 1.5 * row.radius]
        place, pressure = [row.place / row.radius for row in own], [row.pressure / row.peak for row in own]
        axes.plot(place, pressure, marker, color="black", markerfacecolor="none", ms=4, label=mesh)
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=9, frameon=False)
    axes.spines[["top", "right"]].set_visible(False)


def _panel(axes: Axes, rows: Sequence[Record], problems: Sequence[BiphasicHertz], quantity: tuple[str, float]) -> None:
    """A quantity, given by its name and a factor, of runs over the closed form."""
    name, scale = quantity
    first = [row for row in rows if row.model == problems[0].name]
    exact = [scale * getattr(row, f"{name}_exact") for row in first]
    axes.plot([row.time for row in first], exact, "-", color=GREY, linewidth=1.4, label="thin layers, closed form")
    for problem, marker in zip(problems, MARKERS, strict=False):
        own = [row for row in rows if row.model == problem.name]
        values = [scale * getattr(row, name) for row in own]
        filled = "none" if marker != "x" else GREY
        legend = f"{problem.across} elements{', free surfaces drain' if problem.draining else ''}"
        axes.plot([row.time for row in own], values, marker, color="black", markerfacecolor=filled, ms=4, label=legend)
    axes.set_xlabel("time [s]")
    axes.set_ylim(bottom=0.0)
    axes.spines[["top", "right"]].set_visible(False)
