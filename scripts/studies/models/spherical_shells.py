"""Thick spherical shells of hexahedra, from patches of a cube around the centre: a hemisphere and an octant."""

from collections.abc import Sequence

import numpy as np

from harness.arrays import Array
from harness.models import blocks
from harness.models.blocks import Body, Points


def hemisphere(elements: int, radii: Array) -> Body:
    """The lower half around the origin: a lowest patch and four up to the rim.

    elements: along each edge of the lowest patch; even. The others have half as many upwards.
    radii: of the nodes through the thickness, mm.
    """
    even, half = _even(-1.0, elements), _even(0.0, elements // 2)
    a, b = np.meshgrid(even, even, indexing="ij")
    c, d = np.meshgrid(even, half, indexing="ij")
    lowest = np.stack([a, b, -np.ones_like(a)], axis=-1)
    sides = [np.stack([np.ones_like(c), c, -d], axis=-1) @ _quarter(k).T for k in range(4)]
    return _thick((lowest, *sides), radii)


def octant(elements: int, radii: Array) -> Body:
    """The octant of positive coordinates around the origin: three patches of `elements` along each edge."""
    a, b = np.meshgrid(_even(0.0, elements), _even(0.0, elements), indexing="ij")
    patch = np.stack([np.ones_like(a), a, b], axis=-1)
    return _thick([np.roll(patch, k, axis=-1) for k in range(3)], radii)


def _even(start: float, elements: int) -> Array:
    """Positions on the face of a cube from `start` to 1 that are even in angle."""
    return np.asarray(np.tan(np.linspace(start, 1.0, elements + 1) * np.pi / 4.0))


def _quarter(turns: int) -> Array:
    c, s = np.round(np.cos(turns * np.pi / 2)), np.round(np.sin(turns * np.pi / 2))
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _thick(patches: Sequence[Points], radii: Array) -> Body:
    """A shell from points on a cube around its centre."""
    unit = [patch / np.linalg.norm(patch, axis=-1, keepdims=True) for patch in patches]
    return blocks.merged([blocks.structured(each[:, :, None, :] * radii[:, None]) for each in unit])
