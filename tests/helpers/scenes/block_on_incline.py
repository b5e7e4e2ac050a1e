"""A rigid block that is pushed up an incline against friction: NAFEMS benchmark CGS-4."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh
from harness.models.parts import Control, Curve, Elastic, Rigid, Solid, hold_rigid, push_rigid
from studies.models.assembly import assembled, box, plane
from studies.models.pieces import hold, move_rigid, with_friction

FRICTION, SLOPE = 0.3, 0.1
WEIGHT = 1e-3
"""N."""
MODULUS = 100.0
"""Of the incline, MPa: the block sinks in by 1e-5 of its size, and turns the normal by no more."""
OVERLAP = 1e-9
"""mm by which the block overlaps the incline at first, so that its weight finds it in contact."""
WAY = 0.5
"""mm along x by which the block is pushed."""
STANDING, PUSHED = 2, 20
"""Steps of 1 s in which the block stands, its weight growing, and in which it is pushed."""
ABOUT = """\
A rigid block of 1 mm on an incline of 1:10, pushed by a horizontal force against friction (mu = 0.3), as in NAFEMS
benchmark CGS-4. While it slides, the force over the weight is (tan a + mu)/(1 - mu tan a) = 0.412371."""


@dataclass(frozen=True)
class BlockOnIncline:
    """Choices of this problem.

    Attributes
    ----------
    interface : InterfaceType
    settings : ContactSettings, optional
        Default settings with friction without it.
    block_is_primary : bool
    name : str
    """

    interface: InterfaceType = InterfaceType.MIXTURE
    settings: ContactSettings | None = None
    block_is_primary: bool = True
    name: str = "block-on-incline"

    def model(self) -> Model:
        """The model of these choices."""
        mesh = self._mesh()
        steps = STANDING + PUSHED
        weight = Curve(((0.0, 0.0), (float(STANDING), 1.0)))
        push = Curve(((0.0, 0.0), (float(STANDING), 0.0), (float(steps), 1.0)))
        settings = self.settings or with_friction(self.interface, FRICTION)
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "solid",
            mesh,
            {"slope": Elastic(Solid(MODULUS)), "block": Rigid()},
            (
                *hold("base", "xyz"),
                hold_rigid("block", "yuvw"),
                move_rigid("block", "x", WAY, 2),
                push_rigid("block", "z", -WEIGHT, 1),
            ),
            Control(steps, 1.0, displacement_tolerance=1e-8, energy_tolerance=1e-8, reformations=30),
            contacts(self.interface, mesh, settings),
            (weight, push),
            further_columns=("Rx", "Rz"),
        )

    def _mesh(self) -> Mesh:
        """Both bodies on level ground, then every height raised by the slope."""
        bodies = {
            "slope": box((-1.0, -1.0, -1.0), (2.5, 2.0, 0.0), (7, 3, 2)),
            "block": box((0.0, 0.0, -OVERLAP), (1.0, 1.0, 1.0), (2, 2, 2)),
        }
        surfaces = {"slope": plane("z", 0.0, "slope"), "block": plane("z", -OVERLAP, "block")}
        pair = ("block", "slope") if self.block_is_primary else ("slope", "block")
        level = assembled(bodies, {"base": plane("z", -1.0, "slope")}, surfaces, {"contact": pair})
        return replace(level, nodes=level.nodes + SLOPE * level.nodes[:, :1] * np.array([0.0, 0.0, 1.0]))
