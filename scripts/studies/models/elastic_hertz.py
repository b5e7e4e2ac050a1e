"""A sphere pressed on a block of the same material, without friction: Hertz's contact over a circle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.models.blocks import Body, Points
from harness.models.document import Model
from harness.models.interface import InterfaceType, contacts, header
from harness.models.mesh import Mesh
from harness.models.parts import Control, Curve, Elastic, Solid, displace, fix
from studies.models.assembly import NEAR, Chosen, assembled, plane, raised, refined, tensor
from studies.models.pieces import hold

RADIUS = 10.0  # mm
CONTACT_RADIUS = 0.02
"""a for which the approach is chosen, mm: small beside the radius, since the closed form is linear."""
SIZE = 10.0 * CONTACT_RADIUS  # width and height of the modelled quarter of each body, mm
SOLID = Solid(1000.0, 0.3)
COMBINED = SOLID.modulus / (2.0 * (1.0 - SOLID.poisson**2))  # E*, MPa
APPROACH = CONTACT_RADIUS**2 / RADIUS  # mm, of points far from the contact
GROWTH = 1.4  # of the elements outside of the contact
FINE = 1.25  # width of the finest part of the mesh, relative to a
STEPS = 4
ABOUT = """\
A sphere of radius 10 mm on a block, the same material, pressed together without friction (Hertz, over a circle).
By symmetry a quarter is modelled, within ten radii of the contact."""


@dataclass(frozen=True)
class ElasticHertz:
    elements: int = 5  # over the radius of the contact
    name: str = "elastic-hertz"

    def model(self) -> Model:
        mesh = self._mesh()
        return Model(
            self.name,
            header(self.name, ABOUT, InterfaceType.MIXTURE),
            "solid",
            mesh,
            {"block": Elastic(SOLID), "sphere": Elastic(SOLID)},
            (
                fix("middle-x", "x"),
                fix("middle-y", "y"),
                *hold("block-outside", "xyz"),
                *hold("sphere-outside", "xy"),
                displace("sphere-outside", "z", -APPROACH, 1),
            ),
            Control(STEPS, 1.0, displacement_tolerance=1e-6, energy_tolerance=1e-9, reformations=40),
            contacts(InterfaceType.MIXTURE, mesh, None),
            (Curve(((0.0, 0.0), (float(STEPS), 1.0))),),
            further_columns=("Rz",),
            facet_columns=("contact pressure",),
        )

    def _mesh(self) -> Mesh:
        """Both bodies with nodes at the same x and y; the sphere touches at the origin."""
        sets = {
            "middle-x": plane("x", 0.0),
            "middle-y": plane("y", 0.0),
            "block-outside": Chosen("block", _outside),
            "sphere-outside": Chosen("sphere", _outside),
        }
        surfaces = {
            "block": Chosen("block", lambda x: _near(x) & (np.abs(x[..., 2]) < NEAR)),
            "sphere": Chosen("sphere", lambda x: _near(x) & (np.abs(x[..., 2] - _profile(x)) < NEAR)),
        }
        # The lower face of the sphere is round; its top stays.
        sphere = raised(self._box(1.0), "z", lambda x: _profile(x) * (1.0 - x[..., 2] / SIZE))
        bodies = {"block": self._box(-1.0), "sphere": sphere}
        return assembled(bodies, sets, surfaces, {"contact": ("sphere", "block")})

    def _box(self, up: float) -> Body:
        """A box above (1) or below (-1) z = 0, fine around the origin."""
        size = CONTACT_RADIUS / self.elements
        along = refined(round(FINE * self.elements) * size, size, SIZE, GROWTH)
        return tensor([along, along, up * refined(0.0, size, SIZE, GROWTH)])


def _profile(x: Points) -> NDArray[np.float64]:
    """Height of the sphere over the block at first touch, mm."""
    return np.asarray((x[..., 0] ** 2 + x[..., 1] ** 2) / (2.0 * RADIUS))


def _outside(x: Points) -> NDArray[np.bool_]:
    """Sides and far ends: outer faces but the one in contact and those of symmetry."""
    return np.asarray(np.maximum(np.maximum(x[..., 0], x[..., 1]), np.abs(x[..., 2])) > SIZE - NEAR)


def _near(x: Points) -> NDArray[np.bool_]:
    return np.asarray(np.maximum(x[..., 0], x[..., 1]) < 2.0 * CONTACT_RADIUS)
