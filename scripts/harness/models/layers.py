"""Steady convection and diffusion through two layers of different material."""

from dataclasses import dataclass
from typing import ClassVar

from harness.closed_forms import two_layer_convection
from harness.models.layered import Layered
from harness.models.parts import Control, Mixture, Solid, Solute, concentration, fluid_flux, pressure

UPSTREAM = 1.0  # effective concentration at the inlet z = 0, mM; 0 at the outlet
FLUX = 4e-4  # solvent flux w along z, mm/s
CLOSING = 1e-4  # mm by which the outlet is moved
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
    MATERIALS: ClassVar = {"first": _material(FIRST), "second": _material(SECOND)}
    COLUMN = (("lower", "first", FIRST.thickness), ("upper", "second", SECOND.thickness))
    PRESCRIBED = (
        concentration("bottom", UPSTREAM),
        concentration("top", 0.0),
        pressure("top", 0.0),
        fluid_flux("bottom", -FLUX),
    )
    LOGGED = ("wz", "c", "jz")
