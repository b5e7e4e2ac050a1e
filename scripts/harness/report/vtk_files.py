"""Contact surfaces as meshes of PyVista, and as VTK files, which PyVista and ParaView read."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyvista

from harness.arrays import Array
from harness.report.history import Contact
from harness.report.plot_file import PlotFile
from harness.report.surface import Surface


def file_name(index: int, contact: Contact) -> str:
    """The end of the name of files about a surface: its number, from 1, and its name in plain letters."""
    name = "".join(letter if letter.isalnum() else "-" for letter in contact.surface.name)
    return f"{index + 1}-{name[:40]}"


def mesh_of(surface: Surface, positions: Array) -> pyvista.PolyData:
    """The triangles of a surface, shape (triangles, 3), at the positions [mm] of all nodes."""
    sides = np.full((len(surface.triangles), 1), 3)
    return pyvista.PolyData(positions, np.hstack([sides, surface.triangles])).clean()


def write_surfaces(plot: PlotFile, contacts: Sequence[Contact], number: int, folder: Path) -> list[Path]:
    """Write one file per surface at a state, deformed, with the variables of the plot file on it as means of facets."""
    state, files = plot.states[number], []
    for index, contact in enumerate(contacts):
        surface = contact.surface
        mesh = mesh_of(surface, plot.positions(state))
        for variable, values in state.on_surfaces.items():
            here = values[contact.place]
            if here is not None:
                mesh.cell_data[variable] = surface.at_facets(here)[surface.facet_of_triangle].squeeze()
        files.append(folder / f"surface-{file_name(index, contact)}.vtp")
        mesh.save(files[-1])
    return files
