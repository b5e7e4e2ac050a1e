"""Meshes of a round body above a slab: a quarter disk one element thick, or an eighth of a ball."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from harness.errors import ModelError
from harness.models import blocks
from harness.models.blocks import Body
from harness.models.mesh import Ids, Mesh, Part

Points = NDArray[np.float64]

CORE = 0.52
"""Size of the inner block of an O-grid, relative to the radius."""
BULGE = 0.35
"""How far the inner block leans towards the round shape: 0 a cube, 1 a ball."""
NEAR = 1e-9
"""Tolerance for positions, mm."""


class Primary(str, Enum):
    """Which body has the primary surface."""

    CYLINDER = "cylinder"
    SLAB = "slab"


@dataclass(frozen=True)
class Grid:
    """Sizes and numbers of elements.

    Attributes
    ----------
    radius, width, height : float
        Radius of the round body, half-width and height of the slab, mm.
    thickness : float
        Thickness of the plane problem, mm.
    across, down : int
        Elements of the slab over its half-width and its height.
    around : int
        Elements of each block of the O-grid along each edge; an arc of 90 degrees has twice as many.
    nodes : int
        8 or 20 nodes an element.
    solid : bool
        Whether this is the three-dimensional problem: an eighth of a ball on a quarter of a square slab.
    side : bool
        Whether the slab's free side belongs to its contact surface.
    """

    radius: float = 3.0
    width: float = 3.0
    height: float = 2.0
    thickness: float = 0.25
    across: int = 18
    down: int = 12
    around: int = 6
    nodes: int = 8
    solid: bool = False
    side: bool = False

    def __post_init__(self) -> None:
        """Refuse what is not a grid."""
        if min(self.across, self.down, self.around) < 1 or self.nodes not in (8, 20):
            raise ModelError(
                f"a grid needs at least one element each way and 8 or 20 nodes an element, got {self.across} x "
                f"{self.down}, {self.around}, {self.nodes}"
            )


def mesh(grid: Grid, primary: Primary = Primary.CYLINDER) -> Mesh:
    """Slab and round body, touching at x = 0 (and z = 0) at the height of the slab.

    Returns
    -------
    Mesh
        Parts ``slab`` and ``cylinder``; node sets ``all``, ``slab``, ``cylinder``, ``bottom`` (of the slab), ``top``
        (flat, of the round body), ``symmetry`` (x = 0), and for the three-dimensional problem ``symmetry-z``; surfaces
        ``slab-contact``, ``cylinder-contact``, ``bottom`` and ``top``; one pair ``contact``.
    """
    slab, round_body = slab_body(grid), cylinder_body(grid)
    offset = len(slab.nodes)
    nodes = np.concatenate([slab.nodes, round_body.nodes])
    parts = (Part("slab", "slab", slab.elements + 1), Part("cylinder", "cylinder", round_body.elements + offset + 1))
    surfaces = {
        "slab-contact": blocks.facets_where(slab, lambda x: _wetted(grid, x)) + 1,
        "cylinder-contact": blocks.facets_where(round_body, lambda x: _on_arc(grid, x)) + offset + 1,
        "bottom": blocks.facets_where(slab, lambda x: np.abs(x[..., 1]) < NEAR) + 1,
        "top": blocks.facets_where(round_body, lambda x: _is_top(grid, x)) + offset + 1,
    }
    # A facet of the slab may have its nodes on the top and on the side only where it is one element wide.
    sides = ("cylinder-contact", "slab-contact")
    pair = sides if primary is Primary.CYLINDER else sides[::-1]
    return Mesh(nodes, parts, _node_sets(grid, nodes, offset), surfaces, {"contact": pair})


def _node_sets(grid: Grid, nodes: Points, offset: int) -> dict[str, Ids]:
    number = np.arange(1, len(nodes) + 1, dtype=np.int64)
    sets = {
        "all": number,
        "slab": number[:offset],
        "cylinder": number[offset:],
        "bottom": np.unique(number[:offset][np.abs(nodes[:offset, 1]) < NEAR]),
        "top": number[offset:][_is_top(grid, nodes[offset:])],
        "symmetry": number[np.abs(nodes[:, 0]) < NEAR],
    }
    return sets | {"symmetry-z": number[np.abs(nodes[:, 2]) < NEAR]} if grid.solid else sets


def _wetted(grid: Grid, x: Points) -> NDArray[np.bool_]:
    """Positions on the slab's top, and on its free sides where they belong to the contact surface."""
    on = np.abs(x[..., 1] - grid.height) < NEAR
    if grid.side:
        on = on | (np.abs(x[..., 0] - grid.width) < NEAR)
    if grid.side and grid.solid:
        on = on | (np.abs(x[..., 2] - grid.width) < NEAR)
    return np.asarray(on)


def _on_arc(grid: Grid, x: Points) -> NDArray[np.bool_]:
    return np.asarray(np.abs(np.linalg.norm(_from_centre(grid, x), axis=-1) - grid.radius) < NEAR)


