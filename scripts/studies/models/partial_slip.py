"""A cylinder pressed on a block of the same material and pushed sideways: stick in the middle, slip at the edges."""

from collections.abc import Callable
from dataclasses import dataclass
from math import log

import numpy as np
from numpy.typing import NDArray

from harness.models.blocks import Body
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh
from harness.models.parts import Control, Curve, Elastic, Solid, displace, fix
from studies.models.assembly import NEAR, Chosen, Inside, assembled, everywhere, raised, refined, tensor
from studies.models.pieces import hold, with_friction

Height = Callable[[NDArray[np.float64]], NDArray[np.float64]]  # height of a surface (mm) at positions along x (mm)
RADIUS = 10.0  # mm
HALF_WIDTH = 0.02  # a of the contact, mm, for which the approach is chosen
SIZE = 20.0 * HALF_WIDTH  # half-width and height of each body, mm: a half space but for parts of (a/SIZE)^2
FRICTION = 0.3
FRICTION_COLUMNS = ("contact friction.x",)  # means over facets, which FEBio's types do not have
SOLID = Solid(1000.0, 0.3)
COMBINED = SOLID.modulus / (2.0 * (1.0 - SOLID.poisson**2))  # E*, MPa
THICKNESS = 0.01  # of the plane problem, mm
GROWTH = 1.3  # of the elements outside of the contact
FINE = 1.25  # half-width of the finest part of the mesh, relative to a
PRESSING, SHEARING = 5, 10  # steps
APPROACH = HALF_WIDTH**2 / (2.0 * RADIUS) * (log(2.0 * SIZE / HALF_WIDTH) - 0.5 * SOLID.poisson / (1.0 - SOLID.poisson))
"""mm, of a cylinder of that contact on a layer of height SIZE, twice: Johnson (1985), equation 5.59."""
SHIFT = 0.64 * FRICTION * APPROACH  # mm along x; about that of Q/(mu P) = 0.64, a stick zone of 0.6 a
ABOUT = """\
A cylinder of radius 10 mm on a block, the same material, pressed and then pushed sideways by less than slides it
(Cattaneo, Mindlin): the middle of the contact sticks, its edges slip."""


@dataclass(frozen=True)
class PartialSlip:
    elements: int = 10  # over half the width of the contact
    settings: ContactSettings | None = None  # default settings with friction without it
    name: str = "partial-slip"

    def model(self) -> Model:
        mesh = self._mesh()
        steps = PRESSING + SHEARING
        press = Curve(((0.0, 0.0), (float(PRESSING), 1.0)))
        shear = Curve(((0.0, 0.0), (float(PRESSING), 0.0), (float(steps), 1.0)))
        return Model(
            self.name,
            header(self.name, ABOUT, InterfaceType.MIXTURE),
            "solid",
            mesh,
            {"block": Elastic(SOLID), "cylinder": Elastic(SOLID)},
            (
                fix("all", "y"),
                *hold("block-outside", "xz"),
                displace("cylinder-outside", "z", -APPROACH, 1),
                displace("cylinder-outside", "x", SHIFT, 2),
            ),
            Control(steps, 1.0, displacement_tolerance=1e-6, energy_tolerance=1e-9, reformations=40),
            contacts(InterfaceType.MIXTURE, mesh, self.settings or with_friction(InterfaceType.MIXTURE, FRICTION)),
            (press, shear),
            further_columns=("Rx", "Rz"),
            facet_columns=("contact pressure", *FRICTION_COLUMNS),
        )

    def _mesh(self) -> Mesh:
        """Both bodies with nodes at the same x; the cylinder touches at x = 0."""
        sets = {
            "all": everywhere(),
            "block-outside": Chosen("block", _outside),
            "cylinder-outside": Chosen("cylinder", _outside),
        }
        surfaces = {
            "block": Chosen("block", _near_contact(np.zeros_like)),
            "cylinder": Chosen("cylinder", _near_contact(_profile)),
        }
        # The lower face of the cylinder is round; its top stays.
        cylinder = raised(self._block(1.0), "z", lambda x: _profile(x[..., 0]) * (1.0 - x[..., 2] / SIZE))
        bodies = {"block": self._block(-1.0), "cylinder": cylinder}
        return assembled(bodies, sets, surfaces, {"contact": ("cylinder", "block")})

    def _block(self, up: float) -> Body:
        """A box above (1) or below (-1) z = 0, fine around the origin."""
        size = HALF_WIDTH / self.elements
        along = refined(round(FINE * self.elements) * size, size, SIZE, GROWTH)
        x = np.concatenate([-along[:0:-1], along])
        return tensor([x, np.array([0.0, THICKNESS]), up * refined(0.0, size, SIZE, GROWTH)])


def _profile(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Height of the cylinder over the block at first touch, mm."""
    return np.asarray(x**2 / (2.0 * RADIUS))


def _outside(x: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Sides and far ends: all outer faces but the one in contact."""
    return np.asarray(np.maximum(np.abs(x[..., 0]), np.abs(x[..., 2])) > SIZE - NEAR)


def _near_contact(height: Height) -> Inside:
    """Positions on a surface of given height, within two half-widths of the contact."""
    wide = 2.0 * HALF_WIDTH
    return lambda x: np.asarray((np.abs(x[..., 2] - height(x[..., 0])) < NEAR) & (np.abs(x[..., 0]) < wide))
