"""The picture of the knee: contact pressure on tibia and menisci, with FEBio's interface and with the plugin's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyvista
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from harness.report import history, pictures, plot_file, vtk_files
from harness.report.history import Contact
from harness.report.plot_file import PlotFile
from harness.run.runner import RunResult
from studies.knees.compared_knees import fluid_share, under_femur
from studies.knees.knee_run import KneeRun

Done = tuple[KneeRun, RunResult]
FACTORS = (0.0, 10.0)
"""Of the penalties of the runs that are drawn: the plugin's defaults, and ten times FEBio's automatic penalties."""
PICTURES = {"knee.png": ("elastic", "stance"), "porous-knee.png": ("biphasic", "stance")}
"""Bodies and loads by the names of their pictures."""
_COLOURS = "turbo"
_TISSUE = "#e6e1d6"
"""Of what bears no pressure."""
_SIZE = (1100, 800)
"""Pixels of one knee."""
_EYE, _FOCUS = (0.0, -75.0, 95.0), (0.0, 1.0, 0.0)
"""mm; behind the knee and above it."""


def draw_all(done: Sequence[Done], folder: Path) -> list[Path]:
    """Draw the bodies and loads that have pictures, each in the size that comes first; return the paths."""
    drawn = []
    for name, wanted in PICTURES.items():
        here = [each for each in done if (each[0].bodies, each[0].load) == wanted and each[0].factor in FACTORS]
        if here:
            drawn.append(draw([each for each in here if each[0].size == here[0][0].size], folder / name))
    return drawn


def draw(runs: Sequence[Done], path: Path) -> Path:
    """Draw the last states of runs side by side, in one scale of colours, FEBio's first; return the path.

    Where a fluid bears part of the load, a curve shows that part over time.
    """
    shown = sorted(runs, key=lambda run: run[0].factor == 0.0)
    plots = [plot_file.read(result.folder / f"{result.model.name}.xplt") for _, result in shown]
    porous = any(math.isfinite(run.fluid_most) for run, _ in shown)
    largest = max(_peak(plot) for plot in plots)
    figure = Figure(figsize=(14.0 if porous else 10.0, 3.5), layout="constrained")
    axes = figure.subplots(1, len(shown) + porous, squeeze=False)[0]
    for each, plot, (run, _) in zip(axes, plots, shown, strict=False):
        each.imshow(_knee(plot, largest))
        each.set_axis_off()
        each.set_title(_title(run), fontsize=10)
    scale = ScalarMappable(Normalize(0.0, largest), _COLOURS)
    figure.colorbar(scale, ax=axes[: len(shown)], label="contact pressure [MPa]", shrink=0.8)
    if porous:
        _draw_shares(axes[-1], plots, [run for run, _ in shown])
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110, bbox_inches="tight", pad_inches=0.05, pil_kwargs={"optimize": True})
    return path


def _peak(plot: PlotFile) -> float:
    return max(float(contact.peak[-1]) for contact in under_femur(plot))


def _draw_shares(axes: Axes, plots: Sequence[PlotFile], runs: Sequence[KneeRun]) -> None:
    """Part of the load that the fluid bears, over time."""
    for plot, run in zip(plots, runs, strict=True):
        contacts = under_femur(plot)
        axes.semilogx(contacts[0].time[1:], fluid_share(contacts)[1:], ".-", label=run.contact)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("part of the load that the fluid bears")
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    axes.legend()


def _title(run: KneeRun) -> str:
    theirs = f"FEBio's {run.contact}, {run.factor:g} times automatic penalties"
    return (
        f"{theirs if run.factor else f'{run.contact}, defaults'}\n"
        f"{run.iterations} iterations, retries: {run.retries}, {run.seconds:.0f} s\n"
        f"largest pressure {run.peak_medial:.1f} and {run.peak_lateral:.1f} MPa, "
        f"area {run.area_medial:.0f} and {run.area_lateral:.0f} mm²"
    )


def _knee(plot: PlotFile, largest: float) -> NDArray[np.uint8]:
    """Tibia and menisci with their pressure, as an image."""
    plotter = pyvista.Plotter(off_screen=True, window_size=list(_SIZE))
    plotter.set_background("white")
    for contact in history.contacts(plot):
        if contact.surface.name.startswith(("tibia-to-femur", "meniscus-to-femur")):
            _add(plotter, plot, contact, largest)
    plotter.camera_position = [_EYE, _FOCUS, (0.0, 0.0, 1.0)]
    image = np.asarray(plotter.screenshot(return_img=True))
    plotter.close()
    return _cropped(image)


def _cropped(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The image without its white border."""
    inked = np.any(image < 255, axis=2)
    rows, columns = (np.flatnonzero(np.any(inked, axis=axis)) for axis in (1, 0))
    return image[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def _add(plotter: pyvista.Plotter, plot: PlotFile, contact: Contact, largest: float) -> None:
    state = plot.states[-1]
    surface, positions = contact.surface, plot.positions(state)
    body = pictures.body_of(plot, surface, positions)
    if body is not None:
        plotter.add_mesh(body, color=_TISSUE, ambient=0.5)
    mesh = vtk_files.mesh_of(surface, positions)
    pressure = history.pressures(state, surface, contact.place)[surface.facet_of_triangle]
    mesh.cell_data["pressure"] = np.where(pressure > 0.0, pressure, np.nan)
    colours = {"cmap": _COLOURS, "clim": (0.0, largest), "nan_color": _TISSUE, "show_scalar_bar": False}
    shown = plotter.add_mesh(mesh, **colours, ambient=0.6, diffuse=0.4)
    shown.mapper.SetResolveCoincidentTopologyToPolygonOffset()  # drawn over the faces of its own body
    shown.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-4.0, -4.0)
