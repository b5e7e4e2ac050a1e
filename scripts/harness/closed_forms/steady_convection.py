"""Steady convection and diffusion through one slab.

Source: Ateshian, Maas, Weiss (2012), J Biomech 45(6):1023-1027, equations 3.2-3.4. Derivation: the flux
j = phi_w (-d c' + (w0/phi_w) c) is constant, so c'' = (Pe/h) c' with Pe = h w0/(d phi_w), whose solutions are a
constant and exp(Pe z/h); the two face values fix the rest.
"""

import numpy as np
from numpy.typing import ArrayLike

from harness.arrays import Array


def concentration(
    z: ArrayLike, *, height: float, peclet: float, upstream: float = 1.0, downstream: float = 0.0
) -> Array:
    """Concentration between the upstream face z = -h/2 and the downstream face z = h/2.

    z: position, mm.
    height, peclet: h (mm); Pe, of either sign; the limit Pe = 0 is the straight line.
    upstream, downstream: c_u and c_d, mM.
    Returns: c, mM, in the shape of `z`: c_u + (c_d - c_u) (e^{Pe x} - 1)/(e^{Pe} - 1), x = z/h + 1/2, which is equation
        3.4 in a form that does not overflow.
    """
    x = np.asarray(z, dtype=float) / height + 0.5
    return np.asarray(upstream + (downstream - upstream) * _progress(x, peclet))


def _progress(x: Array, peclet: float) -> Array:
    """(e^{Pe x} - 1)/(e^{Pe} - 1) for 0 <= x <= 1."""
    if peclet == 0.0:
        return x
    if peclet < 0.0:
        return np.asarray(np.expm1(peclet * x) / np.expm1(peclet))
    return np.asarray(np.exp(peclet * (x - 1.0)) * np.expm1(-peclet * x) / np.expm1(-peclet))
