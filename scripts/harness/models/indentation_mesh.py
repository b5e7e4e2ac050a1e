"""Meshes of a round body above a slab: a quarter disk, one element thick."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from harness.arrays import Array, Ids, Mask
from harness.errors import ModelError
from harness.models import blocks
from harness.models.blocks import Body
from harness.models.mesh import Mesh, Part

CORE = 0.52  # size of the inner block of an O-grid, relative to the radius
BULGE = 0.35  # how far the inner block leans towards the round shape: 0 a square, 1 a disk
NEAR = 1e-9  # tolerance for positions, mm


class Primary(str, Enum):
    """Which body has the primary surface."""

    CYLINDER = "cylinder"
    SLAB = "slab"


@dataclass(frozen=True)
class Grid:
    """Sizes and numbers of elements."""

    # Radius of the round body, half-width and height of the slab, mm.
    radius: float = 3.0
    width: float = 3.0
    height: float = 2.0
    thickness: float = 0.25  # thickness of the plane problem, mm
    # Elements of the slab over its half-width and its height.
    across: int = 18
    down: int = 12
    around: int = 6  # elements of each block of the O-grid along each edge; an arc of 90 degrees has twice as many

    def __post_init__(self) -> None:
        """Refuse what is not a grid."""
        if min(self.across, self.down, self.around) < 1:
            raise ModelError(
                f"a grid needs at least one element each way, got {self.across} x {self.down}, {self.around}"
            )


def mesh(grid: Grid, primary: Primary = Primary.CYLINDER) -> Mesh:
    """Slab and round body, touching at x = 0 at the height of the slab.

    Returns: parts ``slab`` and ``cylinder``; node sets ``all``, ``slab``, ``cylinder``, ``bottom`` (of the slab),
        ``top`` (flat, of the round body), ``symmetry`` (x = 0); surfaces ``slab-contact``, ``cylinder-contact``,
        ``bottom`` and ``top``; one pair ``contact``.
    """
    slab, round_body = slab_body(grid), cylinder_body(grid)
    offset = len(slab.nodes)
    nodes = np.concatenate([slab.nodes, round_body.nodes])
    parts = (Part("slab", "slab", slab.elements + 1), Part("cylinder", "cylinder", round_body.elements + offset + 1))
    surfaces = {
        "slab-contact": blocks.facets_where(slab, lambda x: np.abs(x[..., 1] - grid.height) < NEAR) + 1,
        "cylinder-contact": blocks.facets_where(round_body, lambda x: _on_arc(grid, x)) + offset + 1,
        "bottom": blocks.facets_where(slab, lambda x: np.abs(x[..., 1]) < NEAR) + 1,
        "top": blocks.facets_where(round_body, lambda x: _is_top(grid, x)) + offset + 1,
    }
    sides = ("cylinder-contact", "slab-contact")
    pair = sides if primary is Primary.CYLINDER else sides[::-1]
    return Mesh(nodes, parts, _node_sets(grid, nodes, offset), surfaces, {"contact": pair})


def _node_sets(grid: Grid, nodes: Array, offset: int) -> dict[str, Ids]:
    number = np.arange(1, len(nodes) + 1, dtype=np.int64)
    return {
        "all": number,
        "slab": number[:offset],
        "cylinder": number[offset:],
        "bottom": np.unique(number[:offset][np.abs(nodes[:offset, 1]) < NEAR]),
        "top": number[offset:][_is_top(grid, nodes[offset:])],
        "symmetry": number[np.abs(nodes[:, 0]) < NEAR],
    }


def _on_arc(grid: Grid, x: Array) -> Mask:
    distance = np.hypot(x[..., 0], x[..., 1] - grid.height - grid.radius)
    return np.asarray(np.abs(distance - grid.radius) < NEAR)


def _is_top(grid: Grid, x: Array) -> Mask:
    return np.asarray(np.abs(x[..., 1] - grid.height - grid.radius) < NEAR)


def slab_body(grid: Grid) -> Body:
    """The slab, from x = 0 to its half-width and from y = 0 to its height."""
    x, y = np.linspace(0.0, grid.width, grid.across + 1), np.linspace(0.0, grid.height, grid.down + 1)
    z = np.array([0.0, grid.thickness])
    return blocks.structured(np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1))


def cylinder_body(grid: Grid) -> Body:
    """The round body, as an O-grid."""
    top = grid.height + grid.radius
    flat = [np.array([0.0, top]) + grid.radius * unit * np.array([1.0, -1.0]) for unit in _quarter_disk(grid.around)]
    return blocks.merged([blocks.structured(_extruded(points, (0.0, grid.thickness))) for points in flat])


def _quarter_disk(around: int) -> list[Array]:
    """An O-grid of the unit disk: an inner block and one block for each axis, between it and the arc."""
    steps = np.linspace(0.0, 1.0, around + 1)
    q = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1)
    return [_bulged(q), *(_outer(q, axis) for axis in range(2))]


def _outer(q: Array, axis: int) -> Array:
    """Block between the inner block's face q[axis] = 1 and the unit circle;  `axis` becomes the radius."""
    outward, face = q[..., axis : axis + 1], q.copy()
    face[..., axis] = 1.0
    return np.asarray((1.0 - outward) * _bulged(face) + outward * _direction(face))


def _bulged(q: Array) -> Array:
    """Positions in the inner block of the unit disk, of points of the unit square."""
    size = np.max(q, axis=-1, keepdims=True)
    return np.asarray(CORE * ((1.0 - BULGE) * q + BULGE * size * _direction(q)))


def _direction(q: Array) -> Array:
    """Unit vectors at equal angles for equal steps along an edge of the square; zero at its corner q = 0."""
    size = np.max(q, axis=-1, keepdims=True)
    tangent = np.tan(np.pi / 4 * np.divide(q, size, out=np.zeros_like(q), where=size > 0.0))
    length = np.linalg.norm(tangent, axis=-1, keepdims=True)
    return np.asarray(np.divide(tangent, length, out=np.zeros_like(q), where=length > 0.0))


def _extruded(flat: Array, heights: Sequence[float]) -> Array:
    """Points (..., 2) of a plane block, repeated at each height: (..., len(heights), 3)."""
    layers = [np.concatenate([flat, np.full_like(flat[..., :1], z)], axis=-1) for z in heights]
    return np.stack(layers, axis=-2)


def disk(radius: float, around: int, heights: Sequence[float]) -> Body:
    """A quarter of an upright cylinder about the z axis, as an O-grid with `around` hex8 along each edge."""
    return blocks.merged([blocks.structured(_extruded(radius * unit, heights)) for unit in _quarter_disk(around)])
