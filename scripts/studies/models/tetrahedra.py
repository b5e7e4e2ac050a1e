"""Hexahedra of any mesh cut into tetrahedra whose faces match."""

import numpy as np

from harness.arrays import Ids
from harness.models.blocks import Body

_HALVES = np.array([(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)])
"""The two prisms of a hexahedron: triangles below, then above."""
_TURNED = np.array(
    [
        (0, 1, 2, 3, 4, 5),
        (1, 2, 0, 4, 5, 3),
        (2, 0, 1, 5, 3, 4),
        (3, 5, 4, 0, 2, 1),
        (4, 3, 5, 1, 0, 2),
        (5, 4, 3, 2, 1, 0),
    ]
)
"""The corners of a prism, with each of them first."""
_RISING = np.array([(0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3)])
_FALLING = np.array([(0, 1, 2, 4), (0, 4, 2, 5), (0, 4, 5, 3)])
"""The tetrahedra of a prism whose first corner has the least number, by the diagonal of the face opposite to it."""


def tetrahedra(body: Body) -> Body:
    """The same nodes with six tetrahedra in the place of each hexahedron.

    Each hexahedron is cut into two prisms along its third direction, which neighbours across that direction have in
    common. The diagonal of each other face is the one at its node of the least number (Dompierre, Labbe, Vallet and
    Camarero 1999, Proc 8th Int Meshing Roundtable:195-204).
    """
    prisms = body.elements[:, _HALVES].reshape(-1, 6)
    first = np.argmin(prisms, axis=1)
    prisms = np.take_along_axis(prisms, _TURNED[first], axis=1)
    rising = np.minimum(prisms[:, 1], prisms[:, 5]) < np.minimum(prisms[:, 2], prisms[:, 4])
    cut: Ids = np.where(rising[:, None, None], prisms[:, _RISING], prisms[:, _FALLING])
    return Body(body.nodes, cut.reshape(-1, 4))
