"""Diffusion into a slab from one face at the ambient concentration, the other face impermeable.

Source: Ateshian, Maas, Weiss (2012), J Biomech 45(6):1023-1027, section 3.1. Derivation: with xi = 1/2 - z/h, which is
1 at the ambient face and 0 at the impermeable one, c_t = d c_zz has the modes cos(mu_n xi) exp(-mu_n^2 d t/h^2) with
mu_n = (n - 1/2) pi, and 1 = SUM a_n cos(mu_n xi) gives a_n = 2 sin(mu_n)/mu_n = -(4/pi) (-1)^n/(2n - 1).
"""

import numpy as np
from numpy.typing import ArrayLike

from harness.arrays import Array

_NEGLIGIBLE = 45.0  # exponent beyond which a term is below 3e-20
_MOST_TERMS = 20_000


def concentration(z: ArrayLike, t: ArrayLike, *, height: float, diffusivity: float, ambient: float = 1.0) -> Array:
    """Concentration in a slab -h/2 <= z <= h/2 that was empty at t = 0.

    z, t: position (mm) and time (s, > 0); broadcast against each other.
    height, diffusivity, ambient: h (mm), d (mm^2/s), and the ambient concentration c* (mM) at z = -h/2.
    Returns: c, mM, in the broadcast shape.
    Raises ValueError for a time that is not positive, a position outside, or data that are not positive.
    """
    position, time = np.broadcast_arrays(np.asarray(z, dtype=float), np.asarray(t, dtype=float))
    if np.any(time <= 0.0) or height <= 0.0 or diffusivity <= 0.0:
        raise ValueError("time, height and diffusivity must be positive")
    if np.any(np.abs(position) > height / 2 * (1 + 1e-9)):
        raise ValueError("z must lie between -h/2 and h/2")
    tau = diffusivity * float(time.min(initial=np.inf)) / height**2
    n = np.arange(1, min(_MOST_TERMS, 2 + int(np.sqrt(_NEGLIGIBLE / tau) / np.pi)) + 1)
    mu = (n - 0.5) * np.pi
    xi = (0.5 - position / height)[..., None]
    decay = np.exp(-(mu**2) * diffusivity * time[..., None] / height**2)
    series = np.sum((-1.0) ** n / (2 * n - 1) * np.cos(mu * xi) * decay, axis=-1)
    return np.asarray(ambient * (1.0 + 4.0 / np.pi * series))
