"""Gallery: a layer of cartilage that shear delaminates from the bone, with fluid in the crack."""

from dataclasses import dataclass

from harness.models import parts
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh
from studies.models.assembly import assembled, box, everywhere, plane
from studies.models.pieces import UNCLAMPED, ambient

LENGTH, HEIGHT = 8.0, 1.0  # of the layer and of the bone below it, mm
SHEAR, LIFT = 0.35, 0.1  # mm by which the left end of the layer is drawn along the bone and off it
DURATION = 60.0  # s
BATH = 1.0  # concentration of the fluid around both bodies, mM
CARTILAGE = parts.Mixture(
    parts.Solid(5.0, 0.2), permeability=1e-3, solutes=(parts.Solute(1, 1e-2, free_diffusivity=1e-2),)
)
BONE = parts.Mixture(
    parts.Solid(100.0, 0.2), permeability=1e-4, porosity=0.3, solutes=(parts.Solute(1, 2e-3, free_diffusivity=1e-2),)
)
AMBIENT_PRESSURE = parts.effective_pressure(BATH)
"""Effective pressure at this concentration without fluid pressure, MPa."""
START = 0.2  # concentration in both bodies at first, mM
TIE = ContactSettings(
    auto_penalty=True,
    penalty=10.0,
    extra=(
        parts.Param("max_traction", 0.2),
        parts.Param("fracture_energy", 0.01),
        parts.Param("fric_coeff", 0.02),
        *ambient(AMBIENT_PRESSURE, BATH),
    ),
)
CONTROL = parts.Control(
    60,
    DURATION / 60,
    displacement_tolerance=1e-6,
    reformations=150,
    solver=(*UNCLAMPED, parts.Param("lstol", 0.0)),
)

ABOUT = """\
A layer of cartilage that is drawn along the bone until it delaminates, with fluid and a solute in the crack.

The layer and the bone are 8 mm long and 1 mm high, in plane strain. A cohesive tie with a strength of 0.2 MPa and
a fracture energy of 0.01 N/mm joins them. In 60 s, the left end of the layer moves by 0.35 mm along the bone and
by 0.1 mm off it, and a crack grows from there. Broken nodes are in sliding contact with a friction coefficient of
0.02. The crack contains fluid with 1 mM of a solute and without pressure, so that the effective fluid pressure in
the open crack is -R T c = -0.0024776 MPa. The same fluid surrounds the top and the left end of the layer. Both
bodies have 0.2 mM at the start, and the solute enters through the faces of the crack. All other faces are
impermeable."""


@dataclass(frozen=True)
class Delamination:
    interface: InterfaceType = InterfaceType.TIED
    settings: ContactSettings = TIE
    # Elements of the layer and of the bone along their length and over their height.
    along: tuple[int, int] = (48, 24)
    up: tuple[int, int] = (4, 2)
    control: parts.Control = CONTROL
    name: str = "delamination"
    plot: bool = False

    def model(self) -> Model:
        mesh = self._mesh()
        baths = ("layer-top", "layer-left")
        conditions = (
            parts.fix("all", "y"),
            parts.fix("bone-bottom", "xz"),
            parts.displace("layer-left", "x", -SHEAR, 1),
            parts.displace("layer-left", "z", LIFT, 1),
            *(parts.pressure(where, AMBIENT_PRESSURE) for where in baths),
            *(parts.concentration(where, BATH) for where in baths),
            parts.initial_concentration("all", START),
            parts.initial_pressure("all", AMBIENT_PRESSURE * START / BATH),
        )
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "multiphasic",
            mesh,
            {"layer": CARTILAGE, "bone": BONE},
            conditions,
            self.control,
            contacts(self.interface, mesh, self.settings),
            (parts.Curve(((0.0, 0.0), (DURATION, 1.0))),),
            plot=self.plot,
            further_columns=("Rx",),
        )

    def _mesh(self) -> Mesh:
        width = LENGTH / self.along[0]
        bodies = {
            "layer": box((0.0, 0.0, 0.0), (LENGTH, width, HEIGHT), (self.along[0], 1, self.up[0])),
            "bone": box((0.0, 0.0, -HEIGHT), (LENGTH, width, 0.0), (self.along[1], 1, self.up[1])),
        }
        node_sets = {
            "all": everywhere(),
            "bone-bottom": plane("z", -HEIGHT, "bone"),
            "layer-top": plane("z", HEIGHT, "layer"),
            "layer-left": plane("x", 0.0, "layer"),
        }
        surfaces = {"layer-bottom": plane("z", 0.0, "layer"), "bone-top": plane("z", 0.0, "bone")}
        return assembled(bodies, node_sets, surfaces, {"crack": ("layer-bottom", "bone-top")})
