"""Two thin biphasic layers on rigid curved bodies, pressed together without friction: lines and spheres.

Sources: Ateshian, Lai, Zhu and Mow (1994), An asymptotic solution for the contact of two biphasic cartilage layers,
J Biomech 27(11):1347-1360 (spheres, equal layers); Argatov and Mishuris (2011), arXiv:1009.4490 (general paraboloids).

Derivation. A layer of thickness h is fixed to an impermeable body at y = 0; its surface y = h carries the pressure p,
no shear, and a volume flux j that enters it. It is thin: a >> h. Then p varies along the layer alone. To leading order
in (h/a)^2 momentum is mu u_yy = grad p with u(0) = 0 and u_y(h) = 0, so u = (y^2/2 - h y) grad p/mu, and the solid
carries the volume INT u dy = -h^3/(3 mu) grad p. The solvent carries -h k grad p. The surface sinks by w, and both
together are incompressible: w' = -h^3/(3 mu) lap p' - h k lap p - j, a prime for the rate. What one layer gives up, the
other takes, so j drops out of the sum of both layers, whatever they are. With m = SUM h^3/(3 mu) and
chi = SUM h k/m (3 mu k/h^2 for equal layers), the accumulated pressure

    P = p + chi INT_0^t p dt        obeys        -m lap P = delta(t) - r^2/(2R)        within the contact,

where the surfaces have no gap. 1/R is the sum of both curvatures, delta the approach. The contact grows, and where a
point is not yet in contact P = 0; P and its slope are continuous at the edge, which determines P and delta:

    lines     P = (a^2 - x^2)^2/(24 m R),   delta = a^2/(6 R),   a^5 = (45 m R/2) Q
    spheres   P = (a^2 - r^2)^2/(32 m R),   delta = a^2/(4 R),   a^6 = (96 m R/pi) Q,       Q = F + chi INT_0^t F dt,

the last from the integral of P over the contact. The pressure follows from p' + chi p = P'.

Where this ends. Within some h of the edge the layer is not thin. For an elastic incompressible layer, which the
mixture is at first, the integral equation of the layer (Johnson 1985, Contact Mechanics, section 5.8, for the problem)
gives an edge that lies 1.45 h inside of a, for large a/h (`EDGE`). Peak pressure and approach differ far less, with
(h/a)^2: at a = 16 h by 1.2 % and 1.6 %. The time is to be short against a^2/(H k), in which solvent drains from the
contact, H being the aggregate modulus. And the free surface is impermeable: where it drains, solvent that
reaches the last h of the contact leaves through it, a part of some h/a that grows with chi t.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from harness.arrays import Array

EDGE = 1.45
"""Distance of the edge of contact from that of thin layers, inwards, in thicknesses of each of two equal layers."""


@dataclass(frozen=True)
class Layer:
    """A biphasic layer: thickness h (mm), shear modulus mu (MPa) and permeability k (mm^4/(N s))."""

    thickness: float
    shear_modulus: float
    permeability: float

    @property
    def compliance(self) -> float:
        """h^3/(3 mu), mm^3/MPa."""
        return self.thickness**3 / (3.0 * self.shear_modulus)


class Shape(Enum):
    """What the layers lie on: n and factor of a^n = .. m R Q, divisors of delta = a^2/(..R) and P = (..)^2/(..m R)."""

    LINE = (5, 45.0 / 2.0, 6.0, 24.0)
    SPHERE = (6, 96.0 / pi, 4.0, 32.0)

    def __init__(self, power: int, load: float, approach: float, pressure: float) -> None:
        self.power, self.load, self.approach, self.pressure = power, load, approach, pressure


@dataclass(frozen=True)
class Contact:
    """Layers in contact."""

    layers: Sequence[Layer]  # of both bodies; one alone against a rigid impermeable body
    radius: float  # R, mm, with 1/R the sum of both curvatures
    shape: Shape = Shape.LINE

    @property
    def compliance(self) -> float:
        """M = SUM h^3/(3 mu), mm^3/MPa."""
        return sum(layer.compliance for layer in self.layers)

    @property
    def rate(self) -> float:
        """Chi = SUM h k/m, 1/s."""
        return sum(layer.thickness * layer.permeability for layer in self.layers) / self.compliance

    def half_width(self, load: ArrayLike) -> Array:
        """A (mm), half-width or radius of the contact, for Q = F + chi INT F dt (N/mm for a line, N for a sphere)."""
        return np.asarray(
            (self.shape.load * self.compliance * self.radius * np.asarray(load)) ** (1.0 / self.shape.power)
        )

    def load(self, half_width: float) -> float:
        """Q at which the contact has this half-width; at first that is the force."""
        return half_width**self.shape.power / (self.shape.load * self.compliance * self.radius)

    def approach(self, half_width: ArrayLike) -> Array:
        """Approach delta (mm) of the two bodies."""
        return np.asarray(np.asarray(half_width) ** 2 / (self.shape.approach * self.radius))

    def accumulated_pressure(self, x: ArrayLike, half_width: ArrayLike) -> Array:
        """P (MPa) at distances `x` (mm) from the middle, broadcast against `half_width`; 0 outside of the contact."""
        inside = np.maximum(0.0, np.asarray(half_width) ** 2 - np.asarray(x) ** 2)
        return np.asarray(inside**2 / (self.shape.pressure * self.compliance * self.radius))


def accumulated_load(times: Array, force: Array, rate: float) -> Array:
    """Q = F + chi INT F dt at `times` (s, from 0) of a force that is linear between them."""
    return np.asarray(force + rate * _integral(times, force))


def pressure(x: float, times: Array, force: Array, contact: Contact) -> Array:
    """Pressure p (MPa) at a distance `x` (mm) from the middle at `times`, for a force that is linear between them.

    P is taken as linear between the times, for which p' + chi p = P' is solved exactly: take them finely.
    """
    chi = contact.rate
    total = contact.accumulated_pressure(x, contact.half_width(accumulated_load(times, force, chi)))
    found = np.empty_like(total)
    found[0] = total[0]
    for n, step in enumerate(np.diff(times)):
        kept = np.exp(-chi * step)
        found[n + 1] = found[n] * kept + (total[n + 1] - total[n]) * (1.0 - kept) / (chi * step)
    return found


def _integral(times: Array, values: Array) -> Array:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(times)
    return np.concatenate([[0.0], np.cumsum(steps)])
