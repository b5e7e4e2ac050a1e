"""Two thin biphasic layers on bone, one flat and one of large radius, pressed together by a force."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from math import pi
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from harness.arrays import Ids
from harness.models import blocks
from harness.models.blocks import Points
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh, Part
from harness.models.parts import Control, Curve, Mixture, Param, Rigid, Solid, TimeStepper, fix, hold_rigid, push_rigid
from studies.closed_forms import biphasic_layers
from studies.closed_forms.biphasic_layers import Shape
from studies.models.assembly import NEAR, Chosen, assembled, everywhere, graded, plane, raised

THICKNESS = 1.0  # of each layer, mm
CARTILAGE = Mixture(Solid(1.0), permeability=1e-3)
RADIUS = 4e6  # mm; so large that strains are small, since the closed form is linear
HALF_WIDTH = 80.0  # of the contact when the load has come, by the closed form, mm
LENGTH = 108.0  # of the modelled half, mm
DEPTH = 1.0  # mm, thickness of the plane problem
RAMP, END = 0.02, 1.0  # times in which the load rises and at which the run ends, in 1/chi
OVERLAP = 0.05  # at the start, in parts of the approach when the load has come: a body under a force must be in contact
HOLE = 0.5  # radius that a sphere's layers begin at, mm: elements at the axis itself would have no inner side
PRESSING, HOLDING = 4, 12  # time steps of rising and of constant load; those grow from one to the next
GROWTH = 1.3  # of time steps under constant load
LOAD_CURVE, STEP_CURVE = 1, 2

ABOUT = """\
Biphasic Hertz contact {where}: two equal layers of 1 mm on bone, one flat, one of a radius of 4e6 mm.

A force presses the upper bone down and stays. The solvent is trapped in the contact and flows outwards along the layers
alone, so the contact grows and the pressure falls: Ateshian, Lai, Zhu, Mow (1994), J Biomech 27(11):1347-1360{source}.
The closed form takes the layers for thin: the contact's {size} is 80 times their thickness and more. By symmetry
{modelled}"""


@dataclass(frozen=True)
class BiphasicHertz(ABC):
    """What lines and spheres share."""

    draining: bool = False
    """Whether solvent leaves through the surfaces that are not in contact; the closed form has them impermeable."""
    # Elements along the modelled half-width or radius and through each layer.
    across: int = 72
    through: int = 3
    name: str = "biphasic-hertz"

    shape: ClassVar[Shape]
    about: ClassVar[str]
    modelled: ClassVar[float]  # part of the force that acts on what is modelled; of a line, of the force per length, mm
    held: ClassVar[tuple[tuple[str, str], ...]]
    """By symmetry: sets of the cartilage's nodes, and the axes along which they stay."""

    @abstractmethod
    def extent(self, area: NDArray[np.float64]) -> NDArray[np.float64]:
        """Half-width or radius (mm) of a contact whose modelled part has an area (mm^2)."""

    @abstractmethod
    def distance(self, x: Points) -> NDArray[np.float64]:
        """Distances of positions from the middle, mm."""

    @abstractmethod
    def _points(self, heights: NDArray[np.float64]) -> Points:
        """Positions by number along the layer, height (mm), and number across."""

    @abstractmethod
    def _planes(self) -> dict[str, Chosen]:
        """The node sets that `held` names."""

    @property
    def settings(self) -> ContactSettings:
        """Multipliers: thin layers are so stiff that the overlap of a penalty would count beside their deformation."""
        return ContactSettings(laugon="LAGMULT", extra=(Param("free_draining", self.draining),))

    @property
    def contact(self) -> biphasic_layers.Contact:
        """What the closed form is asked for."""
        layer = biphasic_layers.Layer(THICKNESS, CARTILAGE.solid.modulus / 2.0, CARTILAGE.permeability)
        return biphasic_layers.Contact((layer, layer), RADIUS, self.shape)

    @property
    def overlap(self) -> float:
        """At the start, mm."""
        return OVERLAP * float(self.contact.approach(HALF_WIDTH))

    @property
    def load(self) -> Curve:
        """Force (N; of a line per length, N/mm) over time (s)."""
        ramp, end = RAMP / self.contact.rate, END / self.contact.rate
        # Accumulated over a linear ramp the load is F (1 + chi ramp/2).
        force = self.contact.load(HALF_WIDTH) / (1.0 + RAMP / 2.0)
        return Curve(((0.0, 0.0), (ramp, force), (end, force)))

    def model(self) -> Model:
        mesh = self._mesh()
        conditions = (
            *(fix(nodes, axes) for nodes, axes in self.held),
            fix("lower-bone", "xyz"),
            hold_rigid("bone", "xzuvw"),
            push_rigid("bone", "y", -self.modelled, LOAD_CURVE),
        )
        times = self._times()
        steps = Curve(tuple(zip(times.tolist(), np.diff(times, prepend=0.0).tolist(), strict=True)), "STEP")
        return Model(
            self.name,
            header(self.name, self.about, InterfaceType.MIXTURE),
            "biphasic",
            mesh,
            {"lower": CARTILAGE, "upper": CARTILAGE, "bone": Rigid()},
            conditions,
            self._control(times),
            contacts(InterfaceType.MIXTURE, mesh, self.settings),
            (self.load, steps),
            surface_columns=("contact_force.y", "contact area"),
            facet_columns=("contact pressure",),
        )

    def _control(self, times: NDArray[np.float64]) -> Control:
        return Control(
            len(times),
            float(times[0]),
            displacement_tolerance=1e-4,
            energy_tolerance=1e-6,
            pressure_tolerance=1e-4,
            reformations=40,
            stepper=TimeStepper(0.0, must_points=STEP_CURVE, force=True),
            end=float(times[-1]),
        )

    def _times(self) -> NDArray[np.float64]:
        (_, _), (ramp, _), (end, _) = self.load.points
        pressing = np.linspace(0.0, ramp, PRESSING + 1)[1:]
        return np.concatenate([pressing, (ramp + graded(end - ramp, HOLDING, GROWTH))[1:]])

    def _mesh(self) -> Mesh:
        sets = self._planes() | {"all": everywhere(), "lower-bone": plane("y", -THICKNESS, "lower")}
        surfaces = {
            "lower-cartilage": plane("y", 0.0, "lower"),
            "upper-cartilage": Chosen("upper", lambda x: np.asarray(np.abs(x[..., 1] - self._rise(x)) < NEAR)),
        }
        heights = np.linspace(0.0, THICKNESS, self.through + 1)
        # The upper body is cartilage and one layer of bone, and overlaps the lower layer at first.
        upper = blocks.structured(self._points(np.append(heights, 1.5 * THICKNESS)))
        bodies = {
            "lower": blocks.structured(self._points(np.linspace(0.0, -THICKNESS, self.through + 1))),
            "upper": raised(upper, "y", self._rise),
        }
        return self._with_bone(assembled(bodies, sets, surfaces, {"joint": ("lower-cartilage", "upper-cartilage")}))

    def _with_bone(self, mesh: Mesh) -> Mesh:
        """The outermost elements of the upper body are bone; what is held by symmetry is cartilage alone."""
        lower, upper = mesh.parts
        columns = upper.elements.reshape(self.across, self.through + 1, -1, 8)
        bone = columns[:, -1].reshape(-1, 8)
        free = np.setdiff1d(mesh.node_sets["all"], bone)
        held = {name for name, _ in self.held}
        sets: dict[str, Ids] = {
            name: np.intersect1d(ids, free) if name in held else ids for name, ids in mesh.node_sets.items()
        }
        parts = (lower, Part("upper", "upper", columns[:, :-1].reshape(-1, 8)), Part("bone", "bone", bone))
        return replace(mesh, parts=parts, node_sets=sets)

    def _rise(self, x: Points) -> NDArray[np.float64]:
        """Height (mm) of the upper cartilage's surface."""
        return np.asarray(self.distance(x) ** 2 / (2.0 * RADIUS) - self.overlap)


