"""A composite slab: diffusion from one face through two layers of different material, solubility included."""

from dataclasses import dataclass
from typing import ClassVar

from harness.closed_forms import composite_slab
from harness.models.layered import Layered
from harness.models.parts import Mixture, Solid, Solute, concentration, effective_pressure, pressure

AMBIENT = 1.0  # mM
CLOSING = 1e-4  # mm by which the impermeable face is moved
FIRST = composite_slab.Layer(thickness=1.0, diffusivity=5e-4, porosity=0.8, solubility=1.0)
SECOND = composite_slab.Layer(thickness=0.75, diffusivity=1e-3, porosity=0.6, solubility=0.5)
STIFFNESS = (100.0, 50.0)  # Young's moduli, MPa
PERMEABILITY = (1e-3, 5e-4)  # mm^4/(N s)

ABOUT = """\
Diffusion into a composite slab: two layers of different material are in contact at z = 1 mm.

The concentration at the face z = 0 is 1 mM. The face z = 1.75 mm is impermeable and moves by -0.0001 mm, which closes
the contact. The upper layer differs in diffusivity, porosity, stiffness and permeability, and has half the solubility
of the lower layer. The effective concentration is therefore continuous across an ideal interface, whereas the actual
concentration jumps by the ratio of the solubilities."""


def _material(index: int, data: composite_slab.Layer) -> Mixture:
    solute = Solute(1, data.diffusivity, data.diffusivity, data.solubility)
    return Mixture(Solid(STIFFNESS[index]), PERMEABILITY[index], data.porosity, (solute,))


@dataclass(frozen=True)
class Composite(Layered):
    """Choices of the composite slab."""

    name: str = "composite-slab"

    ABOUT = ABOUT
    CLOSING = CLOSING
    MATERIALS: ClassVar = {"first": _material(0, FIRST), "second": _material(1, SECOND)}
    COLUMN = (("lower", "first", FIRST.thickness), ("upper", "second", SECOND.thickness))
    PRESCRIBED = (pressure("bottom", effective_pressure(AMBIENT)), concentration("bottom", AMBIENT))
    LOGGED = ("c", "jz")
