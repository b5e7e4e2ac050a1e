"""Partial slip of a cylinder on a half space: Hertz's line contact under a tangential force (Cattaneo, Mindlin).

Source: Johnson (1985), Contact Mechanics, section 7.2(b). Derivation: where all of the contact slips, the shear
traction mu p0 sqrt(1 - x^2/a^2) displaces both surfaces so that the shift varies as x^2, as Hertz's pressure does along
the normal. Hertz's own shear on |x| < c, scaled by c/a and taken off, makes the shift uniform there, which is stick:
q = mu p0 [sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - x^2/c^2)]. Its integral mu P (1 - c^2/a^2) is the tangential force Q,
hence c = a sqrt(1 - Q/(mu P)). Shear does not change the pressure where both bodies have the same properties, or where
Dundurs' second parameter is zero.
"""

from math import sqrt


def stick_half_width(half_width: float, ratio: float) -> float:
    """Half-width c of the stick zone (mm).

    half_width: a of the contact, mm.
    ratio: Q/(mu P), from 0 (all sticks) to 1 (all slips).
    Raises ValueError for a ratio beyond these.
    """
    if not 0.0 <= ratio <= 1.0:
        raise ValueError(f"Q/(mu P) must be from 0 to 1, got {ratio:g}")
    return half_width * sqrt(1.0 - ratio)


def peak_shear(ratio: float, bound: float) -> float:
    """Largest shear traction mu p0 sqrt(Q/(mu P)), MPa, at the edges of the stick zone; `bound` is mu p0."""
    return bound * sqrt(ratio)
