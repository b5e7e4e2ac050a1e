"""Bodies of any element as mapped grids, with the sides that contacts and loads name."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from harness.models import blocks
from harness.models.blocks import Body
from harness.models.mesh import Nodes
from studies.models import assembly
from studies.models.quadratic import ADDED
from studies.synthetic_scenes.slab_and_block import FACES_OF, cut

Place = Callable[[Nodes], Nodes]  # positions (n, 3) in mm of points (n, 3) of the unit cube
Facets = list[tuple[int, ...]]
Group = tuple[int, ...]

_TET_MIDDLES: tuple[Group, ...] = ((2, 1, 0), (0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 1, 2, 3))
MIDDLES: Mapping[str, tuple[Group, ...]] = {
    "hex8": (),
    "hex20": ADDED[20],
    "hex27": ADDED[27],
    "tet4": (),
    "tet10": ADDED[10],
    "tet15": (*ADDED[10], *_TET_MIDDLES),
    "penta6": (),
    "penta15": ADDED[15],
}
"""By the type of element: the corners in whose middle each further node lies, in FEBio's order."""
NEAR = 1e-9  # tolerance for positions, mm, and in the unit cube


@dataclass(frozen=True)
class Shape:
    """A body."""

    element: str  # FEBio's name of its elements
    nodes: Nodes  # mm. Shape (n, 3)
    elements: Facets  # nodes of each element, from 0
    sides: Mapping[str, Facets] = field(default_factory=dict)
    """Facets of each side, nodes from 0: ``x0``, ``x1``, ... where a coordinate of the unit cube is 0 or 1, and
    ``outside``; of a shell ``face`` and ``back``, and its edges as lists of nodes."""
    thickness: float = 0.0  # of a shell, mm; 0 of a solid


def grid(cells: Sequence[int]) -> Body:
    """The unit cube in hexahedra."""
    return assembly.box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), cells)


def mapped(cells: Sequence[int], place: Place, element: str = "hex8") -> Shape:
    """The unit cube put elsewhere, in elements of a type; places that meet, as the ends of a ring do, are joined."""
    return joined([cut(grid(cells), element)], [place], element)


def joined(bodies: Sequence[Body], places: Sequence[Place], element: str) -> Shape:
    """Several mapped grids in one body: nodes at the same position are one."""
    nodes, elements, faces = [], [], []
    first = 0
    for body, place in zip(bodies, places, strict=True):
        unit, rows = _with_middles(body, element)
        own = place(unit)
        assert _is_right_handed(own[list(rows[0])], element), "the map turns elements over"
        elements += [tuple(first + n for n in row) for row in rows]
        faces += [(side, tuple(first + n for n in facet)) for side, facet in _faces(unit, rows, element)]
        nodes.append(own)
        first += len(own)
    kept, number = blocks.joined(np.concatenate(nodes), NEAR)
    whole = [tuple(int(number[n]) for n in row) for row in elements]
    return Shape(element, kept, whole, _sides([(side, tuple(int(number[n]) for n in f)) for side, f in faces]))


def _with_middles(body: Body, element: str) -> tuple[Nodes, Facets]:
    nodes, number = list(body.nodes), dict[frozenset[int], int]()
    rows: Facets = []
    for ids in body.elements.tolist():
        keys = [frozenset(ids[corner] for corner in group) for group in MIDDLES[element]]
        for key in keys:
            if key not in number:
                number[key] = len(nodes)
                nodes.append(np.mean([body.nodes[n] for n in key], axis=0))
        rows.append((*ids, *(number[key] for key in keys)))
    return np.array(nodes), rows


def _is_right_handed(nodes: Nodes, element: str) -> bool:
    along = (1, 3, 4) if element.startswith("hex") else (1, 2, 3)
    return bool(np.linalg.det(np.stack([nodes[k] - nodes[0] for k in along])) > 0.0)


def _faces(unit: Nodes, rows: Facets, element: str) -> list[tuple[str, tuple[int, ...]]]:
    """Every face of every element, with the side of the unit cube that it lies in, or an empty name."""
    corners = {"hex": 8, "tet": 4, "pen": 6}[element[:3]]
    found = []
    for row in rows:
        middle = dict(zip((frozenset(group) for group in MIDDLES[element]), row[corners:], strict=True))
        for face in FACES_OF[corners]:
            ends = [middle.get(frozenset(edge)) for edge in pairwise([*face, face[0]])]
            centre = middle.get(frozenset(face)) if len(ends) == len(face) else None
            added = [n for n in (*ends, centre) if n is not None]
            found.append((_side(unit[[row[k] for k in face]]), (*(row[k] for k in face), *added)))
    return found


def _side(points: Nodes) -> str:
    for axis, name in enumerate("xyz"):
        for end in (0, 1):
            if np.all(np.abs(points[:, axis] - end) < NEAR):
                return f"{name}{end}"
    return ""


def _sides(faces: list[tuple[str, tuple[int, ...]]]) -> dict[str, Facets]:
    count = Counter(frozenset(facet) for _, facet in faces)
    outer = [(side, facet) for side, facet in faces if count[frozenset(facet)] == 1]
    names = sorted({side for side, _ in outer if side})
    return {name: [f for side, f in outer if side == name] for name in names} | {"outside": [f for _, f in outer]}


