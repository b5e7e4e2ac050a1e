"""FEBio's element types: how many nodes they have, and which corners their faces have.

Written here and not taken from meshio, whose tables know nodes but no faces, and no names of FEBio's.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from harness.arrays import Array, Ids

_HEX = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (0, 3, 2, 1), (4, 5, 6, 7))
_PENTA = ((0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2), (0, 2, 1), (3, 4, 5))
_TET = ((0, 1, 3), (1, 2, 3), (2, 0, 3), (2, 1, 0))
_PYRAMID = ((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (3, 2, 1, 0))


@dataclass(frozen=True)
class Shape:
    """An element type."""

    nodes: int
    # Local numbers of the corners of each face, counter-clockwise seen from outside; none for shells and lines.
    faces: tuple[tuple[int, ...], ...] = ()

    @property
    def corner_faces(self) -> Ids:
        """The faces as an array, shape (n_faces, 4); a triangle repeats its last corner."""
        return np.array([four(face) for face in self.faces], dtype=np.int64)


SHAPES = {
    "hex8": Shape(8, _HEX),
    "hex20": Shape(20, _HEX),
    "hex27": Shape(27, _HEX),
    "penta6": Shape(6, _PENTA),
    "penta15": Shape(15, _PENTA),
    "tet4": Shape(4, _TET),
    "tet5": Shape(5, _TET),
    "tet10": Shape(10, _TET),
    "tet15": Shape(15, _TET),
    "tet20": Shape(20, _TET),
    "pyra5": Shape(5, _PYRAMID),
    "pyra13": Shape(13, _PYRAMID),
    "ut4": Shape(4, _TET),
    **{name: Shape(3) for name in ("tri3", "tri3s")},
    **{name: Shape(4) for name in ("quad4", "q4ans", "q4eas", "q4s")},
    **{name: Shape(count) for name, count in (("tri6", 6), ("quad8", 8), ("quad9", 9))},
    **{name: Shape(count) for name, count in (("truss2", 2), ("line2", 2), ("line3", 3))},
}
"""By FEBio's name."""

_WITH_RULE = re.compile(r"((?:HEX|TET|PENTA|QUAD|TRI)\d+)G\w+")

FACETS = {"tri3": 3, "tri6": 6, "tri7": 7, "quad4": 4, "quad8": 8, "quad9": 9}
"""Number of nodes of FEBio's surface facets."""


def shape(name: str) -> Shape | None:
    """The shape of an element type, also where it names its integration rule as ``TET10G8`` does; None if unknown."""
    with_rule = _WITH_RULE.fullmatch(name)
    return SHAPES.get(with_rule.group(1).lower() if with_rule else name)


def four(corners: Sequence[int]) -> tuple[int, ...]:
    """Corners of a face as four numbers: a triangle repeats its last one."""
    return tuple(corners) if len(corners) == 4 else (*corners, corners[-1])


def area_vectors(corners: Array) -> Array:
    """Area times outward normal of faces, shape (..., 3), from their corners, (..., 4, 3): half the cross product of
    the diagonals, which holds for triangles with a repeated corner as well.
    """
    return np.asarray(0.5 * np.cross(corners[..., 2, :] - corners[..., 0, :], corners[..., 3, :] - corners[..., 1, :]))


def volumes(faces: Array) -> Array:
    """Volumes of elements with straight edges, shape (n,), from the corners of their faces, (n, n_faces, 4, 3): the
    divergence theorem, a third of the flux of x.
    """
    centres = faces.mean(axis=-2)
    triangles = faces[..., 2, :] == faces[..., 3, :]
    thirds = np.where(triangles.all(axis=-1)[..., None], faces[..., :3, :].mean(axis=-2), centres)
    origin = faces[:, :1, 0, :]
    return np.asarray(np.einsum("efi,efi->e", thirds - origin, area_vectors(faces)) / 3.0)
