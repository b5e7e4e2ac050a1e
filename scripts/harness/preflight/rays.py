"""Where rays meet triangles, many at once.

Written here and not taken from trimesh, because a gap is looked for on both sides of the origin, only against triangles
that face the ray, and a little beyond their edges; libraries return what lies in front, in single precision where they
are fast.
"""

import numpy as np

from harness.arrays import Array

CHUNK = 2_000_000  # pairs of ray and triangle that are looked at together
OUTSIDE = 0.01  # how far outside a triangle a ray still counts, in its barycentric coordinates
OPPOSED = 0.5
"""Least cosine, but for its sign, between a ray and the normal of what faces it: contact counts nothing below."""
STEEP = 1e-3  # least cosine between a ray and the normal where it leaves a body


def triangles(corners: Array) -> Array:
    """Two triangles for each face, shape (2 n, 3, 3), from corners (n, 4, 3); of a triangle the second has no area."""
    return np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])


def nearest_facing(origins: Array, directions: Array, targets: Array, depth: Array | None = None) -> Array:
    """Distance along each ray, negative behind its origin, to the nearest triangle that faces it; NaN without any.

    The normal of such a triangle points against the ray.

    origins, directions: shape (n_rays, 3), directions of length one.
    targets: shape (n_triangles, 3, 3).
    depth: shape (n_rays,), where the rays leave their own body behind their origins, beyond which they see nothing;
        NaN: nowhere.
    """
    least = None if depth is None else -np.where(np.isnan(depth), np.inf, depth)
    return _nearest(origins, directions, targets, facing=True, least=least)


def first_exit(origins: Array, directions: Array, targets: Array, least: Array) -> Array:
    """Distance to the first triangle beyond `least` whose normal points along the ray: where it leaves a body."""
    return _nearest(origins, directions, targets, facing=False, least=least)


def _nearest(origins: Array, directions: Array, targets: Array, *, facing: bool, least: Array | None = None) -> Array:
    distance = np.full(len(origins), np.nan)
    size = max(1, CHUNK // max(1, len(targets)))
    for start in range(0, len(origins) if len(targets) else 0, size):
        part = slice(start, start + size)
        met = _distances(origins[part], directions[part], targets, facing)
        if least is not None:
            met[~(met > least[part, None])] = np.nan
        best = np.argmin(np.where(np.isnan(met), np.inf, np.abs(met)), axis=1)
        distance[part] = met[np.arange(len(best)), best]
    return distance


def _distances(origins: Array, directions: Array, targets: Array, facing: bool) -> Array:
    """Signed distance of each ray to each triangle (n_rays, n_triangles), NaN where it misses; Moeller and Trumbore
    (1997), J Graph Tools 2(1):21-28.
    """
    one, two = targets[:, 1] - targets[:, 0], targets[:, 2] - targets[:, 0]
    normal = np.cross(one, two)
    along = directions @ normal.T
    offset = origins[:, None, :] - targets[None, :, 0, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = -np.einsum("rti,ti->rt", offset, normal) / along
        turned = np.cross(offset, directions[:, None, :])
        first = -np.einsum("rti,ti->rt", turned, two) / along
        second = np.einsum("rti,ti->rt", turned, one) / along
        inside = (first >= -OUTSIDE) & (second >= -OUTSIDE) & (first + second <= 1.0 + OUTSIDE)
    size = np.linalg.norm(normal, axis=1)
    turned_right = along < -OPPOSED * size if facing else along > STEEP * size
    return np.where(inside & turned_right, distance, np.nan)
