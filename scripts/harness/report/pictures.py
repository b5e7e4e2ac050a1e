"""Pictures of a run: contact pressure on the deformed surfaces in three dimensions, and curves over time."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyvista
from matplotlib.figure import Figure

from harness.arrays import Array
from harness.report import history
from harness.report.history import Contact
from harness.report.plot_file import PlotFile, State
from harness.report.surface import Surface
from harness.report.vtk_files import file_name, mesh_of

SIZE = (900, 700)  # pixels of a picture in three dimensions
COLOURS = ("#0b5fa5", "#d1495b", "#2a7f62", "#8d5aa8", "#c77d0a", "#4a4e52")
_COLOUR_MAP = "viridis"
_HEX, _PENTA, _TET, _QUAD, _TRI, _PYRA = (8, 12), (6, 13), (4, 10), (4, 9), (3, 5), (5, 14)
_CELLS = {
    **dict.fromkeys((0, 6, 9), _HEX),
    **dict.fromkeys((1, 13), _PENTA),
    **dict.fromkeys((2, 7, 8, 14, 17), _TET),
    **dict.fromkeys((3, 11, 12), _QUAD),
    **dict.fromkeys((4, 10, 15), _TRI),
    **dict.fromkeys((16, 18), _PYRA),
}
"""Corners, and VTK's cell of as many corners, by FEBio's number of an element's shape in a plot file."""
_HARDLY, _LONG = 0.05, 100.0  # part of a contact's largest force, and ratio of its longest to its shortest step
_TILT = 0.6
"""How far the eye stands beside the mean normal of a surface, as a part of its distance: what is curved looks so."""


def draw_pressures(plot: PlotFile, contacts: Sequence[Contact], number: int, folder: Path) -> list[Path]:
    """Draw the contact pressure of a state, one picture per surface, each seen from its outside.

    All pictures have one scale of colours, from zero to the largest pressure among them.
    """
    state = plot.states[number]
    largest = max((float(contact.peak[number]) for contact in contacts), default=0.0)
    files = []
    for index, contact in enumerate(contacts):
        file = folder / f"pressure-{file_name(index, contact)}.png"
        _draw_surface(plot, state, contact, largest or 1.0, file)
        files.append(file)
    return files


def _draw_surface(plot: PlotFile, state: State, contact: Contact, largest: float, file: Path) -> None:
    positions = plot.positions(state)
    surface = contact.surface
    mesh = mesh_of(surface, positions)
    mesh.cell_data["contact pressure [MPa]"] = history.pressures(state, surface, contact.place)[
        surface.facet_of_triangle
    ]
    plotter = pyvista.Plotter(off_screen=True, window_size=list(SIZE))
    plotter.set_background("white")
    bar = {
        "title": "contact pressure [MPa]\n",
        "color": "black",
        "fmt": "%.3g",
        "title_font_size": 22,
        "label_font_size": 18,
    }
    light = {"ambient": 0.75, "diffuse": 0.25}  # little shade, so that colours are those of the scale
    shown = plotter.add_mesh(mesh, cmap=_COLOUR_MAP, clim=(0.0, largest), scalar_bar_args=bar, **light)
    shown.mapper.SetResolveCoincidentTopologyToPolygonOffset()  # drawn over the faces of its own body
    shown.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(-4.0, -4.0)
    body = body_of(plot, surface, positions)
    if body is not None:
        plotter.add_mesh(body, color="#d9d6cf", smooth_shading=False)
    _look_from_outside(plotter, surface.area_vectors(positions).sum(axis=0), mesh)
    plotter.screenshot(str(file))
    plotter.close()


def body_of(plot: PlotFile, surface: Surface, positions: Array) -> pyvista.PolyData | None:
    """Return the outside of the domains that have nodes of the surface, and of what is joined to them by nodes."""
    members = set(surface.nodes.tolist())
    parts, rest = [], [domain for domain in plot.domains.values() if domain.kind in _CELLS]
    while touching := [domain for domain in rest if not members.isdisjoint(domain.elements.ravel().tolist())]:
        rest = [domain for domain in rest if domain not in touching]
        for domain in touching:
            members.update(domain.elements.ravel().tolist())
            corners, kind = _CELLS[domain.kind]
            cells = np.hstack([np.full((len(domain.elements), 1), corners), domain.elements[:, :corners]])
            parts.append(
                pyvista.UnstructuredGrid(cells, np.full(len(cells), kind), positions).extract_surface(
                    algorithm="dataset_surface"
                )
            )
    return pyvista.merge(parts) if parts else None


