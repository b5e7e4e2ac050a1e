"""Gallery: a graft in a cylindrical defect of cartilage, fed by the host across the wall."""

from dataclasses import dataclass, replace

import numpy as np

from harness.models import blocks, parts
from harness.models.blocks import Body
from harness.models.document import Model
from harness.models.indentation_mesh import disk
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh
from studies.models.assembly import assembled, cylinder, everywhere, graded, plane
from studies.models.pieces import UNCLAMPED, ambient

DEFECT = 2.0  # radius of the defect, mm
PRESS_FIT = 0.02  # mm by which the graft's radius exceeds that of the defect
OUTER = 5.0  # radius of the modelled part of the host, mm
HEIGHT = 2.0  # thickness of the cartilage and of the graft, mm
CONCENTRATION = 1.0  # of the host at first, and of its surroundings, mM
HOST = parts.Mixture(
    parts.Solid(1.0, 0.2), permeability=1e-3, solutes=(parts.Solute(1, diffusivity=5e-4, free_diffusivity=1e-3),)
)
GRAFT = parts.Mixture(
    parts.Solid(0.3, 0.2),
    permeability=5e-3,
    porosity=0.9,
    solutes=(parts.Solute(1, 8e-4, free_diffusivity=1e-3, solubility=0.9),),
)
AMBIENT_PRESSURE = parts.effective_pressure(CONCENTRATION)
"""Effective pressure at this concentration without fluid pressure, MPa."""
GROWTH = 1.3  # of the elements of the host, from the wall of the defect outwards

ABOUT = """\
A graft in a defect of cartilage, to which the host supplies a nutrient across the contact.

A cylindrical graft with a radius of 2.02 mm and a height of 2 mm is pressed into a defect with a radius of 2 mm that
reaches to the bone. The host contains 1 mM of a nutrient. The fluid at its top and at its outer side (radius 5 mm) has
1 mM and no pressure. The effective fluid pressure there is therefore -R T c = -0.0024776 MPa. The graft contains no
nutrient at the start, and an impermeable membrane closes its top. The nutrient enters through the wall alone. Only the
protruding rim of the graft has the ambient values. The graft is softer and more permeable than the host, and its
solubility is 0.9. The actual concentration therefore jumps at the wall, and the effective concentration does not. The
bone below is impermeable, and no load acts on the top. By symmetry, the model contains a quarter of both bodies."""


@dataclass(frozen=True)
class Graft:
    around: int = 4
    """Elements of each block of the graft's O-grid along each edge; the wall's quarter circle has twice as many."""
    # Elements of the host from the wall outwards, and of both bodies over the height.
    outward: int = 7
    up: int = 5
    control: parts.Control = parts.Control(60, 50.0)
    plot: bool = False

    def model(self) -> Model:
        mesh = self._mesh()
        settings = ContactSettings(extra=ambient(AMBIENT_PRESSURE, CONCENTRATION))
        conditions = (
            parts.fix("symmetry-x", "x"),
            parts.fix("symmetry-y", "y"),
            parts.fix("bone", "z"),
            parts.fix("host-side", "xy"),
            *(parts.pressure(where, AMBIENT_PRESSURE) for where in ("host-side", "host-top")),
            *(parts.concentration(where, CONCENTRATION) for where in ("host-side", "host-top")),
            parts.initial_concentration("host", CONCENTRATION),
            parts.initial_pressure("host", AMBIENT_PRESSURE),
        )
        return Model(
            "graft",
            header("graft", ABOUT, InterfaceType.MIXTURE),
            "multiphasic",
            mesh,
            {"host": HOST, "graft": GRAFT},
            conditions,
            replace(self.control, solver=UNCLAMPED),
            contacts(InterfaceType.MIXTURE, mesh, settings),
            plot=self.plot,
        )

    def _mesh(self) -> Mesh:
        node_sets = {
            "host": everywhere("host"),
            "symmetry-x": plane("x", 0.0),
            "symmetry-y": plane("y", 0.0),
            "bone": plane("z", 0.0),
            "host-side": cylinder(OUTER, "host"),
            "host-top": plane("z", HEIGHT, "host"),
        }
        surfaces = {"wall": cylinder(DEFECT, "host"), "graft-side": cylinder(DEFECT + PRESS_FIT, "graft")}
        heights = [HEIGHT * level / self.up for level in range(self.up + 1)]
        bodies = {"host": self._host(heights), "graft": disk(DEFECT + PRESS_FIT, self.around, heights)}
        return assembled(bodies, node_sets, surfaces, {"wall": ("graft-side", "wall")})

    def _host(self, heights: list[float]) -> Body:
        """A quarter ring, with as many facets on the wall as the graft has on its side."""
        radius = DEFECT + graded(OUTER - DEFECT, self.outward, GROWTH)
        angle = np.linspace(0.0, np.pi / 2, 2 * self.around + 1)
        r, a, z = np.meshgrid(radius, angle, heights, indexing="ij")
        return blocks.structured(np.stack([r * np.cos(a), r * np.sin(a), z], axis=-1))
