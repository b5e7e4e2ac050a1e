"""Two blocks of hexahedra with many facets that do not match, pressed together."""

from dataclasses import dataclass, replace
from typing import ClassVar

from harness.models.document import Model
from harness.models.interface import InterfaceType, header
from harness.models.mesh import Box, Mesh, assemble
from harness.models.parts import Contact, Control, Curve, Elastic, Param, Solid, TimeStepper, displace, fix

SIZE = 1.0  # of each block along each axis, mm
SOLID = Solid(1.0, 0.1)
PRESSED = 0.05  # mm by which the top comes down over the run
PRIMARY, SECONDARY = "lower-top", "upper-bottom"
ABOUT = """\
Two elastic blocks of 1 mm x 1 mm x 1 mm, whose facets do not match. The top of the upper one comes down by
{pressed:g} mm in {steps} steps."""


@dataclass(frozen=True)
class PressedBlocks:
    # Elements of the two blocks along x and y.
    lower: int = 50
    upper: int = 46
    through: int = 6  # elements through each block
    contact: str = InterfaceType.MIXTURE.value  # type of the contact
    params: tuple[Param, ...] = ()  # of the contact
    steps: int = 2  # time steps
    name: str = "pressed-blocks"
    primary: ClassVar[str] = PRIMARY
    porous: ClassVar[bool] = False

    def model(self) -> Model:
        interface = InterfaceType.ours_in([self.contact])
        stepper = TimeStepper(1.0, retries=6, optimal_iterations=15)
        return Model(
            self.name,
            header(self.name, ABOUT.format(pressed=PRESSED, steps=self.steps), interface),
            "solid",
            self._mesh(),
            {"tissue": Elastic(SOLID)},
            (fix("lower-bottom", "xyz"), fix("upper-top", "xy"), displace("upper-top", "z", -PRESSED, 1)),
            Control(self.steps, 1.0, reformations=25, stepper=stepper),
            (Contact(self.contact, "blocks", self.params),),
            (Curve(((0.0, 0.0), (float(self.steps), 1.0))),),
        )

    def _mesh(self) -> Mesh:
        boxes = [self._box("lower", self.lower, -SIZE), self._box("upper", self.upper, 0.0)]
        return replace(assemble(boxes), pairs={"blocks": (PRIMARY, SECONDARY)})

    def _box(self, name: str, elements: int, bottom: float) -> Box:
        corner = (-SIZE / 2, -SIZE / 2, bottom)
        return Box(name, "tissue", corner, (SIZE, SIZE, SIZE), (elements, elements, self.through))