def _look_from_outside(plotter: pyvista.Plotter, outward: Array, mesh: pyvista.PolyData) -> None:
    """Place the eye above the surface, a little to a side; from a corner where the surface is closed."""
    size = float(np.linalg.norm(outward))
    normal = outward / size if size > 0.05 * mesh.area else np.ones(3) / np.sqrt(3)
    upward = np.eye(3)[int(np.argmin(np.abs(normal)))]
    side = np.cross(upward, normal)
    eye = normal + _TILT * (upward + 0.5 * side) / np.sqrt(1.25)
    centre = np.array(mesh.center)
    plotter.camera_position = [tuple(centre + eye * mesh.length), tuple(centre), tuple(upward)]
    plotter.reset_camera(bounds=mesh.bounds)


def draw_curves(contacts: Sequence[Contact], folder: Path) -> list[Path]:
    """Draw force, area, pressure, fluid share and what has crossed over time; no panel where nothing is known."""
    panels = [
        ("force", "contact force [N]", {name: each.force for name, each in _named(contacts)}),
        ("area", "contact area [mm²]", {name: each.area for name, each in _named(contacts)}),
        ("pressure", "largest contact pressure [MPa]", {name: each.peak for name, each in _named(contacts)}),
        ("fluid", "part of the force that the fluid bears", _known({n: _loaded(c) for n, c in _named(contacts)})),
    ]
    for label in dict.fromkeys(label for contact in contacts for label in contact.flows):
        unit = "mm³" if label == "solvent" else "nmol"
        through = {name: each.flows[label] for name, each in _named(contacts) if label in each.flows}
        panels.append((label.replace(" ", "-"), f"{label} out through the contact [{unit}]", through))
    return [_draw(name, title, lines, contacts[0].time, folder) for name, title, lines in panels if lines]


def _named(contacts: Sequence[Contact]) -> list[tuple[str, Contact]]:
    """Contacts by the names of their surfaces; numbered where a surface has several."""
    names = [contact.surface.name for contact in contacts]
    return [
        (name if names.count(name) == 1 else f"{name} ({names[: place + 1].count(name)})", contacts[place])
        for place, name in enumerate(names)
    ]


def _known(lines: dict[str, Array]) -> dict[str, Array]:
    return {name: values for name, values in lines.items() if np.isfinite(values).any()}


def _loaded(contact: Contact) -> Array:
    """Share of the fluid while the contact bears a load: a part of hardly any force says nothing."""
    return np.where(contact.force > _HARDLY * contact.force.max(), contact.fluid_share, np.nan)


def _is_long(time: Array) -> bool:
    """Whether a logarithmic axis shows a time that linear ones hide."""
    steps = np.diff(time)
    return len(steps) > 1 and float(steps.max()) > _LONG * float(steps.min())


def _draw(name: str, title: str, lines: dict[str, Array], time: Array, folder: Path) -> Path:
    rows = -(-len(lines) // 2)
    figure = Figure(figsize=(5.6, 3.4 + 0.2 * rows), layout="constrained")
    axes = figure.subplots()
    mark = "o" if len(time) < 30 else ""
    for index, (label, values) in enumerate(lines.items()):
        colour = COLOURS[index % len(COLOURS)]
        style = "-" if index < len(COLOURS) else "--"
        axes.plot(time, values, style, marker=mark, markersize=3, color=colour, label=label, linewidth=1.6)
    if _is_long(time):
        axes.set_xscale("log")
    axes.set_xlabel("time [s]")
    axes.set_ylabel(title)
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=2, fontsize=8)
    path = folder / f"{name}.png"
    figure.savefig(path, dpi=130)
    return path
