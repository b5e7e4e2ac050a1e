"""Steady convection and diffusion through two layers, joined by an interface of finite or infinite conductance.

Derivation. In each layer the flux j = W c~ - G c~' is constant, with W = kappa~ (d/d0) w and G = phi_w kappa~ d
(Ateshian, Maas, Weiss (2012), J Biomech 45(6):1023-1027, constitutive law of the solute flux), so
c~ - j/W = (c~_in - j/W) exp(W (z - z_in)/G). Passing from the inlet through layer 1, the jump j/eps and layer 2 to the
outlet gives, with P_i = W_i L_i/G_i,

    j = (c_u e^{P1+P2} - c_d) / [e^{P2} (e^{P1} - 1)/W1 + (e^{P2} - 1)/W2 + e^{P2}/eps].

The solvent flux w is equal in both layers, W need not be; for W1 = W2 = W the first two terms are (e^{P1+P2} - 1)/W.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from harness.arrays import Array


@dataclass(frozen=True)
class Layer:
    """One layer: thickness (mm), d and d0 (mm^2/s), porosity phi_w and effective solubility kappa~."""

    thickness: float
    diffusivity: float
    free_diffusivity: float
    porosity: float
    solubility: float

    def convection(self, flux: float) -> float:
        """W = kappa~ (d/d0) w, mm/s, for the solvent flux w (mm/s)."""
        return self.solubility * self.diffusivity / self.free_diffusivity * flux

    @property
    def conductance(self) -> float:
        """G = phi_w kappa~ d, mm^2/s."""
        return self.porosity * self.solubility * self.diffusivity

    def peclet(self, flux: float) -> float:
        """P = W L/G."""
        return self.convection(flux) * self.thickness / self.conductance

    def resistance(self, flux: float) -> float:
        """(e^P - 1)/W, s/mm, which tends to L/G without convection."""
        p = self.peclet(flux)
        return self.thickness / self.conductance if p == 0.0 else float(np.expm1(p)) / self.convection(flux)


@dataclass(frozen=True)
class Conditions:
    """What drives the transport: solvent flux w (mm/s), face values c~_u and c~_d (mM), conductance eps (mm/s)."""

    flux: float
    upstream: float
    downstream: float
    conductance: float = np.inf


def solute_flux(first: Layer, second: Layer, given: Conditions) -> float:
    """Solute flux j, nmol/(mm^2 s); the jump of c~ over the interface is j/eps."""
    gain = np.exp(second.peclet(given.flux))
    resistance = gain * first.resistance(given.flux) + second.resistance(given.flux) + gain / given.conductance
    return float((given.upstream * np.exp(first.peclet(given.flux)) * gain - given.downstream) / resistance)


def concentration(z: ArrayLike, first: Layer, second: Layer, given: Conditions) -> Array:
    """Effective concentration c~ (mM) at the distances `z` (mm) from the inlet; at z = L1 that of the first layer."""
    j = solute_flux(first, second, given)
    position = np.asarray(z, dtype=float)
    at_interface = _within(first, np.asarray(first.thickness), given.upstream, (j, given.flux)) - j / given.conductance
    below = _within(first, np.minimum(position, first.thickness), given.upstream, (j, given.flux))
    above = _within(second, np.maximum(position - first.thickness, 0.0), at_interface, (j, given.flux))
    return np.asarray(np.where(position <= first.thickness, below, above))


def _within(layer: Layer, s: Array, entry: float | Array, fluxes: tuple[float, float]) -> Array:
    """c~ at the distance `s` (mm) from the entry of a layer: c~_in e^{Ws/G} - j (e^{Ws/G} - 1)/W; fluxes (j, w)."""
    j, flux = fluxes
    w, g = layer.convection(flux), layer.conductance
    if w == 0.0:
        return np.asarray(entry - j * s / g)
    return np.asarray(entry * np.exp(w * s / g) - j * np.expm1(w * s / g) / w)
