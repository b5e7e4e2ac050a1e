"""Two bodies to press together: a slab, and a block above it with a flat or curved lower face, of any elements."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from itertools import permutations

import numpy as np

from harness.models.blocks import FACES, TET_FACES, structured
from harness.models.mesh import Ids, Mesh, Nodes, Part
from harness.models.quadratic import quadratic

SLAB, BLOCK = "slab", "block"
BASE, LOADED = "slab-base", "block-loaded"
"""Surfaces and node sets: what is held, and what is moved or loaded."""
UPPER, LOWER = "slab-contact", "block-contact"
"""The surfaces in contact."""
PAIR = "contact"


class Elements(str, Enum):
    """Elements of both bodies."""

    HEX8 = "hex8"
    HEX20 = "hex20"
    HEX27 = "hex27"
    PENTA6 = "penta6"
    TET4 = "tet4"
    TET10 = "tet10"


class Shape(Enum):
    """The lower face of the block: its height over its lowest point, mm, at (x, y)."""

    FLAT = "flat"
    CYLINDER = "cylinder"
    SPHERE = "sphere"

    def height(self, x: Nodes, y: Nodes) -> Nodes:
        """Radius 3 mm, as a parabola."""
        if self is Shape.FLAT:
            return np.zeros_like(x)
        return x**2 / 6.0 if self is Shape.CYLINDER else (x**2 + y**2) / 6.0


@dataclass(frozen=True)
class _Body:
    nodes: Nodes
    elements: Ids


_PENTA_FACES = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2))
_FACES_OF: dict[int, tuple[tuple[int, ...], ...]] = {4: TET_FACES, 6: _PENTA_FACES, 8: FACES}
_CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])


def _tetrahedra(hexahedra: Ids) -> Ids:
    """Six around the diagonal of each hexahedron, the same in all, so that faces match."""
    number = {tuple(corner): n for n, corner in enumerate(_CORNERS.tolist())}
    unit = np.eye(3, dtype=np.int64)
    rows = []
    for order in permutations(range(3)):
        path = np.cumsum([np.zeros(3, dtype=np.int64), *(unit[axis] for axis in order)], axis=0)
        ids = [number[tuple(point)] for point in path.tolist()]
        edges = path[1:] - path[0]
        rows.append(ids if np.linalg.det(edges) > 0 else [ids[0], ids[2], ids[1], ids[3]])
    return np.asarray(hexahedra[:, np.array(rows)].reshape(-1, 4), dtype=np.int64)


def _prisms(hexahedra: Ids) -> Ids:
    """Two upright ones in each hexahedron."""
    halves = np.array([(0, 1, 3, 4, 5, 7), (1, 2, 3, 5, 6, 7)])
    return np.asarray(hexahedra[:, halves].reshape(-1, 6), dtype=np.int64)


def _grid(low: tuple[float, ...], high: tuple[float, ...], cells: tuple[int, ...]) -> _Body:
    axes = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, cells, strict=True)]
    made = structured(np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1))
    return _Body(made.nodes, made.elements)


def _of(kind: Elements, hexahedra: Ids) -> Ids:
    if kind in (Elements.TET4, Elements.TET10):
        return _tetrahedra(hexahedra)
    return _prisms(hexahedra) if kind is Elements.PENTA6 else hexahedra


def _facets(body: _Body, height: float) -> Ids:
    """Facets, numbered from 0, whose nodes all lie in the plane z = `height`."""
    rows = [[int(ids[a]) for a in face] for ids in body.elements for face in _FACES_OF[body.elements.shape[1]]]
    kept = [row for row in rows if np.allclose(body.nodes[row, 2], height)]
    return np.array([row for row in kept if len(row) == len(kept[0])], dtype=np.int64)


def mesh(kind: Elements, shape: Shape, primary: str, gap: float, fineness: int = 1) -> Mesh:
    """Slab (3 x 3 x 1 mm) and block (2 x 2 x 0.8 mm) at a distance `gap` (mm), whose meshes do not match; `fineness`
    times as many elements along each edge.
    """
    slab = _grid((-1.5, -1.5, 0.0), (1.5, 1.5, 1.0), (6 * fineness, 6 * fineness, 2 * fineness))
    block = _grid((-1.0, -1.0, 0.0), (1.0, 1.0, 1.0), (5 * fineness, 5 * fineness, 2 * fineness))
    slab = _Body(slab.nodes, _of(kind, slab.elements))
    block = _Body(block.nodes, _of(kind, block.elements))
    surfaces = {
        UPPER: (slab, 1.0, 0),
        BASE: (slab, 0.0, 0),
        LOWER: (block, 0.0, len(slab.nodes)),
        LOADED: (block, 1.0, len(slab.nodes)),
    }
    facets = {name: _facets(body, height) + first + 1 for name, (body, height, first) in surfaces.items()}
    sets = {name: np.unique(ids) for name, ids in facets.items()}
    all_of = {SLAB: np.arange(1, len(slab.nodes) + 1), BLOCK: len(slab.nodes) + 1 + np.arange(len(block.nodes))}
    nodes = np.concatenate([slab.nodes, _placed(block.nodes, shape, gap)])
    parts = (Part(SLAB, SLAB, slab.elements + 1), Part(BLOCK, BLOCK, block.elements + 1 + len(slab.nodes)))
    pair = (LOWER, UPPER) if primary == LOWER else (UPPER, LOWER)
    linear = Mesh(nodes, parts, sets | all_of, facets, {PAIR: pair})
    added = {Elements.HEX20: 20, Elements.HEX27: 27, Elements.TET10: 10}.get(kind)
    return quadratic(linear, added) if added else linear


def _placed(unit: Nodes, shape: Shape, gap: float) -> Nodes:
    """The block above the slab: its top is flat, its lower face has the shape."""
    below = shape.height(unit[:, 0], unit[:, 1])
    z = 1.0 + gap + below + unit[:, 2] * (0.8 - below)
    return np.column_stack([unit[:, :2], z])
