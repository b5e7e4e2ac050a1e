"""Meshes of linear elements made quadratic: nodes in the middle of edges, and of faces and elements where asked for."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from harness.arrays import Ids
from harness.models.blocks import EDGES
from harness.models.mesh import Mesh, Nodes, Part

Group = tuple[int, ...]

_PRISM = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
_FACES = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (0, 3, 2, 1), (4, 5, 6, 7))
_TETRAHEDRON = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
ADDED: dict[int, tuple[Group, ...]] = {10: _TETRAHEDRON, 15: _PRISM, 20: EDGES, 27: (*EDGES, *_FACES, tuple(range(8)))}
"""By the nodes of an element: the corners in whose middle each node after the corners lies, in FEBio's order."""


class Middles:
    """Nodes in the middle of groups of others, each made once."""

    def __init__(self, nodes: Nodes) -> None:
        self.positions = list(nodes)
        self.of: dict[frozenset[int], int] = {}

    def __call__(self, corners: Sequence[int]) -> int:
        """Number, from 1, of the node in the middle of others."""
        key = frozenset(corners)
        if key not in self.of:
            self.positions.append(np.mean([self.positions[corner - 1] for corner in corners], axis=0))
            self.of[key] = len(self.positions)
        return self.of[key]

    def grown(self, ids: Iterable[int]) -> list[int]:
        """A set of nodes with the new ones of which all that they lie between are in it."""
        own = frozenset(ids)
        return sorted(own | {node for corners, node in self.of.items() if corners <= own})


def quadratic(mesh: Mesh, nodes: int) -> Mesh:
    """The same mesh with quadratic elements.

    mesh: of hex8, penta6 and tet4.
    nodes: of a hexahedron, 20 or 27. Prisms have 15, so their quadrilateral faces suit 20; tetrahedra have 10.
    Returns: a new node is in a set if all nodes that it lies between are.
    """
    middle = Middles(mesh.nodes)
    parts = tuple(_part(part, nodes, middle) for part in mesh.parts)
    surfaces = {name: _facets(facets, nodes, middle) for name, facets in mesh.surfaces.items()}
    sets = {name: np.array(middle.grown(ids.tolist()), dtype=np.int64) for name, ids in mesh.node_sets.items()}
    return replace(mesh, nodes=np.array(middle.positions), parts=parts, node_sets=sets, surfaces=surfaces)


def _part(part: Part, nodes: int, middle: Middles) -> Part:
    added = ADDED[{4: 10, 6: 15}.get(part.elements.shape[1], nodes)]
    rows = [[*ids, *(middle([ids[corner] for corner in group]) for group in added)] for ids in part.elements.tolist()]
    return replace(part, elements=np.array(rows, dtype=np.int64))


def _facets(facets: Ids, nodes: int, middle: Middles) -> Ids:
    rows = []
    for corners in facets.tolist():
        edges = [middle(ends) for ends in pairwise([*corners, corners[0]])]
        centre = [middle(corners)] if nodes == 27 and len(corners) == 4 else []
        rows.append([*corners, *edges, *centre])
    return np.array(rows, dtype=np.int64)
