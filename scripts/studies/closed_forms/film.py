"""Steady flow of solvent and solute through two layers with a membrane between them.

Derivation. The membrane obeys the equations of Kedem and Katchalsky (1958), Biochim Biophys Acta 27:229, point by point
(Spiegler and Kedem (1966), Desalination 1:311). With the pressure q = p~ + R T c~ of the solution that would be in
equilibrium with the mixture, they read, over the membrane,

    w = L_p ([q] - sigma R T [c~]),        c~_out = c~_in e^F - j (e^F - 1)/((1 - sigma) w),    F = (1 - sigma) w/P.

Layers whose solute diffuses as in free solution (d = d0, kappa~ = 1) obey the same two with 1/L_p = L/k, sigma = 0 and
P = phi_w d/L: Darcy's law in q, and convection with diffusion (`two_layer_convection`). All three are in series: w and
j are the same in each, drops of q add up, and c~ is passed on from one to the next. What is left is one equation for w.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


@dataclass(frozen=True)
class Film:
    """A membrane, or a layer as one: conductance L_p in mm^3/(N s), permeance P in mm/s, reflection sigma."""

    conductance: float
    permeance: float
    reflection: float = 0.0

    def entrained(self, flux: float) -> float:
        """F = (1 - sigma) w/P for the solvent flux w (mm/s)."""
        return (1.0 - self.reflection) * flux / self.permeance

    def resistance(self, flux: float) -> float:
        """(e^F - 1)/((1 - sigma) w), s/mm, which tends to 1/P without flow."""
        exponent = self.entrained(flux)
        return (1.0 if exponent == 0.0 else float(np.expm1(exponent)) / exponent) / self.permeance


def layer(thickness: float, permeability: float, diffusivity: float, porosity: float) -> Film:
    """A layer of mm, mm^4/(N s) and mm^2/s."""
    return Film(permeability / thickness, porosity * diffusivity / thickness)


@dataclass(frozen=True)
class Faces:
    """Effective pressure p~ (MPa) and concentration c~ (mM) at inlet and outlet, and R T in MPa/mM."""

    pressures: tuple[float, float]
    concentrations: tuple[float, float]
    thermal_energy: float


@dataclass(frozen=True)
class Steady:
    """Solvent flux w (mm/s), solute flux j (nmol/(mm^2 s)), and c~ (mM) and p~ (MPa) on both sides of the membrane."""

    solvent: float
    solute: float
    concentrations: tuple[float, float]
    pressures: tuple[float, float]


def steady(first: Film, film: Film, second: Film, faces: Faces) -> Steady:
    """The steady state of two layers with a film between them."""
    upstream, downstream = (
        p + faces.thermal_energy * c for p, c in zip(faces.pressures, faces.concentrations, strict=True)
    )

    def excess(flux: float) -> float:
        below, above = _beside_film((first, film, second), faces.concentrations, flux)[1]
        osmotic = film.reflection * faces.thermal_energy * (below - above)
        return upstream - downstream - osmotic - flux * sum(1.0 / part.conductance for part in (first, film, second))

    largest = film.conductance * (
        abs(upstream - downstream) + faces.thermal_energy * sum(map(abs, faces.concentrations))
    )
    flux = float(brentq(excess, -largest, largest, xtol=1e-18, rtol=4 * np.finfo(float).eps))
    solute, (below, above) = _beside_film((first, film, second), faces.concentrations, flux)
    pressures = (
        upstream - flux / first.conductance - faces.thermal_energy * below,
        downstream + flux / second.conductance - faces.thermal_energy * above,
    )
    return Steady(flux, solute, (below, above), pressures)


def _beside_film(
    parts: tuple[Film, Film, Film], concentrations: tuple[float, float], flux: float
) -> tuple[float, tuple[float, float]]:
    """Solute flux, and c~ on both sides of the film, for a solvent flux."""
    growth, resistance = 1.0, 0.0
    for part in parts:
        gain = float(np.exp(part.entrained(flux)))
        growth, resistance = growth * gain, resistance * gain + part.resistance(flux)
    solute = (concentrations[0] * growth - concentrations[1]) / resistance
    first, film, _ = parts
    below = concentrations[0] * float(np.exp(first.entrained(flux))) - solute * first.resistance(flux)
    above = below * float(np.exp(film.entrained(flux))) - solute * film.resistance(flux)
    return solute, (below, above)