def where(shape: Shape, **chosen: Callable[[Nodes], np.ndarray]) -> Shape:
    """The same body with further sides: outer facets whose nodes all satisfy a condition on positions (..., 3)."""
    outer = shape.sides["outside"]
    further = {name: [f for f in outer if np.all(inside(shape.nodes[list(f)]))] for name, inside in chosen.items()}
    return replace(shape, sides={**shape.sides, **further})


def union(shape: Shape, name: str, *sides: str) -> Shape:
    """The same body with a further side made of others."""
    facets = [facet for side in sides for facet in shape.sides[side]]
    return replace(shape, sides={**shape.sides, name: facets})


def shell(cells: tuple[int, int], place: Place, thickness: float, element: str = "quad4") -> Shape:
    """A shell over the unit square; `place` takes points (n, 3) whose last coordinate is 0."""
    nx, ny = cells
    x, y = np.meshgrid(np.linspace(0, 1, nx + 1), np.linspace(0, 1, ny + 1), indexing="ij")
    number = np.arange(x.size).reshape(x.shape)
    unit = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    a, b = slice(None, -1), slice(1, None)
    quads = np.stack([number[i, j].ravel() for i, j in ((a, a), (b, a), (b, b), (a, b))], axis=1)
    rows: Facets = [tuple(map(int, quad)) for quad in quads]
    if element == "tri3":
        rows = [tri for q in rows for tri in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
    ends = {"x0": number[0], "x1": number[-1], "y0": number[:, 0], "y1": number[:, -1]}
    edges = {name: [tuple(map(int, ids))] for name, ids in ends.items()}
    back = [facet[::-1] for facet in rows]
    return Shape(element, place(unit), rows, {"face": rows, "back": back, **edges}, thickness)


def box(low: Sequence[float], high: Sequence[float]) -> Place:
    """A box between two corners, mm."""
    a, b = np.array(low, dtype=float), np.array(high, dtype=float)
    return lambda u: np.asarray(a + u * (b - a))


def arc(
    inner: float, outer: float, length: float, angles: tuple[float, float] = (0.0, 360.0), flare: float = 0.0
) -> Place:
    """A ring or part of one around the z axis, in the middle of `length`: x goes outwards, y around, z along.

    inner, outer, length: mm.
    angles: degrees from the x axis.
    flare: by how much (mm) both radii grow from the first end to the last.
    """
    begin, end = np.radians(angles)

    def place(u: Nodes) -> Nodes:
        radius = inner + u[:, 0] * (outer - inner) + flare * u[:, 2]
        turn = begin + u[:, 1] * (end - begin)
        return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), (u[:, 2] - 0.5) * length])

    return place


def ball(radius: float, roundness: float = 0.9) -> Place:
    """A cube whose faces bulge to a sphere; 1 is a sphere, whose eight corners are flat."""

    def place(u: Nodes) -> Nodes:
        c = 2.0 * u - 1.0
        s = c**2
        full = np.column_stack(
            [
                c[:, k] * np.sqrt(1.0 - s[:, i] / 2.0 - s[:, j] / 2.0 + s[:, i] * s[:, j] / 3.0)
                for k, i, j in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
            ]
        )
        return np.asarray(radius * (roundness * full + (1.0 - roundness) * c / np.sqrt(3.0)))

    return place


def sheet(line: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]], width: float, thickness: float) -> Place:
    """A sheet along a line in the x-z plane: x along, y across, z through.

    `line` gives points (n, 2) and unit normals (n, 2), to the left of the way, of places 0 to 1 along it.
    """

    def place(u: Nodes) -> Nodes:
        points, normals = line(u[:, 0])
        at = points + normals * ((u[:, 2] - 0.5) * thickness)[:, None]
        return np.column_stack([at[:, 0], (u[:, 1] - 0.5) * width, at[:, 1]])

    return place


def turned(place: Place, axis: str, degrees: float) -> Place:
    """The same turned about an axis through the origin."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    turn = np.eye(3)
    turn[i, i] = turn[j, j] = c
    turn[i, j], turn[j, i] = -s, s
    return lambda u: np.asarray(place(u) @ turn.T)


def shifted(place: Place, by: Sequence[float]) -> Place:
    """The same moved, mm."""
    return lambda u: np.asarray(place(u) + np.array(by, dtype=float))


def scaled(place: Place, factors: float | Sequence[float]) -> Place:
    """The same in another unit of length, or stretched along x, y and z."""
    return lambda u: np.asarray(place(u) * np.array(factors))


def bulged(place: Place, rise: Callable[[Nodes], np.ndarray]) -> Place:
    """The same with its lower face raised by a function (mm) of the position, and the top as it is."""

    def moved(u: Nodes) -> Nodes:
        points = place(u)
        up = rise(points) * (1.0 - u[:, 2])
        return np.asarray(points + np.column_stack([np.zeros((len(u), 2)), up]))

    return moved
