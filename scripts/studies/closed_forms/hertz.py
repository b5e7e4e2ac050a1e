"""Hertz's contact of a cylinder along a line, and of a sphere, with a half space, without friction.

Source: Johnson (1985), Contact Mechanics, sections 4.2(a) and (c). The pressure p0 sqrt(1 - x^2/a^2) of a line carries
F = pi a p0/2 per length. Over a circle the same pressure carries F = (2/3) pi a^2 p0 and lowers the surface by
pi p0 (2 a^2 - r^2)/(4 E* a), which has to be delta - r^2/(2R): p0 = 2 E* a/(pi R) and delta = a^2/R.
"""

from math import pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


def half_width(force: float, radius: float, modulus: float) -> float:
    """Half-width a = sqrt(4 F R/(pi E*)), mm, for the force per length F (N/mm), radius R (mm) and E* (MPa)."""
    return sqrt(4.0 * force * radius / (pi * modulus))


def peak_pressure(force: float, radius: float, modulus: float) -> float:
    """Peak pressure p0 = sqrt(F E*/(pi R)), MPa; arguments as in `half_width`."""
    return sqrt(force * modulus / (pi * radius))


def sphere_radius(force: float, radius: float, modulus: float) -> float:
    """Contact radius a = (3 F R/(4 E*))^(1/3), mm, of a sphere under the force F (N); other arguments as above."""
    return float((3.0 * force * radius / (4.0 * modulus)) ** (1.0 / 3.0))


def sphere_peak_pressure(force: float, radius: float, modulus: float) -> float:
    """Peak pressure p0 = 3 F/(2 pi a^2), MPa."""
    return 1.5 * force / (pi * sphere_radius(force, radius, modulus) ** 2)


class HalfEllipse(NamedTuple):
    """p = peak sqrt(1 - x^2/half_width^2): half-width in the unit of places, peak in that of values."""

    half_width: float
    peak: float


def half_ellipse_through(place: NDArray[np.float64], value: NDArray[np.float64]) -> HalfEllipse:
    """The one around place 0 whose squares are nearest to those of the values; shapes (n,) and (n,)."""
    slope, start = np.polyfit(place**2, value**2, 1)
    return HalfEllipse(float(np.sqrt(-start / slope)), float(np.sqrt(start)))