@dataclass(frozen=True)
class BiphasicLine(BiphasicHertz):
    """Contact along a line: half of it, as a layer of one element."""

    shape = Shape.LINE
    about = ABOUT.format(
        where="along a line",
        source=", here for a line",
        size="half-width",
        modelled="half is modelled, as a layer of one element with no displacement along z.",
    )
    modelled = 0.5 * DEPTH
    held = (("cartilage", "z"), ("symmetry", "x"))

    def extent(self, area: NDArray[np.float64]) -> NDArray[np.float64]:
        return area / DEPTH

    def distance(self, x: Points) -> NDArray[np.float64]:
        return x[..., 0]

    def _points(self, heights: NDArray[np.float64]) -> Points:
        x = np.linspace(0.0, LENGTH, self.across + 1)
        return np.stack(np.meshgrid(x, heights, [0.0, DEPTH], indexing="ij"), axis=-1)

    def _planes(self) -> dict[str, Chosen]:
        return {"symmetry": plane("x", 0.0), "cartilage": everywhere()}


@dataclass(frozen=True)
class BiphasicSphere(BiphasicHertz):
    """Contact over a circle: a quarter of it."""

    around: int = 4  # elements around the quarter
    name: str = "biphasic-hertz-sphere"

    shape = Shape.SPHERE
    about = ABOUT.format(where="over a circle", source="", size="radius", modelled="a quarter is modelled.")
    modelled = 0.25
    held = (("axis", "xz"), ("symmetry-x", "x"), ("symmetry-z", "z"))

    def extent(self, area: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.sqrt(area / (0.25 * pi) + HOLE**2)

    def distance(self, x: Points) -> NDArray[np.float64]:
        return np.hypot(x[..., 0], x[..., 2])

    def _points(self, heights: NDArray[np.float64]) -> Points:
        radius, angle = np.linspace(HOLE, LENGTH, self.across + 1), np.linspace(0.0, 0.5 * pi, self.around + 1)
        r, y, t = np.meshgrid(radius, heights, angle, indexing="ij")
        return np.stack([r * np.cos(t), y, r * np.sin(t)], axis=-1)

    def _planes(self) -> dict[str, Chosen]:
        inner = Chosen("", lambda x: np.asarray(self.distance(x) < HOLE + NEAR))
        return {"axis": inner, "symmetry-x": plane("x", 0.0), "symmetry-z": plane("z", 0.0)}
