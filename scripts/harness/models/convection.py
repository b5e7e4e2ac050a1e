"""Problem 3.2: steady convection and diffusion through two cubes in contact."""

from dataclasses import dataclass
from typing import ClassVar

from harness.models.diffusion import CLOSING, DIFFUSIVITY, HEIGHT
from harness.models.layered import Layered
from harness.models.parts import Condition, Control, Mixture, Solid, Solute, concentration, effective_pressure, pressure

UPSTREAM = 1.0  # concentration at the inlet z = -h/2, mM
PERMEABILITY = 1e-3  # mm^4/(N s)
POROSITY = 0.8
PRESSURES = {0: 0.0, 1: 0.4, 10: 4.0}  # fluid pressure at the inlet (MPa) for each Peclet number

MATERIAL = Mixture(Solid(100.0), PERMEABILITY, POROSITY, (Solute(1, DIFFUSIVITY, DIFFUSIVITY),))
ABOUT = """\
Steady convection and diffusion across a contact interface: problem 3.2 of Ateshian, Maas and Weiss (2012),
J Biomech 45(6):1023-1027, doi:10.1016/j.jbiomech.2012.01.003, at a Peclet number of {peclet}.

Two cubes with edges of 1 mm meet at z = 0. The fluid pressure at the inlet, z = -1 mm, is {pressure:g} MPa, and the
concentration is 1 mM. The fluid pressure and the concentration at the outlet, z = +1 mm, are zero. The outlet moves by
-0.001 mm, which closes the contact. FEBio prescribes the effective fluid pressure p - R T c. The profile is steady
after 20000 s and follows the closed form."""


@dataclass(frozen=True)
class Convection(Layered):
    """Choices of problem 3.2; `peclet` is 0, 1 or 10."""

    control: Control = Control(400, 50.0)
    name: str = "convection"
    peclet: int = 1

    CLOSING = CLOSING
    BOTTOM = -HEIGHT / 2
    MATERIALS: ClassVar = {"gel": MATERIAL}
    COLUMN = (("lower", "gel", HEIGHT / 2), ("upper", "gel", HEIGHT / 2))

    @property
    def title(self) -> str:
        """The name with the Peclet number."""
        return f"{self.name}-pe{self.peclet}"

    @property
    def about(self) -> str:
        """What the model shows."""
        return ABOUT.format(peclet=self.peclet, pressure=PRESSURES[self.peclet])

    @property
    def prescribed(self) -> tuple[Condition, ...]:
        """Inlet below, outlet above."""
        return (
            pressure("bottom", effective_pressure(UPSTREAM, PRESSURES[self.peclet])),
            concentration("bottom", UPSTREAM),
            pressure("top", 0.0),
            concentration("top", 0.0),
        )
