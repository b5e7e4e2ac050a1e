"""Gaps between surfaces of bilinear quadrilaterals that face each other along z."""

import numpy as np
from scipy.spatial import cKDTree

from harness.arrays import Array

_SIGNS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])  # parameters of a quadrilateral's corners
_SAMPLES = 7  # points along each edge at which a facet is compared
_NEAREST = 5  # facets among which the one below or above a point is looked for
_ITERATIONS = 4  # of Newton's method for the parameters of a point: facets are near to parallelograms


def smallest_gap(lower: Array, upper: Array) -> float:
    """Smallest distance along z between two surfaces, mm; negative where they overlap.

    lower, upper: shape (n_facets, 4, 3), corners of the facets, of surfaces that are heights over x and y.
    """
    below, above = _points(lower), _points(upper)
    gaps = np.concatenate([_heights(upper, below) - below[:, 2], above[:, 2] - _heights(lower, above)])
    return float(np.nanmin(gaps))


def _points(facets: Array) -> Array:
    """Points all over the facets, shape (n, 3)."""
    line = np.linspace(-1.0, 1.0, _SAMPLES)
    at = np.stack(np.meshgrid(line, line), axis=-1).reshape(-1, 2)
    return np.asarray(np.einsum("pa,fai->fpi", _shapes(at), facets).reshape(-1, 3))


def _heights(facets: Array, points: Array) -> Array:
    """Height of a surface at the x and y of points; NaN beside the surface."""
    number = min(_NEAREST, len(facets))
    _, nearest = cKDTree(facets[:, :, :2].mean(axis=1)).query(points[:, :2], k=range(1, number + 1))
    found = np.full(len(points), np.nan)
    for candidates in np.asarray(nearest).T:
        missing = np.flatnonzero(np.isnan(found))
        facet = facets[candidates[missing]]
        at = _parameters(facet[:, :, :2], points[missing, :2])
        inside = np.abs(at).max(axis=1) <= 1.0 + 1e-9
        found[missing[inside]] = np.einsum("na,na->n", _shapes(at), facet[:, :, 2])[inside]
    return found


def _parameters(corners: Array, points: Array) -> Array:
    """Parameters of points in the quadrilaterals with these corners, shape (n, 2)."""
    at = np.zeros_like(points)
    for _ in range(_ITERATIONS):
        (a, b), (c, d) = np.einsum("nai,naj->ijn", corners, _slopes(at))
        x, y = (points - np.einsum("na,nai->ni", _shapes(at), corners)).T
        at += np.stack([d * x - b * y, a * y - c * x], axis=1) / (a * d - b * c)[:, None]
    return at


def _shapes(at: Array) -> Array:
    """Shape functions, shape (n, 4)."""
    return np.asarray(np.prod(1.0 + at[:, None] * _SIGNS, axis=2) / 4.0)


def _slopes(at: Array) -> Array:
    """Their derivatives, shape (n, 4, 2)."""
    factors = 1.0 + at[:, None] * _SIGNS
    return np.asarray(factors[:, :, ::-1] * _SIGNS / 4.0)
