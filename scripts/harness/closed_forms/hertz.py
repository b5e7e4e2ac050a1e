"""Hertz's contact of a cylinder with a half space along a line, without friction.

Source: Johnson (1985), Contact Mechanics, section 4.2(c). The pressure p0 sqrt(1 - x^2/a^2) carries F = pi a p0/2 per
length.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray


def combined_modulus(first: tuple[float, float], second: tuple[float, float]) -> float:
    """E* (MPa) in plane strain from (E, nu) of the two bodies: 1/E* = SUM (1 - nu^2)/E."""
    return 1.0 / sum((1.0 - nu**2) / modulus for modulus, nu in (first, second))


def half_width(force: float, radius: float, modulus: float) -> float:
    """Half-width a = sqrt(4 F R/(pi E*)), mm, for the force per length F (N/mm), radius R (mm) and E* (MPa)."""
    return sqrt(4.0 * force * radius / (pi * modulus))


def peak_pressure(force: float, radius: float, modulus: float) -> float:
    """Peak pressure p0 = sqrt(F E*/(pi R)), MPa; arguments as in `half_width`."""
    return sqrt(force * modulus / (pi * radius))


def pressure(x: ArrayLike, force: float, radius: float, modulus: float) -> NDArray[np.float64]:
    """Contact pressure (MPa) at the distances `x` (mm) from the middle; 0 outside the contact."""
    inside = np.maximum(0.0, 1.0 - (np.asarray(x, dtype=float) / half_width(force, radius, modulus)) ** 2)
    return np.asarray(peak_pressure(force, radius, modulus) * np.sqrt(inside))
