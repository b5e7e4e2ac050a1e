"""A hollow hemisphere pressed into a block without friction, then turned on it with friction."""

from dataclasses import dataclass, replace

import numpy as np

from harness.arrays import Array
from harness.models.document import Model
from harness.models.interface import InterfaceType, contacts, default_settings, header
from harness.models.mesh import Mesh
from harness.models.parts import Curve, Elastic, Param, Solid
from studies.models import spherical_shells
from studies.models.assembly import assembled, box, plane, sphere
from studies.models.pieces import driven, hold, timed

OUTER, INNER, SIDE = 1.0, 2.0 / 3.0, 2.0  # radii of the hemisphere and edge of the block, mm
STIFF, SOFT = Solid(50.0, 0.3), Solid(10.0, 0.3)
FRICTION = 0.5
DEPTH = 1.0  # mm by which the hemisphere is pressed down
TURN = 180.0  # degrees
PRESSED, END = 10.0, 100.0  # s
TURNING_STEPS = 45
ABOUT = """\
A hollow hemisphere (radii 1 and 2/3 mm) is pressed by 1 mm into a block of 2 mm without friction, then turned by 180
degrees with friction (mu = 0.5): example of Sauer and De Lorenzis (2015), Int J Numer Methods Eng 101(4):251-280, and
of Zimmerman and Ateshian (2018), J Biomech Eng 140(8):081013. The contact sticks at first and slides in the end."""


@dataclass(frozen=True)
class TwistingHemisphere:
    elements: int = 6
    """Of the hemisphere along each edge of its lowest patch; even. The block has two more along each edge."""
    interface: InterfaceType = InterfaceType.MIXTURE
    name: str = "twisting-hemisphere"

    def model(self) -> Model:
        mesh, moved, curves = driven(self._mesh(), self.times, motion)
        rubbing = Curve(((0.0, 0.0), (PRESSED, 0.0), (PRESSED + 1e-6, 1.0), (END, 1.0)))
        control, steps = timed(
            self.times, len(curves) + 2, displacement_tolerance=1e-4, energy_tolerance=1e-6, reformations=40
        )
        given = default_settings(self.interface)
        settings = replace(given, extra=(*given.extra, Param("fric_coeff", FRICTION, len(curves) + 1)))
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "solid",
            mesh,
            {"block": Elastic(SOFT), "hemisphere": Elastic(STIFF)},
            (*hold("base", "xyz"), *moved),
            control,
            contacts(self.interface, mesh, settings),
            (*curves, rubbing, steps),
            further_columns=("Rx", "Ry", "Rz"),
        )

    @property
    def times(self) -> tuple[float, ...]:
        """Ends of the steps, s: ten of pressing, then those of turning."""
        turning = np.linspace(PRESSED, END, TURNING_STEPS + 1)[1:]
        return (*(PRESSED * k / 10.0 for k in range(1, 11)), *turning.tolist())

    def _mesh(self) -> Mesh:
        n = self.elements + 2
        body = spherical_shells.hemisphere(self.elements, np.linspace(INNER, OUTER, 3))
        bodies = {
            "block": box((-SIDE / 2, -SIDE / 2, 0.0), (SIDE / 2, SIDE / 2, SIDE), (n, n, n)),
            "hemisphere": replace(body, nodes=body.nodes + np.array([0.0, 0.0, SIDE + OUTER])),
        }
        sets = {"base": plane("z", 0.0, "block"), "grip": plane("z", SIDE + OUTER, "hemisphere")}
        surfaces = {"block": plane("z", SIDE, "block"), "hemisphere": sphere(OUTER, "hemisphere", SIDE + OUTER)}
        return assembled(bodies, sets, surfaces, {"contact": ("hemisphere", "block")})


def angle(time: Array | float) -> Array:
    """By how much the hemisphere has turned at a time (s), degrees."""
    return np.asarray(TURN * np.maximum(0.0, (np.asarray(time) - PRESSED) / (END - PRESSED)))


def position(start: Array, time: float) -> Array:
    """Where a point of the rim is at a time (s)."""
    down = DEPTH * min(1.0, time / PRESSED)
    turned = np.radians(angle(time))
    c, s = np.cos(turned), np.sin(turned)
    return np.array([c * start[0] - s * start[1], s * start[0] + c * start[1], start[2] - down])


def motion(positions: Array, time: float) -> Array:
    """Displacements (mm) of points of the rim at a time (s), shape (n, 3)."""
    return np.stack([position(start, time) - start for start in positions])
