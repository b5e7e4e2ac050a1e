"""Diffusion into two layers in series, joined by an interface of finite or infinite conductance.

Derivation. In each layer K c~_t = G c~_zz, with K = phi_w kappa~ (capacity) and G = K d (conductance). With
u = 1 - c~/c* and z from the ambient face, the modes X1 = sin(lambda z/sqrt(d1)) and X2 = B cos(lambda (L - z)/sqrt(d2))
satisfy u = 0 there, and u' = 0 at the impermeable face L. With a = lambda L1/sqrt(d1), b = lambda L2/sqrt(d2) and
g_i = K_i sqrt(d_i), at z = L1

- the flux is continuous:        g1 cos a = g2 B sin b;
- it is eps times the jump:      X2 - X1 = (g1 lambda/eps) cos a.

Together (sin a + (g1 lambda/eps) cos a) sin b = (g1/g2) cos a cos b. The operator is self-adjoint with the weight K
also for finite eps (the boundary terms of the jump cancel), so A = INT K X / INT K X^2. Background: Carslaw and Jaeger
(1959), Conduction of Heat in Solids (contact resistance); Mikhailov and Ozisik (1984), Unified Analysis and Solutions
of Heat and Mass Diffusion.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from harness.arrays import Array

_NEGLIGIBLE = 45.0  # exponent beyond which a term is below 3e-20
_COINCIDENT = 1e-9  # relative distance below which two poles are one
_BESIDE = 1e-7  # distance from a double pole, where the characteristic function vanishes, relative to the next pole's


@dataclass(frozen=True)
class Layer:
    """One layer: thickness (mm), diffusivity (mm^2/s), porosity phi_w and effective solubility kappa~."""

    thickness: float
    diffusivity: float
    porosity: float
    solubility: float

    @property
    def capacity(self) -> float:
        """K = phi_w kappa~."""
        return self.porosity * self.solubility

    @property
    def admittance(self) -> float:
        """K sqrt(d), mm/sqrt(s)."""
        return self.capacity * float(np.sqrt(self.diffusivity))

    def phase(self, rate: float) -> float:
        """Phase lambda L/sqrt(d) for lambda = `rate` (1/sqrt(s))."""
        return rate * self.thickness / float(np.sqrt(self.diffusivity))


def concentration(z: ArrayLike, t: float, first: Layer, second: Layer, conductance: float = np.inf) -> Array:
    """Effective concentration c~/c* at a time, in two layers that were empty at t = 0, with c* at z = 0.

    z: distance from the ambient face, mm; at z = L1 itself the value of the first layer.
    t: time, s, positive.
    first, second: the layer at the ambient face, and the one behind it, whose far face is impermeable.
    conductance: eps_c of the interface, mm/s.
    Returns: c~/c* in the shape of `z`. The actual concentration is kappa~ c~ in each layer.
    Raises ValueError for a time or conductance that is not positive, or a position outside the layers.
    """
    position = np.asarray(z, dtype=float)
    if t <= 0.0 or conductance <= 0.0:
        raise ValueError("time and conductance must be positive")
    length = first.thickness + second.thickness
    if np.any(position < -1e-9 * length) or np.any(position > length * (1 + 1e-9)):
        raise ValueError("z must lie between 0 and L1 + L2")
    total = np.zeros_like(position)
    in_first = position <= first.thickness
    for rate in rates(first, second, conductance, np.sqrt(_NEGLIGIBLE / t)):
        weight, below = _amplitudes(rate, first, second, conductance)
        lower = np.sin(rate * position / np.sqrt(first.diffusivity))
        upper = below * np.cos(rate * (length - position) / np.sqrt(second.diffusivity))
        total += weight * np.where(in_first, lower, upper) * np.exp(-(rate**2) * t)
    return np.asarray(1.0 - total)


def rates(first: Layer, second: Layer, conductance: float, largest: float) -> list[float]:
    """All lambda (1/sqrt(s)) up to the first one above `largest`.

    tan a + (g1 lambda/eps) - (g1/g2) cot b increases from minus to plus infinity between one of its poles
    (a = (m + 1/2) pi, b = m pi) and the next, so there is exactly one root between neighbouring poles; where two poles
    fall together, they are a root as well.
    """
    found: list[float] = []
    for (left, left_double), (right, right_double) in pairwise(_poles(first, second, largest)):
        start = left + (_BESIDE * (right - left) if left_double else 0.0)
        stop = right - (_BESIDE * (right - left) if right_double else 0.0)
        arguments = (first, second, conductance)
        found.append(float(brentq(_characteristic, start, stop, args=arguments, xtol=1e-16, rtol=1e-14)))
        if right_double:
            found.append(right)
    return found


def _poles(first: Layer, second: Layer, largest: float) -> list[tuple[float, bool]]:
    """The poles in ascending order, from lambda = 0 to one interval beyond `largest`, and whether two fall together."""
    tangent = np.pi * np.sqrt(first.diffusivity) / first.thickness
    cotangent = np.pi * np.sqrt(second.diffusivity) / second.thickness
    count = 3 + int(largest / min(tangent, cotangent)) + int(largest / max(tangent, cotangent))
    rates = np.sort(np.concatenate([(np.arange(count) + 0.5) * tangent, np.arange(count) * cotangent]))
    poles: list[tuple[float, bool]] = []
    for rate in rates[: int(np.searchsorted(rates, largest)) + 2]:
        if poles and rate - poles[-1][0] <= _COINCIDENT * rate:
            poles[-1] = (poles[-1][0], True)
        else:
            poles.append((float(rate), False))
    return poles


def _characteristic(rate: float, first: Layer, second: Layer, conductance: float) -> float:
    a, b = first.phase(rate), second.phase(rate)
    resistance = first.admittance * rate / conductance
    ratio = first.admittance / second.admittance
    return float((np.sin(a) + resistance * np.cos(a)) * np.sin(b) - ratio * np.cos(a) * np.cos(b))


def _amplitudes(rate: float, first: Layer, second: Layer, conductance: float) -> tuple[float, float]:
    """A and B of one mode; B from whichever of its two conditions divides by the larger number."""
    a, b = first.phase(rate), second.phase(rate)
    g1, g2 = first.admittance, second.admittance
    if abs(np.sin(b)) > abs(np.cos(b)):
        below = g1 * np.cos(a) / (g2 * np.sin(b))
    else:
        below = (np.sin(a) + g1 * rate / conductance * np.cos(a)) / np.cos(b)
    content = (g1 * (1 - np.cos(a)) + g2 * below * np.sin(b)) / rate
    lower = first.thickness / 2 - np.sqrt(first.diffusivity) * np.sin(2 * a) / (4 * rate)
    upper = second.thickness / 2 + np.sqrt(second.diffusivity) * np.sin(2 * b) / (4 * rate)
    norm = first.capacity * lower + second.capacity * below**2 * upper
    return float(content / norm), float(below)
