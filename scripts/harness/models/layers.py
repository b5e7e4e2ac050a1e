"""Steady convection and diffusion through two layers of different material."""

from __future__ import annotations

from dataclasses import dataclass

from harness.closed_forms import two_layer_convection
from harness.models.layered import Layered, one_above_the_other
from harness.models.mesh import Layer
from harness.models.parts import (
    Condition,
    Control,
    Material,
    Mixture,
    Solid,
    Solute,
    concentration,
    fluid_flux,
    pressure,
)

UPSTREAM = 1.0
"""Effective concentration at the inlet z = 0, mM; 0 at the outlet."""
FLUX = 4e-4
"""Solvent flux w along z, mm/s."""
CLOSING = 1e-4
"""mm by which the outlet is moved."""
GIVEN = two_layer_convection.Conditions(FLUX, UPSTREAM, 0.0)
FIRST = two_layer_convection.Layer(1.0, diffusivity=5e-4, free_diffusivity=5e-4, porosity=0.8, solubility=1.0)
SECOND = two_layer_convection.Layer(0.75, diffusivity=5e-4, free_diffusivity=1e-3, porosity=0.6, solubility=0.5)

ABOUT = """\
Steady convection and diffusion through two layers of different material that are in contact at z = 1 mm.

Solvent enters at z = 0 with a flux of 0.0004 mm/s and leaves at z = 1.75 mm, where its pressure is zero. The effective
concentration is 1 mM at the inlet and 0 at the outlet. The outlet moves by -0.0001 mm, which closes the contact. The
upper layer has half the solubility of the lower one and hinders the solute (d < d0). Its convective flux W c~, with
W = kappa~ (d/d0) w, is therefore a quarter of that in the lower layer at the same c~, and the actual concentration
jumps across the interface. The profile is steady after 10000 s."""


def _material(data: two_layer_convection.Layer) -> Mixture:
    solute = Solute(1, data.diffusivity, data.free_diffusivity, data.solubility)
    return Mixture(Solid(1000.0), 1e-3, data.porosity, (solute,))


@dataclass(frozen=True)
class Layers(Layered):
    """Choices of the two-layer convection problem."""

    control: Control = Control(50, 200.0)
    name: str = "two-layer-convection"

    ABOUT = ABOUT
    CLOSING = CLOSING

    @property
    def materials(self) -> dict[str, Material]:
        """One of each layer."""
        return {"first": _material(FIRST), "second": _material(SECOND)}

    @property
    def layers(self) -> list[Layer]:
        """The first below, the second above."""
        return one_above_the_other((FIRST.thickness, SECOND.thickness), self.elements)

    @property
    def prescribed(self) -> tuple[Condition, ...]:
        """Inlet below, outlet above."""
        return (
            concentration("bottom", UPSTREAM),
            concentration("top", 0.0),
            pressure("top", 0.0),
            fluid_flux("bottom", -FLUX),
        )

    @property
    def element_columns(self) -> tuple[str, ...]:
        """Concentration and flux."""
        return ("wz", "c", "jz") if self.module_used == "solute" else ("wz", "c1", "j1z")
