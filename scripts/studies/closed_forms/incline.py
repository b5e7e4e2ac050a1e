"""A block that a horizontal force pushes up an incline against Coulomb friction.

Source: NAFEMS benchmark CGS-4 (sliding block on an incline). Derivation: with the slope's angle a, weight G and force
F, balance along and across the slope, F cos a = G sin a + mu N and N = G cos a + F sin a, gives
F/G = (tan a + mu)/(1 - mu tan a). Where mu tan a >= 1 no force pushes it up: friction grows faster than the force.
"""


def force_over_weight(slope: float, friction: float) -> float:
    """Horizontal force that slides the block upwards, over its weight.

    slope, friction: tan a and the friction coefficient mu.
    Raises ValueError where the block is stuck under any force.
    """
    if friction * slope >= 1.0:
        raise ValueError(f"friction times slope must be less than 1, got {friction * slope:g}: the block is stuck")
    return (slope + friction) / (1.0 - friction * slope)
