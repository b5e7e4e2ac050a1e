"""Contact pressure of several runs side by side, in one scale of colours."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyvista
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from harness.report import history, pictures, vtk_files
from harness.report.history import Contact
from harness.report.plot_file import PlotFile

_COLOURS = "turbo"
_TISSUE = "#e6e1d6"
"""Colour of surfaces without pressure."""
_SIZE = (1100, 800)  # pixels of one run


@dataclass(frozen=True)
class Shown:
    """The last state of a run: its title, its plot file, and its contacts with a visible surface."""

    title: str
    plot: PlotFile
    contacts: Sequence[Contact]


def draw(figure: Figure, axes: Sequence[Axes], shown: Sequence[Shown], camera: Sequence[tuple[float, ...]]) -> None:
    """Draw each run in its axes, with one scale of colours; a camera of PyVista has an eye, a focus and a top."""
    largest = max(float(contact.peak[-1]) for run in shown for contact in run.contacts)
    for each, run in zip(axes, shown, strict=True):
        each.imshow(_image(run, largest, camera))
        each.set_axis_off()
        each.set_title(run.title, fontsize=17)
    bar = figure.colorbar(ScalarMappable(Normalize(0.0, largest), _COLOURS), ax=list(axes), shrink=0.9)
    bar.set_label("contact pressure [MPa]", fontsize=15)
    bar.ax.tick_params(labelsize=15)


def _image(run: Shown, largest: float, camera: Sequence[tuple[float, ...]]) -> NDArray[np.uint8]:
    plotter = pyvista.Plotter(off_screen=True, window_size=list(_SIZE))
    plotter.set_background("white")
    for contact in run.contacts:
        _add(plotter, run.plot, contact, largest)
    plotter.camera_position = list(camera)
    image = np.asarray(plotter.screenshot(return_img=True))
    plotter.close()
    return _cropped(image)


def _cropped(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    inked = np.any(image < 255, axis=2)
    rows, columns = (np.flatnonzero(np.any(inked, axis=axis)) for axis in (1, 0))
    return image[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def _add(plotter: pyvista.Plotter, plot: PlotFile, contact: Contact, largest: float) -> None:
    state = plot.states[-1]
    surface, positions = contact.surface, plot.positions(state)
    body = pictures.body_of(plot, surface, positions)
    if body is not None:
        plotter.add_mesh(body, color=_TISSUE, ambient=0.5, diffuse=0.5)
    mesh = vtk_files.mesh_of(surface, positions)
    pressure = history.pressures(state, surface, contact.place)[surface.facet_of_triangle]
    mesh.cell_data["pressure"] = np.where(pressure > 0.0, pressure, np.nan)
    colours = {"cmap": _COLOURS, "clim": (0.0, largest), "nan_color": _TISSUE, "show_scalar_bar": False}
    shown = plotter.add_mesh(mesh, **colours, ambient=0.6, diffuse=0.4)
    shown.mapper.SetResolveCoincidentTopologyToPolygonOffset()  # drawn over the faces of its own body
    shown.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-4.0, -4.0)
