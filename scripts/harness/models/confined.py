"""Confined creep of a biphasic layer that is split in two across the direction of flow."""

from dataclasses import dataclass
from typing import ClassVar

from harness.models.layered import Layered
from harness.models.parts import Mixture, Solid, normal_load, pressure

HEIGHT = 2.0  # mm
MODULUS = 1.0  # aggregate modulus H (MPa): Young's modulus, since Poisson's ratio is 0
PERMEABILITY = 1e-3  # mm^4/(N s)
LOAD = 1e-4  # step load P0, MPa; small, so that strains are
OVERLAP = 1e-10  # mm by which the two halves overlap at first, so that they are in contact when the load comes

ABOUT = """\
Confined creep of a biphasic layer that is cut in two at half its height.

The layer occupies 0 < z < 2 mm. Its lower face is impermeable and fixed, and its sides are confined. A step load of
0.0001 MPa presses on the upper face, and the solvent leaves through this face. With an ideal interface at z = 1 mm,
the two halves creep like one layer: Mow, Kuei, Lai and Armstrong (1980), J Biomech Eng 102(1):73-84. The halves
overlap by 1e-10 mm at the start, because a body under a force needs contact from the start."""


@dataclass(frozen=True)
class Confined(Layered):
    """Choices of the confined creep problem."""

    name: str = "confined-creep"

    ABOUT = ABOUT
    GAP = -OVERLAP
    MATERIALS: ClassVar = {"gel": Mixture(Solid(MODULUS), PERMEABILITY)}
    COLUMN = (("lower", "gel", HEIGHT / 2), ("upper", "gel", HEIGHT / 2))
    PRESCRIBED = (pressure("top", 0.0), normal_load("top", LOAD))

    @property
    def module_used(self) -> str:
        """There is no solute."""
        return "biphasic"
