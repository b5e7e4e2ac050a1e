"""Gallery: an osteochondral plug whose cartilage is tied on a bone with a coarser mesh."""

from dataclasses import dataclass, replace

import numpy as np

from harness.models import parts
from harness.models.document import Model
from harness.models.indentation_mesh import disk
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh
from studies.models.assembly import assembled, everywhere, plane
from studies.models.pieces import UNCLAMPED

RADIUS = 2.0  # of the cartilage, mm
WIDER = 3.0  # radius of the bone, mm
CARTILAGE_HEIGHT, BONE_HEIGHT = 2.0, 3.0  # mm
COMPRESSION = 0.1  # mm by which the top of the cartilage moves down
RAMP = 500.0  # time of the compression, s
CONCENTRATION = 1.0  # of the solution above the cartilage, mM
CARTILAGE = parts.Mixture(
    parts.Solid(1.0, 0.2), permeability=1e-3, solutes=(parts.Solute(1, 5e-4, free_diffusivity=1e-3),)
)
BONE = parts.Mixture(
    parts.Solid(100.0, 0.2), permeability=1e-4, porosity=0.3, solutes=(parts.Solute(1, 2e-4, free_diffusivity=1e-3),)
)
AMBIENT_PRESSURE = parts.effective_pressure(CONCENTRATION)
"""Effective pressure at this concentration without fluid pressure, MPa."""

ABOUT = """\
An osteochondral plug: cartilage on bone with a coarser mesh, joined by a tie that a solute crosses.

The cartilage has a radius of 2 mm and a height of 2 mm, the bone a radius of 3 mm and a height of 3 mm. Their
meshes do not match. The solution above the cartilage has 1 mM of a solute and no pressure. The effective fluid
pressure at the top is therefore -R T c = -0.0024776 MPa. A porous plate presses the cartilage by 0.1 mm in 500 s.
The solute diffuses through the cartilage into the bone, which contains none at the start. All other faces are
impermeable. By symmetry, the model contains a quarter of both bodies."""


@dataclass(frozen=True)
class Plug:
    interface: InterfaceType = InterfaceType.TIED
    settings: ContactSettings = ContactSettings()
    around: tuple[int, int] = (4, 3)
    up: tuple[int, int] = (8, 4)
    """Elements of the cartilage and of the bone: of each block of the O-grid along each edge, and over the height."""
    control: parts.Control = parts.Control(60, 100.0)
    name: str = "plug"
    plot: bool = False

    def model(self) -> Model:
        mesh = self._mesh()
        conditions = (
            parts.fix("symmetry-x", "x"),
            parts.fix("symmetry-y", "y"),
            parts.fix("bone-bottom", "z"),
            parts.displace("top", "z", -COMPRESSION, 1),
            parts.pressure("top", AMBIENT_PRESSURE, 1),
            parts.concentration("top", CONCENTRATION, 1),
            parts.initial_pressure("all", 0.0),
        )
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "multiphasic",
            mesh,
            {"cartilage": CARTILAGE, "bone": BONE},
            conditions,
            replace(self.control, solver=UNCLAMPED),
            contacts(self.interface, mesh, self.settings),
            (parts.Curve(((0.0, 0.0), (RAMP, 1.0))),),
            plot=self.plot,
            further_columns=("Rz",),
        )

    def _mesh(self) -> Mesh:
        heights = [
            np.linspace(0.0, CARTILAGE_HEIGHT, self.up[0] + 1).tolist(),
            np.linspace(-BONE_HEIGHT, 0.0, self.up[1] + 1).tolist(),
        ]
        bodies = {
            "cartilage": disk(RADIUS, self.around[0], heights[0]),
            "bone": disk(WIDER, self.around[1], heights[1]),
        }
        node_sets = {
            "all": everywhere(),
            "symmetry-x": plane("x", 0.0),
            "symmetry-y": plane("y", 0.0),
            "bone-bottom": plane("z", -BONE_HEIGHT, "bone"),
            "top": plane("z", CARTILAGE_HEIGHT, "cartilage"),
        }
        surfaces = {"cartilage-bottom": plane("z", 0.0, "cartilage"), "bone-top": plane("z", 0.0, "bone")}
        return assembled(bodies, node_sets, surfaces, {"joint": ("cartilage-bottom", "bone-top")})
