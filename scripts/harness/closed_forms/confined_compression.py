"""Confined creep of a biphasic layer under a step load on its free-draining face.

Source: Mow, Kuei, Lai, Armstrong (1980), J Biomech Eng 102(1):73-84. With zeta = z/h from the impermeable and
fixed face, the displacement u towards that face follows u_tau = u_zeta,zeta with tau = H k t/h^2, u(0) = 0 and
u_zeta(1) = (P0/H) h. Steady: (P0/H) h zeta; the rest in the modes sin(mu_n zeta), mu_n = (n + 1/2) pi, with
INT zeta sin(mu zeta) = sin(mu)/mu^2. From the momentum balance p = P0 - H u_zeta/h.
"""

import numpy as np
from numpy.typing import ArrayLike

from harness.arrays import Array

_TERMS = 4000


def displacement(zeta: ArrayLike, tau: ArrayLike, *, load: float, modulus: float, height: float) -> Array:
    """Displacement (mm) towards the fixed face.

    zeta: z/h, 0 at the fixed face and 1 at the loaded one; broadcast against `tau`.
    tau: H k t/h^2, not negative.
    load, modulus, height: P0 and aggregate modulus H (MPa), h (mm).
    Returns: (P0/H) h [zeta - 2 SUM (-1)^n sin(mu_n zeta)/mu_n^2 e^{-mu_n^2 tau}].
    """
    z, time = np.broadcast_arrays(np.asarray(zeta, dtype=float), np.asarray(tau, dtype=float))
    n, mu = _modes()
    modes = np.sin(mu * z[..., None]) * np.exp(-(mu**2) * time[..., None])
    series = np.sum((-1.0) ** n * 2.0 / mu**2 * modes, axis=-1)
    return np.asarray(load / modulus * height * (z - series))


def fluid_pressure(zeta: ArrayLike, tau: ArrayLike, *, load: float) -> Array:
    """Fluid pressure (MPa), 2 P0 SUM (-1)^n cos(mu_n zeta)/mu_n e^{-mu_n^2 tau}; `tau` must be positive."""
    z, time = np.broadcast_arrays(np.asarray(zeta, dtype=float), np.asarray(tau, dtype=float))
    n, mu = _modes()
    modes = np.cos(mu * z[..., None]) * np.exp(-(mu**2) * time[..., None])
    return np.asarray(load * np.sum((-1.0) ** n * 2.0 / mu * modes, axis=-1))


def _modes() -> tuple[Array, Array]:
    n = np.arange(_TERMS, dtype=float)
    return n, (n + 0.5) * np.pi
