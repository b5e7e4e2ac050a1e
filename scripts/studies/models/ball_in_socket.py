"""A joint in its simplest shape: two layers on rigid bone, a ball and its socket, pressed together and slid."""

from dataclasses import dataclass

import numpy as np

from harness.models import parts
from harness.models.blocks import Body
from harness.models.document import Model
from harness.models.interface import InterfaceType, header
from harness.models.mesh import Mesh
from studies.models import spherical_shells
from studies.models.assembly import assembled, plane, sphere
from studies.models.pieces import hold
from studies.models.quadratic import quadratic
from studies.models.tetrahedra import tetrahedra

RADIUS, THICKNESS, GAP = 10.0, 2.0, 0.05  # of the ball, of both layers, and of the gap between them, mm
SOLID = parts.Solid(1.0, 0.1)
PERMEABILITY = 1e-3  # mm^4/(N s)
PRESSED, SLID = 0.25, 1.0  # mm by which the bone of the ball comes down, and then goes sideways
ABOUT = """\
A ball in its socket: two layers of {material} with a thickness of 2 mm cover rigid bone. The ball has a radius of
10 mm. Its bone moves down by {pressed:g} mm and then sideways by {slid:g} mm."""


@dataclass(frozen=True)
class BallInSocket:
    elements: int = 8
    """Of the ball along each edge of the lowest patch of its hemisphere, even; the socket has two more."""
    quadratic: bool = False  # tetrahedra of ten nodes
    porous: bool = False  # biphasic layers, wet where they are not in contact
    slides: bool = True
    updates: int = 0  # quasi-Newton updates (BFGS) between two matrices
    primary: str = "ball"  # surface that the contact integrates over: ``ball`` or ``socket``
    contact: str = InterfaceType.MIXTURE.value  # type of the contact
    params: tuple[parts.Param, ...] = ()  # of the contact
    steps: int = 10  # time steps to press, and as many to slide
    name: str = "ball-in-socket"
    plot: bool = False  # with a plot file

    def model(self) -> Model:
        material = parts.Mixture(SOLID, PERMEABILITY) if self.porous else parts.Elastic(SOLID)
        stepper = parts.TimeStepper(1.0, retries=6, optimal_iterations=15)
        steps = (2 if self.slides else 1) * self.steps
        interface = InterfaceType.ours_in([self.contact])
        what = "biphasic tissue" if self.porous else "elastic tissue"
        return Model(
            self.name,
            header(self.name, ABOUT.format(material=what, pressed=PRESSED, slid=SLID if self.slides else 0), interface),
            "biphasic" if self.porous else "solid",
            self._mesh(),
            {"ball": material, "socket": material},
            self._conditions(),
            parts.Control(steps, 1.0, reformations=25, stepper=stepper, updates=self.updates),
            (parts.Contact(self.contact, "joint", self.params),),
            (parts.Curve(((0.0, 0.0), (self.steps, 1.0))), parts.Curve(((self.steps, 0.0), (2.0 * self.steps, 1.0)))),
            plot=self.plot,
        )

    def _conditions(self) -> tuple[parts.Condition, ...]:
        held = (*hold("socket-bone", "xyz"), *hold("ball-bone", "y" if self.slides else "xy"))
        moved = (
            parts.displace("ball-bone", "z", -PRESSED, 1),
            *([parts.displace("ball-bone", "x", SLID, 2)] * self.slides),
        )
        return (*held, *moved, *([parts.pressure("rims", 0.0)] * self.porous))

    def _mesh(self) -> Mesh:
        inner = RADIUS + GAP
        bodies = {
            "ball": self._layer(self.elements, RADIUS - THICKNESS),
            "socket": self._layer(self.elements + 2, inner),
        }
        sets = {
            "ball-bone": sphere(RADIUS - THICKNESS, "ball"),
            "socket-bone": sphere(inner + THICKNESS, "socket"),
            "rims": plane("z", 0.0),
        }
        surfaces = {"ball": sphere(RADIUS, "ball"), "socket": sphere(inner, "socket")}
        other = "socket" if self.primary == "ball" else "ball"
        mesh = assembled(bodies, sets, surfaces, {"joint": (self.primary, other)})
        return quadratic(mesh, 10) if self.quadratic else mesh

    def _layer(self, elements: int, radius: float) -> Body:
        through = max(1, self.elements // 4)
        radii = np.linspace(radius, radius + THICKNESS, through + 1)
        return tetrahedra(spherical_shells.hemisphere(elements, radii))
