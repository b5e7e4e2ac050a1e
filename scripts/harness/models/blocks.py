"""Meshes put together from mapped blocks: merging, boundary facets."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from harness.arrays import Array, Ids, Mask
from harness.models.mesh import Nodes

Points = Array

FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
"""Corners (from 0) of the faces of a hex8 in FEBio's order, counterclockwise seen from outside."""
TET_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))  # the same of a tet4
EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
"""Ends of the edges on which nodes 9 to 20 of FEBio's hex20 lie."""


@dataclass(frozen=True)
class Body:
    """The elements of one body."""

    nodes: Nodes  # shape (n_nodes, 3): mm
    elements: Ids  # shape (n_elements, 4, 6 or 8): node numbers from 0


def structured(points: Points) -> Body:
    """One block of nodes (mm), shape (n_i + 1, n_j + 1, n_k + 1, 3); a left-handed one is turned over."""
    if _is_left_handed(points):
        points = points[:, :, ::-1]
    number = np.arange(points[..., 0].size, dtype=np.int64).reshape(points.shape[:3])
    low, high = slice(None, -1), slice(1, None)
    corners = [number[i, j, k] for k in (low, high) for i, j in ((low, low), (high, low), (high, high), (low, high))]
    return Body(points.reshape(-1, 3), np.stack([corner.ravel() for corner in corners], axis=1))


def _is_left_handed(points: Points) -> bool:
    edges = (points[1, 0, 0], points[0, 1, 0], points[0, 0, 1])
    return bool(np.linalg.det(np.stack([edge - points[0, 0, 0] for edge in edges])) < 0.0)


def merged(bodies: Sequence[Body]) -> Body:
    """One body, in which nodes nearer than 1e-9 mm to each other are one node."""
    nodes = np.concatenate([body.nodes for body in bodies])
    offsets = np.cumsum([0, *(len(body.nodes) for body in bodies[:-1])])
    elements = np.concatenate([body.elements + offset for body, offset in zip(bodies, offsets, strict=True)])
    kept, number = joined(nodes, 1e-9)
    return Body(kept, number[elements])


def joined(nodes: Nodes, tolerance: float) -> tuple[Nodes, Ids]:
    """Nodes without those nearer than `tolerance` (mm) to an earlier one, and the place of each among these."""
    same = np.arange(len(nodes))
    for low, high in sorted(cKDTree(nodes).query_pairs(tolerance)):
        same[high] = same[low]
    kept, number = np.unique(same, return_inverse=True)
    return nodes[kept], np.asarray(number, dtype=np.int64)


def boundary(body: Body) -> Ids:
    """Outer facets of a body of tet4 or hex8, shape (n_facets, 3 or 4), counterclockwise seen from outside."""
    faces = np.array(TET_FACES if body.elements.shape[1] == 4 else FACES)
    facets = body.elements[:, faces].reshape(-1, faces.shape[1])
    _, index, count = np.unique(np.sort(facets, axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(facets[np.sort(index[count == 1])], dtype=np.int64)


def facets_where(body: Body, inside: Callable[[Points], Mask]) -> Ids:
    """Outer facets whose nodes all satisfy `inside`, a function of positions of shape (..., 3)."""
    facets = boundary(body)
    return np.asarray(facets[np.all(inside(body.nodes[facets]), axis=1)], dtype=np.int64)
