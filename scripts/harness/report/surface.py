"""A surface of facets: its triangles, areas, and values at facets and nodes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from harness.arrays import Array, Ids

_FAN_OF_TRI7 = ((0, 3, 6), (3, 1, 6), (1, 4, 6), (4, 2, 6), (2, 5, 6), (5, 0, 6))
_FAN_OF_QUAD9 = ((0, 4, 8), (4, 1, 8), (1, 5, 8), (5, 2, 8), (2, 6, 8), (6, 3, 8), (3, 7, 8), (7, 0, 8))
TRIANGLES: dict[int, tuple[tuple[int, int, int], ...]] = {
    3: ((0, 1, 2),),
    4: ((0, 1, 2), (0, 2, 3)),
    6: ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)),
    7: _FAN_OF_TRI7,
    8: ((0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 7), (5, 6, 7)),
    9: _FAN_OF_QUAD9,
}
"""Triangles that a facet with so many nodes is drawn and summed by, as places in its list of nodes."""


def in_order_of_appearance(nodes: Ids) -> Ids:
    """Return each node once, in the order in which FEBio numbers the nodes of a surface or a domain."""
    _, first = np.unique(nodes, return_index=True)
    return nodes[np.sort(first)]


@dataclass(frozen=True)
class Surface:
    """Facets with a name."""

    name: str
    facets: tuple[Ids, ...]  # per facet its nodes, counted from 0 in the mesh

    @classmethod
    def from_faces(cls, name: str, faces: NDArray[np.int32]) -> Surface:
        """Make a surface from rows of number, count of nodes and nodes, as FEBio's plot file has them."""
        return cls(name, tuple(row[2 : 2 + row[1]].astype(np.int64) for row in faces))

    @cached_property
    def nodes(self) -> Ids:
        """Nodes of the surface in FEBio's order."""
        return in_order_of_appearance(np.concatenate(self.facets))

    @cached_property
    def _split(self) -> tuple[Ids, Ids]:
        """Triangles, shape (triangles, 3), and the facet of each."""
        corners, owners = [], []
        for number, facet in enumerate(self.facets):
            for triangle in TRIANGLES[len(facet)]:
                corners.append(facet[list(triangle)])
                owners.append(number)
        return np.array(corners), np.array(owners)

    @property
    def triangles(self) -> Ids:
        """Nodes of the triangles, shape (triangles, 3)."""
        return self._split[0]

    @property
    def facet_of_triangle(self) -> Ids:
        """The facet that each triangle is part of."""
        return self._split[1]

    def area_vectors(self, positions: Array) -> Array:
        """Area times outward unit normal per facet [mm^2], shape (facets, 3), at nodes' positions [mm]."""
        corner = positions[self.triangles]
        vectors = 0.5 * np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        sums = np.zeros((len(self.facets), 3))
        np.add.at(sums, self.facet_of_triangle, vectors)
        return sums

    def at_facets(self, values: Array) -> Array:
        """Values per facet, shape (facets, components), of values at facets, at their corners, at nodes or of all.

        Raises ValueError where the number of rows is none of these.
        """
        counts = np.array([len(facet) for facet in self.facets])
        if len(values) == len(counts):
            return values
        if len(values) == len(counts) * counts.max():
            corners = values.reshape(len(counts), counts.max(), -1)  # rows of facets with fewer nodes are filled up
            return np.array([corner[:count].mean(axis=0) for corner, count in zip(corners, counts, strict=True)])
        if len(values) == len(self.nodes):
            place = dict(zip(self.nodes.tolist(), range(len(self.nodes)), strict=True))
            return np.array([values[[place[node] for node in facet.tolist()]].mean(axis=0) for facet in self.facets])
        if len(values) == 1:
            return np.repeat(values, len(counts), axis=0)
        raise ValueError(f"{len(values)} values on {len(counts)} facets with {len(self.nodes)} nodes")
