"""Jacobian determinants of hexahedra."""

from __future__ import annotations

import numpy as np

NEIGHBOURS = np.array([(1, 3, 4), (2, 0, 5), (3, 1, 6), (0, 2, 7), (7, 5, 0), (4, 6, 1), (5, 7, 2), (6, 4, 3)])


def at_corners(nodes: np.ndarray, elements: np.ndarray) -> np.ndarray:
    """Determinants at the corners of elements whose nodes are counted from 0, mm^3, shape (n_elements, 8)."""
    corners = nodes[elements[:, :8]]
    return np.linalg.det(corners[:, NEIGHBOURS] - corners[:, :, None])
