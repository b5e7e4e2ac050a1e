"""Draws a plane section of deformed bodies, coloured by a nodal field."""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection, TriMesh
from matplotlib.tri import Triangulation

from harness.arrays import Array, Ids
from harness.models import blocks
from harness.models.blocks import Body
from harness.models.mesh import Mesh

MAP = "viridis"  # colours of 0 to 1
NEAR = 1e-9  # tolerance for positions, mm


@dataclass(frozen=True)
class Section:
    """A plane of the undeformed mesh that is looked at."""

    # Axes (0, 1, 2 for x, y, z) to the right and upwards in the picture.
    across: int = 0
    up: int = 1
    level: float = 0.0  # position of the plane along the third axis, mm
    mirrored: bool = False  # whether the mirror image at the vertical axis is drawn as well

    @property
    def normal(self) -> int:
        """The third axis."""
        return 3 - self.across - self.up

    def facets(self, mesh: Mesh, elements: Ids) -> Ids:
        """Outer facets of a part in the plane: corners, node numbers from 0."""
        body = Body(mesh.nodes, elements - 1)
        return blocks.facets_where(body, lambda x: np.abs(x[..., self.normal] - self.level) < NEAR)[:, :4]


def draw_bodies(axes: Axes, mesh: Mesh, section: Section, positions: Array, values: Array) -> TriMesh | None:
    """Draw the parts of a mesh with the edges of their elements; nothing is coloured where there are no values.

    positions: shape (n_nodes, 3), deformed, mm.
    values: shape (n_nodes,), from 0 to 1; a part without finite values is grey.
    """
    drawn = None
    for part in mesh.parts:
        quads = section.facets(mesh, part.elements)
        coloured = bool(np.all(np.isfinite(values[quads])))
        for side in (1.0, -1.0) if section.mirrored else (1.0,):
            plane = positions[:, [section.across, section.up]] * np.array([side, 1.0])
            if coloured:
                drawn = _field(axes, plane, quads, values)
            fill = "none" if coloured else "0.82"
            axes.add_collection(
                PolyCollection(list(plane[quads]), facecolors=fill, edgecolors="black", linewidths=0.15)
            )
            axes.add_collection(
                LineCollection(_outline(quads, plane, section.mirrored), colors="black", linewidths=0.9)
            )
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")
    return drawn


def _field(axes: Axes, plane: Array, quads: Ids, values: Array) -> TriMesh:
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    mesh = Triangulation(plane[:, 0], plane[:, 1], triangles)
    return axes.tripcolor(mesh, np.nan_to_num(values), shading="gouraud", cmap=MAP, vmin=0.0, vmax=1.0, rasterized=True)


def _outline(quads: Ids, plane: Array, mirrored: bool) -> list[Array]:
    """Edges that belong to one facet only, without those on the plane of a mirror."""
    edges = np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)])
    _, index, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    single = edges[index[count == 1]]
    return [plane[edge] for edge in single if not mirrored or np.any(np.abs(plane[edge, 0]) > NEAR)]
