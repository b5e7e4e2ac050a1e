"""A half-ellipse of load through values over places: its square falls linearly with that of the distance to zero."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from harness.arrays import Array


class HalfEllipse(NamedTuple):
    """p = peak sqrt(1 - x^2/half_width^2): half-width in the unit of places, peak in that of values."""

    half_width: float
    peak: float


def through(place: Array, value: Array) -> HalfEllipse:
    """The one around place 0 whose squares are nearest to those of the values; shapes (n,) and (n,)."""
    slope, start = np.polyfit(place**2, value**2, 1)
    return HalfEllipse(float(np.sqrt(-start / slope)), float(np.sqrt(start)))
