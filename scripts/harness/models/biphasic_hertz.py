"""Two thin biphasic layers on bone, one flat and one of large radius, pressed together by a force: a line contact."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from harness.closed_forms import biphasic_layers
from harness.models import blocks
from harness.models.assembly import NEAR, Chosen, assembled, everywhere, graded, plane
from harness.models.blocks import Body
from harness.models.document import Model
from harness.models.header import header
from harness.models.interface import ContactSettings, InterfaceType, contacts
from harness.models.mesh import Ids, Mesh, Part
from harness.models.parts import Control, Curve, Mixture, Param, Rigid, Solid, TimeStepper, fix, hold_rigid, push_rigid

THICKNESS = 1.0
"""Of each layer, mm."""
CARTILAGE = Mixture(Solid(1.0), permeability=1e-3)
RADIUS = 4e6
"""mm; so large that strains are small, since the closed form is linear."""
HALF_WIDTH = 80.0
"""Of the contact when the load has come, by the closed form, mm."""
LENGTH = 108.0
"""Of the modelled half, mm."""
DEPTH = 1.0
"""mm, thickness of the plane problem."""
RAMP, END = 0.02, 1.0
"""Times in which the load rises and at which the run ends, in 1/chi."""
OVERLAP = 0.05
"""At the start, in parts of the approach when the load has come: a body under a force must be in contact."""
PRESSING, HOLDING = 4, 12
"""Time steps of rising and of constant load; those grow from one to the next."""
GROWTH = 1.3
"""Of time steps under constant load."""
LOAD_CURVE, STEP_CURVE = 1, 2

ABOUT = """\
Biphasic Hertz contact along a line: two equal layers of 1 mm on bone, one flat, one of a radius of 4e6 mm.

A force presses the upper bone down and stays. The solvent is trapped in the contact and flows outwards along the layers
alone, so the contact grows and the pressure falls: Ateshian, Lai, Zhu, Mow (1994), J Biomech 27(11):1347-1360, here
for a line. The closed form takes the layers for thin: the half-width is 80 times their thickness and more. By symmetry
half is modelled, as a layer of one element with no displacement along z."""


@dataclass(frozen=True)
class BiphasicHertz:
    """Choices of this problem.

    Attributes
    ----------
    interface : InterfaceType
    draining : bool
        Whether solvent leaves through the surfaces that are not in contact; the closed form has them impermeable.
    across, through : int
        Elements along the modelled half and through each layer.
    """

    interface: InterfaceType = InterfaceType.MIXTURE
    draining: bool = False
    across: int = 72
    through: int = 3
    name: str = "biphasic-hertz"

    @property
    def settings(self) -> ContactSettings:
        """Multipliers: thin layers are so stiff that the overlap of a penalty would count beside their deformation."""
        return ContactSettings(laugon="LAGMULT", extra=(Param("free_draining", self.draining),))

    @property
    def contact(self) -> biphasic_layers.Contact:
        """What the closed form is asked for."""
        layer = biphasic_layers.Layer(THICKNESS, CARTILAGE.solid.modulus / 2.0, CARTILAGE.permeability)
        return biphasic_layers.Contact((layer, layer), RADIUS)

    @property
    def load(self) -> Curve:
        """Force per length (N/mm) over time (s)."""
        ramp, end = RAMP / self.contact.rate, END / self.contact.rate
        # Accumulated over a linear ramp the load is F (1 + chi ramp/2).
        force = self.contact.load(HALF_WIDTH) / (1.0 + RAMP / 2.0)
        return Curve(((0.0, 0.0), (ramp, force), (end, force)))

    def model(self) -> Model:
        """The model of these choices."""
        mesh = self._mesh()
        conditions = (
            fix("cartilage", "z"),
            fix("lower-bone", "xy"),
            fix("symmetry", "x"),
            hold_rigid("bone", "xzuvw"),
            push_rigid("bone", "y", -0.5 * DEPTH, LOAD_CURVE),
        )
        times = self._times()
        steps = Curve(tuple(zip(times.tolist(), np.diff(times, prepend=0.0).tolist(), strict=True)), "STEP")
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "biphasic",
            mesh,
            {"lower": CARTILAGE, "upper": CARTILAGE, "bone": Rigid()},
            conditions,
            self._control(times),
            contacts(self.interface, mesh, self.settings),
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
        """Ends of the time steps, s."""
        (_, _), (ramp, _), (end, _) = self.load.points
        pressing = np.linspace(0.0, ramp, PRESSING + 1)[1:]
        return np.concatenate([pressing, (ramp + graded(end - ramp, HOLDING, GROWTH))[1:]])

    def _mesh(self) -> Mesh:
        node_sets = {
            "symmetry": plane("x", 0.0),
            "cartilage": Chosen("", lambda x: np.asarray(x[..., 1] < THICKNESS + _rise(x[..., 0]) + NEAR)),
            "lower-bone": plane("y", -THICKNESS, "lower"),
        }
        surfaces = {"lower-cartilage": plane("y", 0.0, "lower"), "upper-cartilage": Chosen("upper", _on_surface)}
        bodies = {"lower": self._lower(), "upper": self._upper()}
        mesh = assembled(
            bodies, node_sets | {"all": everywhere()}, surfaces, {"joint": ("lower-cartilage", "upper-cartilage")}
        )
        return self._with_bone(mesh)

    def _with_bone(self, mesh: Mesh) -> Mesh:
        """The outermost elements of the upper body are bone; what is held along z, or at x = 0, is cartilage alone."""
        lower, upper = mesh.parts
        columns = upper.elements.reshape(self.across, self.through + 1, 8)
        bone = columns[:, -1]
        free = np.setdiff1d(mesh.node_sets["all"], bone)
        sets: dict[str, Ids] = {
            name: np.intersect1d(ids, free) if name in ("symmetry", "cartilage") else ids
            for name, ids in mesh.node_sets.items()
        }
        parts = (lower, Part("upper", "upper", columns[:, :-1].reshape(-1, 8)), Part("bone", "bone", bone))
        return replace(mesh, parts=parts, node_sets=sets)

    def _lower(self) -> Body:
        return blocks.structured(self._points(np.linspace(0.0, -THICKNESS, self.through + 1)))

    def _upper(self) -> Body:
        """Cartilage and one layer of bone, overlapping the lower layer at first."""
        heights = np.append(np.linspace(0.0, THICKNESS, self.through + 1), 1.5 * THICKNESS)
        points = self._points(heights)
        points[..., 1] += _rise(points[..., 0])
        return blocks.structured(points)

    def _points(self, heights: NDArray[np.float64]) -> NDArray[np.float64]:
        x = np.linspace(0.0, LENGTH, self.across + 1)
        return np.stack(np.meshgrid(x, heights, [0.0, DEPTH], indexing="ij"), axis=-1)


def _rise(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Height (mm) of the upper cartilage's surface at a distance from the middle."""
    return np.asarray((x**2 - OVERLAP * HALF_WIDTH**2 / 3.0) / (2.0 * RADIUS))


def _on_surface(x: NDArray[np.float64]) -> NDArray[np.bool_]:
    return np.asarray(np.abs(x[..., 1] - _rise(x[..., 0])) < NEAR)
