"""Two bodies to press together: a slab, and a block above it with a flat or curved lower face, of any elements."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from harness.arrays import Ids
from harness.models.blocks import FACES, TET_FACES, Body
from harness.models.mesh import Mesh, Nodes, Part
from studies.models.assembly import box
from studies.models.quadratic import quadratic
from studies.models.tetrahedra import tetrahedra

SLAB, BLOCK = "slab", "block"
BASE, LOADED = "slab-base", "block-loaded"  # surfaces and node sets: what is held, and what is moved or loaded
UPPER, LOWER = "slab-contact", "block-contact"  # the surfaces in contact
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


_PENTA_FACES = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2))
FACES_OF: dict[int, tuple[tuple[int, ...], ...]] = {4: TET_FACES, 6: _PENTA_FACES, 8: FACES}
"""By the number of corners of an element: corners of its faces, counterclockwise seen from outside."""


def cut(body: Body, element: str) -> Body:
    """Hexahedra cut into the corners of an element: six tetrahedra, two upright prisms, or as they are."""
    if element.startswith("tet"):
        return tetrahedra(body)
    if not element.startswith("penta"):
        return body
    halves = np.array([(0, 1, 3, 4, 5, 7), (1, 2, 3, 5, 6, 7)])
    return Body(body.nodes, np.asarray(body.elements[:, halves].reshape(-1, 6), dtype=np.int64))


def _facets(body: Body, height: float) -> Ids:
    """Facets, numbered from 0, whose nodes all lie in the plane z = `height`."""
    rows = [[int(ids[a]) for a in face] for ids in body.elements for face in FACES_OF[body.elements.shape[1]]]
    kept = [row for row in rows if np.allclose(body.nodes[row, 2], height)]
    return np.array([row for row in kept if len(row) == len(kept[0])], dtype=np.int64)


@dataclass(frozen=True)
class Cells:
    """Hexahedra along the edges of slab and block, before they are cut into others."""

    slab: int = 6
    block: int = 5
    high: int = 2

    def times(self, fineness: int) -> Cells:
        """So many times as many."""
        return Cells(self.slab * fineness, self.block * fineness, self.high * fineness)


def mesh(kind: Elements, shape: Shape, primary: str, gap: float, cells: Cells = Cells()) -> Mesh:
    """Slab (3 x 3 x 1 mm) and block (2 x 2 x 0.8 mm) at a distance `gap` (mm), whose meshes do not match."""
    slab = cut(box((-1.5, -1.5, 0.0), (1.5, 1.5, 1.0), (cells.slab, cells.slab, cells.high)), kind.value)
    block = cut(box((-1.0, -1.0, 0.0), (1.0, 1.0, 1.0), (cells.block, cells.block, cells.high)), kind.value)
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
