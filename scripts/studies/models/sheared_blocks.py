"""A block that is pressed and sheared, split in two: friction that sticks gives back the conforming reference."""

from dataclasses import dataclass
from enum import Enum

from harness.models import parts
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, column, contacts, header
from harness.models.mesh import Layer, Section
from studies.models.pieces import UNCLAMPED, with_friction


class Kind(str, Enum):
    """A kind of body, under FEBio's name of it."""

    ELASTIC = "elastic"
    RIGID = "rigid"
    BIPHASIC = "biphasic"
    SOLUTE = "biphasic-solute"
    TRIPHASIC = "triphasic"
    MULTIPHASIC = "multiphasic"


FRICTION = 2.0  # so high that all of the contact sticks
PRESS, SHEAR = 0.1, 0.05  # mm by which the upper face moves down, and then along x
PRESSING, SHEARING = 4, 8  # steps
STEP = 10.0  # s
THICKNESS = (0.75, 1.25)  # of the two parts, mm: they meet off half height, so that shear bends it
SECTION = Section((2.0, 1.0), (4, 2))
SOLID = parts.Solid(1.0, 0.3)
SOLUTE = parts.Solute(1, diffusivity=5e-4, free_diffusivity=8e-4)
PERMEABILITY = 1e-3  # mm^4/(N s)
BELOW, ABOVE = 1.0, 0.0  # effective concentrations at the two ends, mM
MODULES = {Kind.ELASTIC: "solid", Kind.BIPHASIC: "biphasic", Kind.SOLUTE: "multiphasic"}
ABOUT = """\
A block of 2 mm x 1 mm x 2 mm, split at a height of 0.75 mm, pressed by 0.1 mm and then sheared by 0.05 mm. With
friction that is high enough (mu = 2) nothing slips: displacements, pressure and concentration are those of
the same block in one piece. Both ends drain."""


@dataclass(frozen=True)
class ShearedBlocks:
    kind: Kind = Kind.ELASTIC  # ``elastic``, ``biphasic`` or ``biphasic-solute``
    interface: InterfaceType = InterfaceType.MIXTURE
    settings: ContactSettings | None = None  # default settings with friction without it
    newton: float = 1e-9  # Newton's relative tolerances
    name: str = "sheared-blocks"

    def model(self) -> Model:
        layers = [Layer(name, "block", THICKNESS[k], 2 + k) for k, name in enumerate(("lower", "upper"))]
        mesh = column(self.interface, layers, bottom=0.0, section=SECTION)
        settings = self.settings or (self.interface.is_contact and with_friction(self.interface, FRICTION)) or None
        steps = PRESSING + SHEARING
        pressed, end = PRESSING * STEP, steps * STEP
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            MODULES[self.kind],
            mesh,
            {"block": self._material()},
            self._conditions(),
            self._control(steps),
            contacts(self.interface, mesh, settings),
            (parts.Curve(((0.0, 0.0), (pressed, 1.0))), parts.Curve(((0.0, 0.0), (pressed, 0.0), (end, 1.0)))),
            further_columns=("Rx", "Rz"),
        )

    def _material(self) -> parts.Material:
        if self.kind is Kind.ELASTIC:
            return parts.Elastic(SOLID)
        return parts.Mixture(SOLID, PERMEABILITY, solutes=(SOLUTE,) if self.kind is Kind.SOLUTE else ())

    def _conditions(self) -> tuple[parts.Condition, ...]:
        held = (
            parts.fix("bottom", "xyz"),
            parts.fix("top", "y"),
            parts.displace("top", "z", -PRESS, 1),
            parts.displace("top", "x", SHEAR, 2),
        )
        fluid = () if self.kind is Kind.ELASTIC else (parts.pressure("bottom", 0.0), parts.pressure("top", 0.0))
        if self.kind is not Kind.SOLUTE:
            return (*held, *fluid)
        dissolved = (
            parts.concentration("bottom", BELOW),
            parts.concentration("top", ABOVE),
            parts.initial_concentration("all", ABOVE),
        )
        return (*held, *fluid, *dissolved)

    def _control(self, steps: int) -> parts.Control:
        unclamped = UNCLAMPED if self.kind is Kind.SOLUTE else ()
        return parts.Control(
            steps,
            STEP,
            displacement_tolerance=self.newton,
            energy_tolerance=self.newton**2,
            pressure_tolerance=self.newton,
            concentration_tolerance=self.newton,
            reformations=30,
            solver=(parts.Param("min_residual", 1e-26), *unclamped),
        )
