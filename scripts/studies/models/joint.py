"""Gallery: a section of a joint under cyclic load, with solute from the synovial fluid or from one of its layers."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from harness.models import parts
from harness.models.blocks import Points
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh
from studies.models.assembly import NEAR, Chosen, Inside, assembled, everywhere, graded, plane, raised, tensor
from studies.models.pieces import UNCLAMPED, ambient

RADIUS = 15.0  # radius of curvature of the upper cartilage, mm
THICKNESS = 1.0  # of each layer, mm
HALF_WIDTHS = {"upper": 4.0, "lower": 4.5}  # mm; by symmetry half of the section is modelled
DEPTH = 0.25  # mm, thickness of the plane problem
LEAST, MOST = 0.05, 0.15  # mm by which the upper bone approaches over a cycle
GROWTH = 1.25  # of the elements of a layer, from the surface of the joint to the bone
PERIOD, STEPS = 20.0, 20  # of a cycle: s, and number of time steps
AMBIENT = 1.0  # concentration of the synovial fluid, mM, reached at the end of the first cycle
CARTILAGE = parts.Mixture(
    parts.Solid(1.0, 0.1), permeability=1e-3, solutes=(parts.Solute(1, diffusivity=5e-4, free_diffusivity=8e-4),)
)
LOADING, FILLING = 1, 2  # numbers of the load curves

EFFECTIVE_PRESSURE = parts.effective_pressure(AMBIENT)
"""MPa, where the concentration is `AMBIENT` and the fluid pressure 0."""

SECTION = """\
Two layers of 1 mm cover rigid bone. The upper layer is convex with a radius of 15 mm. The upper bone approaches by
0.05 to 0.15 mm and back, with a period of 20 s.
"""
SYMMETRY = """\
By symmetry, the model contains one half of the section, as a layer of one element with no displacement along z."""
UPTAKE = f"""\
Cartilage on cartilage: a section of a joint takes up solute from the synovial fluid under cyclic loading.

{SECTION}The layers contain no solute at the start. The synovial fluid wets all surfaces that are not in contact. Its
concentration rises to 1 mM within the first cycle. Its effective pressure falls to -R T c = -0.0024776 MPa at the same
time, and its fluid pressure is therefore 0. The edge of the contact moves with each cycle. Nodes at ambient values
come into contact, and solute crosses from layer to layer.
{SYMMETRY}"""
RELEASE = f"""\
Cartilage on cartilage: solute crosses from layer to layer in a section of a joint under cyclic loading.

{SECTION}The upper layer contains 1 mM of a solute at the start. Its effective pressure is -R T c = -0.0024776 MPa, and
its fluid pressure is therefore 0. The lower layer and the synovial fluid contain no solute. The solute leaves through
open surfaces into the fluid, and crosses the contact into the lower layer.
{SYMMETRY}"""


class Source(Enum):
    """Where the solute is at first."""

    FLUID = UPTAKE
    UPPER = RELEASE


@dataclass(frozen=True)
class Joint:
    cycles: int = 10
    # Elements along the half-width and through the thickness of each layer.
    across: int = 24
    through: int = 8
    source: Source = Source.FLUID
    name: str = "joint"
    plot: bool = False

    def model(self) -> Model:
        mesh, wet = self._mesh(), self.source is Source.FLUID
        filled = (parts.initial_pressure("upper", EFFECTIVE_PRESSURE), parts.initial_concentration("upper", AMBIENT))
        conditions = (
            parts.fix("all", "z"),
            parts.fix("lower-bone", "xy"),
            parts.fix("upper-bone", "x"),
            parts.fix("symmetry", "x"),
            parts.displace("upper-bone", "y", -MOST, LOADING),
            *(() if wet else filled),
        )
        outside = ambient(EFFECTIVE_PRESSURE, AMBIENT, FILLING) if wet else ambient(0.0, 0.0)
        return Model(
            self.name,
            header(self.name, self.source.value, InterfaceType.MIXTURE),
            "multiphasic",
            mesh,
            {"lower": CARTILAGE, "upper": CARTILAGE},
            conditions,
            parts.Control(self.cycles * STEPS, PERIOD / STEPS, reformations=25, solver=UNCLAMPED),
            contacts(InterfaceType.MIXTURE, mesh, ContactSettings(extra=outside)),
            (self._loading(), *([parts.Curve(((0.0, 0.0), (PERIOD, 1.0)))] if wet else [])),
            plot=self.plot,
            further_columns=("Rx", "Ry", "Rz"),
        )

    def _mesh(self) -> Mesh:
        x = {layer: np.linspace(0.0, width, self.across + 1) for layer, width in HALF_WIDTHS.items()}
        symmetry = {"symmetry": plane("x", 0.0)}
        upper = {} if self.source is Source.FLUID else {"upper": everywhere("upper")}
        return touching(x, self.through, GROWTH, {"all": everywhere(), **symmetry, **BONES, **upper})

    def _loading(self) -> parts.Curve:
        """Approach of the bone, relative to `MOST`: from 0 to the least in half a cycle, then up and down."""
        time = PERIOD / STEPS * np.arange(STEPS // 2, self.cycles * STEPS + 1)
        approach = LEAST + (MOST - LEAST) * 0.5 * (1.0 + np.cos(2.0 * np.pi * time / PERIOD))
        return parts.Curve(((0.0, 0.0), *zip(time.tolist(), (approach / MOST).tolist(), strict=True)))


def rise(points: Points) -> NDArray[np.float64]:
    """Height of the upper cartilage's surface over that of the lower one at first touch, mm."""
    return np.asarray(points[..., 0] ** 2 / (2.0 * RADIUS))


def above(height: float) -> Inside:
    """Positions at a height (mm) over the surface of the upper cartilage."""
    return lambda x: np.asarray(np.abs(x[..., 1] - rise(x) - height) < NEAR)


BONES = {"lower-bone": plane("y", -THICKNESS, "lower"), "upper-bone": Chosen("upper", above(THICKNESS))}
"""Node sets of every section of a joint."""


def touching(
    x: Mapping[str, NDArray[np.float64]], through: int, growth: float, node_sets: Mapping[str, Chosen]
) -> Mesh:
    """Both layers with nodes at positions `x` (mm); they touch at x = 0, and their elements grow away from there."""
    height = graded(THICKNESS, through, growth)
    lower, upper = (
        tensor([x[name], up * height, np.array([0.0, DEPTH])]) for name, up in (("lower", -1), ("upper", 1))
    )
    surfaces = {"lower-cartilage": plane("y", 0.0, "lower"), "upper-cartilage": Chosen("upper", above(0.0))}
    bodies = {"lower": lower, "upper": raised(upper, "y", rise)}
    return assembled(bodies, node_sets, surfaces, {"joint": ("upper-cartilage", "lower-cartilage")})
