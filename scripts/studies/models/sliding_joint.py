"""Gallery: a section of a joint, cartilage on cartilage, pressed and then slid: stick and slip zones."""

from dataclasses import dataclass

import numpy as np

from harness.models.document import Model
from harness.models.interface import InterfaceType, contacts, header
from harness.models.parts import Curve, Mixture, Solid, displace, fix
from studies.models.assembly import everywhere
from studies.models.joint import BONES, touching
from studies.models.pieces import timed, with_friction

HALF_WIDTHS = {"upper": 3.0, "lower": 3.6}  # mm
ACROSS, THROUGH = 48, 6  # elements along the width and through the thickness of each layer
GROWTH = 1.3  # of the elements of a layer, from the surface of the joint to the bone
APPROACH, WAY = 0.08, 0.06  # mm by which the upper bone approaches, and then slides
PRESSED, DRAINED, END = 2.0, 60.0, 72.0  # s, when the bone has approached, begins to slide, and ends
PRESSING, DRAINING, SLIDING = 4, 12, 24  # steps
FRICTION, SOLID_FRACTION = 0.2, 0.1
FACET_COLUMNS = ("contact pressure", "contact friction.x", "contact friction.y", "contact friction coefficient")
"""Means over facets."""
CARTILAGE = Mixture(Solid(1.0, 0.1), permeability=1e-3)
ABOUT = """\
Cartilage slides on cartilage: friction in this section of a joint depends on the load that the fluid bears.

Two layers of 1 mm cover rigid bone. The upper layer is convex with a radius of 15 mm. The upper bone approaches by
0.08 mm within 2 s. It then rests until 60 s, and the fluid leaves the contact, at its edges first. The bone finally
slides by 0.06 mm within 12 s. The friction (mu_eq = 0.2, phi = 0.1) follows from the load that the solid bears. Slip
therefore begins at the edges and moves inwards, until the whole contact slides."""


@dataclass(frozen=True)
class SlidingJoint:
    """The sliding joint, without or with a plot file."""

    plot: bool = False

    def model(self) -> Model:
        x = {layer: np.linspace(-width, width, ACROSS + 1) for layer, width in HALF_WIDTHS.items()}
        mesh = touching(x, THROUGH, GROWTH, {"all": everywhere(), **BONES})
        given = with_friction(InterfaceType.MIXTURE, FRICTION, solid_fraction=SOLID_FRACTION)
        press = Curve(((0.0, 0.0), (PRESSED, 1.0)))
        slide = Curve(((0.0, 0.0), (DRAINED, 0.0), (END, 1.0)))
        control, steps = timed(
            times(), 3, displacement_tolerance=1e-4, energy_tolerance=1e-6, pressure_tolerance=1e-4, reformations=30
        )
        return Model(
            "sliding-joint",
            header("sliding-joint", ABOUT, InterfaceType.MIXTURE),
            "biphasic",
            mesh,
            {"lower": CARTILAGE, "upper": CARTILAGE},
            (
                fix("all", "z"),
                fix("lower-bone", "xy"),
                displace("upper-bone", "y", -APPROACH, 1),
                displace("upper-bone", "x", WAY, 2),
            ),
            control,
            contacts(InterfaceType.MIXTURE, mesh, given),
            (press, slide, steps),
            plot=self.plot,
            further_columns=("Rx", "Ry"),
            facet_columns=FACET_COLUMNS,
        )


def times() -> tuple[float, ...]:
    """Ends of the time steps, s."""
    pressing = np.linspace(0.0, PRESSED, PRESSING + 1)[1:]
    draining = PRESSED * (DRAINED / PRESSED) ** (np.arange(1, DRAINING + 1) / DRAINING)
    sliding = np.linspace(DRAINED, END, SLIDING + 1)[1:]
    return tuple(np.concatenate([pressing, draining, sliding]).tolist())
