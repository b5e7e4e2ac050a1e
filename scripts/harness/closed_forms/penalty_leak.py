"""What a penalty lets through: the jump of concentration that a finite penalty leaves in steady diffusion.

Derivation. The layers and the interface are resistances in series, L_i/G_i with G_i = phi_w kappa~ d, and 1/eps by
equation 2.9 of Ateshian, Maas, Weiss (2012), J Biomech 45(6):1023-1027, j_n = eps (c~1 - c~2). A penalty run that shows
a smaller jump does not use the penalty it was given.
"""

from collections.abc import Iterable


def relative_jump(resistances: Iterable[float], penalty: float) -> float:
    """Jump of c~ over the interface, divided by the difference of c~ between the two outer faces.

    resistances: L_i/G_i of each layer, s/mm.
    penalty: eps_c, mm/s.
    """
    leak = 1.0 / penalty
    return leak / (sum(resistances) + leak)
