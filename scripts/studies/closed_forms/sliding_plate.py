"""Friction of an impermeable plate that slides over a confined biphasic layer while the layer's fluid drains.

Sources: confined compression as in `confined_compression` (Mow, Kuei, Lai, Armstrong 1980); friction that the fluid's
part of the load does not take part in (Ateshian, Wang, Lai 1998, J Tribol 120(2):241-248). Derivation: the layer has
its fixed, drained base at z = 0 and the plate, which bears the load P0 at once, at z = h. The total stress is P0
everywhere, p = P0 - H u_z is P0 at first, and with lengths in h and tau = H k t/h^2 the mass balance gives
p_tau = p_zz, p(0) = 0, p_z(1) = 0. Its modes are sin(mu_n z), mu_n = (n + 1/2) pi, each with the part 2 P0/mu_n of the
uniform start, so that under the plate p/P0 = 2 SUM (-1)^n/mu_n e^{-mu_n^2 tau}. The friction is
mu_eq [P0 - (1 - phi) p].
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from harness.closed_forms import confined_compression


def load_support(tau: ArrayLike) -> NDArray[np.float64]:
    """Part of the load that the fluid under the plate bears, p/P0; `tau` = H k t/h^2 must be positive.

    It is that at the impermeable base of a layer that drains through its loaded face: the same problem upside down.
    """
    return confined_compression.fluid_pressure(0.0, tau, load=1.0)


def relative_friction(tau: ArrayLike, solid_fraction: float) -> NDArray[np.float64]:
    """mu_eff/mu_eq = 1 - (1 - phi) p/P0, for the fraction phi of the contact that is solid on solid."""
    return np.asarray(1.0 - (1.0 - solid_fraction) * load_support(tau))