def _is_top(grid: Grid, x: Points) -> NDArray[np.bool_]:
    return np.asarray(np.abs(x[..., 1] - grid.height - grid.radius) < NEAR)


def _from_centre(grid: Grid, x: Points) -> Points:
    """Positions relative to the axis of the cylinder or the centre of the ball, mm."""
    relative = x - np.array([0.0, grid.height + grid.radius, 0.0])
    return np.asarray(relative if grid.solid else relative * np.array([1.0, 1.0, 0.0]))


def slab_body(grid: Grid) -> Body:
    """The slab, from x = 0 to its half-width and from y = 0 to its height."""
    x, y = np.linspace(0.0, grid.width, grid.across + 1), np.linspace(0.0, grid.height, grid.down + 1)
    z = x if grid.solid else np.array([0.0, grid.thickness])
    body = blocks.structured(np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1))
    return body if grid.nodes == 8 else blocks.quadratic(body)


def cylinder_body(grid: Grid) -> Body:
    """The round body, as an O-grid: an inner block and one block for each axis, between it and the arc."""
    axes = 3 if grid.solid else 2
    made = [_placed(grid, _inner(np.linspace(0.0, 1.0, grid.around + 1), axes))]
    made += [_placed(grid, _outer(np.linspace(0.0, 1.0, grid.around + 1), axes, axis)) for axis in range(axes)]
    body = blocks.merged([blocks.structured(points) for points in made])
    return body if grid.nodes == 8 else blocks.quadratic(body, lambda ends: _middles(grid, ends))


def _middles(grid: Grid, ends: Points) -> Points:
    """Middles of edges; of those that are chords of the arc, moved onto it."""
    middles = blocks.straight(ends)
    relative = _from_centre(grid, middles)
    distance = np.linalg.norm(relative, axis=1)
    chord = np.all(_on_arc(grid, ends), axis=1)
    factor = np.where(chord, grid.radius / np.where(chord, distance, 1.0), 1.0)
    return np.asarray(middles + (factor - 1.0)[:, None] * relative)


def _inner(steps: Points, axes: int) -> Points:
    """Inner block in the unit ball, shape (n + 1,) * axes + (axes,)."""
    q = np.stack(np.meshgrid(*[steps] * axes, indexing="ij"), axis=-1)
    return _bulged(q)


def _outer(steps: Points, axes: int, axis: int) -> Points:
    """Block between the inner block's face q[axis] = 1 and the unit sphere;  `axis` becomes the radius."""
    q = np.stack(np.meshgrid(*[steps] * axes, indexing="ij"), axis=-1)
    outward = q[..., axis : axis + 1].copy()
    q[..., axis] = 1.0
    return np.asarray((1.0 - outward) * _bulged(q) + outward * _direction(q))


def _bulged(q: Points) -> Points:
    """Positions in the inner block of a unit ball, of points of the unit cube."""
    size = np.max(q, axis=-1, keepdims=True)
    return np.asarray(CORE * ((1.0 - BULGE) * q + BULGE * size * _direction(q)))


def _direction(q: Points) -> Points:
    """Unit vectors at equal angles for equal steps over a face of the cube; zero at its corner q = 0."""
    size = np.max(q, axis=-1, keepdims=True)
    tangent = np.tan(np.pi / 4 * np.divide(q, size, out=np.zeros_like(q), where=size > 0.0))
    length = np.linalg.norm(tangent, axis=-1, keepdims=True)
    return np.asarray(np.divide(tangent, length, out=np.zeros_like(q), where=length > 0.0))


def _placed(grid: Grid, unit: Points) -> Points:
    """A block of the unit disk or ball at its place below the flat top, as an array of four dimensions."""
    top = grid.height + grid.radius
    if grid.solid:
        return np.asarray(np.array([0.0, top, 0.0]) + grid.radius * unit * np.array([1.0, -1.0, 1.0]))
    flat = np.array([0.0, top]) + grid.radius * unit * np.array([1.0, -1.0])
    return _extruded(flat, (0.0, grid.thickness))


def _extruded(flat: Points, heights: Sequence[float]) -> Points:
    """Points (..., 2) of a plane block, repeated at each height: (..., len(heights), 3)."""
    layers = [np.concatenate([flat, np.full_like(flat[..., :1], z)], axis=-1) for z in heights]
    return np.stack(layers, axis=-2)


def disk(radius: float, around: int, heights: Sequence[float]) -> Body:
    """A quarter of an upright cylinder about the z axis, as an O-grid with `around` hex8 along each edge."""
    steps = np.linspace(0.0, 1.0, around + 1)
    flat = [_inner(steps, 2), *(_outer(steps, 2, axis) for axis in range(2))]
    return blocks.merged([blocks.structured(_extruded(radius * unit, heights)) for unit in flat])
