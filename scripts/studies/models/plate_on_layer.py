"""A cartilage layer that drains under a sliding plate: friction grows as the fluid bears less of the load."""

from dataclasses import dataclass

import numpy as np

from harness.models import parts
from harness.models.document import Model
from harness.models.interface import InterfaceType, contacts, header
from harness.models.mesh import Mesh
from studies.models.assembly import NEAR, Chosen, assembled, box, everywhere, plane, tensor
from studies.models.pieces import hold, move_rigid, timed, with_friction

HEIGHT = 1.0  # mm
MODULUS = 1.0  # aggregate modulus H (MPa): Young's modulus, since Poisson's ratio is 0
PERMEABILITY = 1e-3  # mm^4/(N s)
LOAD = 1e-4  # P0, MPa; small, so that strains are. The area is 1 mm^2
FRICTION = 0.2
ELEMENTS = 20  # through the thickness of the layer
OVERLAP = 1e-9  # mm by which the plate overlaps the layer at first, so that the load finds it in contact
WAY = 2.0  # mm by which the plate slides
DIFFUSION_TIME = HEIGHT**2 / (MODULUS * PERMEABILITY)  # h^2/(H k), s
EVEN_STEPS, FIRST_STEP, GROWTH, STEPS = 10, 1e-3, 1.03, 220
"""The first steps are of one size, tau = 0.001; then each is longer by 3 % of the time, up to tau = 5."""
TIMES = tuple(
    DIFFUSION_TIME * FIRST_STEP * (k if k <= EVEN_STEPS else EVEN_STEPS * GROWTH ** (k - EVEN_STEPS))
    for k in range(1, STEPS + 1)
)
"""Ends of the steps, s."""
ABOUT = """\
A rigid plate slides on a confined biphasic layer of cartilage. Its friction grows while the fluid leaves the layer.

The layer is 1 mm thick, and its base is fixed and drained. The plate is impermeable. A pressure of 0.0001 MPa presses
the plate onto the layer from the start. The friction is mu_eq = 0.2 times the part of the load that the solid bears.
The effective friction coefficient grows from phi mu_eq to mu_eq within about h^2/(H k) = 1000 s."""


@dataclass(frozen=True)
class PlateOnLayer:
    solid_fraction: float = 0.1  # phi, the fraction of the contact that is solid on solid
    layer_is_primary: bool = True
    name: str = "plate-on-layer"
    plot: bool = False

    def model(self) -> Model:
        mesh = self._mesh()
        settings = with_friction(InterfaceType.MIXTURE, FRICTION, solid_fraction=self.solid_fraction)
        load = parts.Curve(((0.0, 1.0), (TIMES[-1], 1.0)))
        # Tolerances are far below the first friction force, a small part of the load.
        control, steps = timed(
            TIMES, 3, displacement_tolerance=1e-5, energy_tolerance=1e-8, pressure_tolerance=1e-5, reformations=25
        )
        slide = parts.Curve(((0.0, 0.0), *((time, (k + 1) / STEPS) for k, time in enumerate(TIMES))))
        return Model(
            self.name,
            header(self.name, ABOUT, InterfaceType.MIXTURE),
            "biphasic",
            mesh,
            {"layer": parts.Mixture(parts.Solid(MODULUS), PERMEABILITY), "plate": parts.Rigid()},
            (
                *hold("layer", "x"),
                parts.fix("layer", "y"),
                parts.fix("base", "z"),
                parts.pressure("base", 0.0),
                parts.hold_rigid("plate", "yuvw"),
                move_rigid("plate", "x", WAY, 2),
                parts.push_rigid("plate", "z", -LOAD, 1),
            ),
            control,
            contacts(InterfaceType.MIXTURE, mesh, settings),
            (load, slide, steps),
            plot=self.plot,
            further_columns=("Rx", "Rz"),
        )

    def _mesh(self) -> Mesh:
        """The plate is so long that it covers the layer all the way."""
        heights = np.linspace(0.0, HEIGHT, ELEMENTS + 1)
        ends = np.array([0.0, 1.0])
        bodies = {
            "layer": tensor([ends, ends, heights]),
            "plate": box((-WAY - 0.3, -0.3, HEIGHT - OVERLAP), (1.3, 1.3, HEIGHT + 0.3), (4, 1, 1)),
        }
        sets = {"layer": everywhere("layer"), "base": plane("z", 0.0, "layer")}
        surfaces = {
            "layer": plane("z", HEIGHT, "layer"),
            "plate": Chosen("plate", lambda x: np.asarray(x[..., 2] < HEIGHT + NEAR)),
        }
        pair = ("layer", "plate") if self.layer_is_primary else ("plate", "layer")
        return assembled(bodies, sets, surfaces, {"contact": pair})
