"""Two confined blocks, pressed together along a load curve: the scene of most hard cases, with its closed form.

Laterally confined, with 1 mM below and nothing above, both without fluid pressure, the steady state is
known: equal stress and equal fluxes in both blocks, uniform strain and a linear concentration in each.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from scipy.optimize import brentq

from harness.arrays import Array
from harness.models import parts
from harness.models.document import Model
from harness.models.mesh import Box, Layer, Mesh, Section, assemble, conforming_column
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from studies.hard_cases.scene import GEL, NEWTON, Fineness, Interface, finished, timed

RAMP = tuple(100.0 * k for k in range(1, 11))  # times (s) of the steps in which the blocks are moved
HOLD = tuple(1000.0 + 4000.0 * k for k in range(1, 7))
"""Times (s) of the steps after it: each takes off 5/6 of what is left. Many more would ask
Newton for less than rounding."""


def stress(solid: parts.Solid, stretch: float) -> float:
    """Axial Cauchy stress (MPa) of FEBio's neo-Hookean solid, confined: mu (s^2 - 1)/s + lambda ln(s)/s."""
    shear = solid.modulus / (2.0 * (1.0 + solid.poisson))
    lame = solid.modulus * solid.poisson / ((1.0 + solid.poisson) * (1.0 - 2.0 * solid.poisson))
    return float(shear * (stretch**2 - 1.0) / stretch + lame * np.log(stretch) / stretch)


def stretches(below: parts.Solid, above: parts.Solid, shortening: float) -> tuple[float, float]:
    """Stretches of two blocks of 1 mm in series that are shortened by `shortening` (mm) together."""

    def other(stretch: float) -> float:
        return 2.0 - shortening - stretch

    # Each block is shortened by something between nothing and everything.
    low, high = 1.0 - shortening, 1.0
    found = brentq(lambda s: stress(below, s) - stress(above, other(s)), low, high, xtol=1e-15, rtol=1e-14)
    return float(found), float(other(found))


def ambient_at(where: str, values: tuple[float, ...], fluid: float = 0.0) -> list[parts.Condition]:
    """Ambient fluid pressure (MPa) and concentrations (mM) on a node set, so p~ = p - R T Phi c."""
    held = [parts.pressure(where, parts.effective_pressure(sum(values), fluid))]
    return held + [parts.concentration(where, value, sol=number) for number, value in enumerate(values, 1)]


@dataclass(frozen=True)
class Press:
    """Two blocks of 1 mm, the upper one moved down."""

    lower: parts.Mixture = GEL
    upper: parts.Mixture = GEL
    gap: float = 0.0
    """Distance at the start, in elements of the upper block if `in_elements`, else in mm; negative for an overlap."""
    in_elements: bool = False
    shortening: float = 0.05  # of both blocks at the end, mm: the upper one's top moves by this and the gap
    path: tuple[tuple[float, float], ...] = ((0.0, 0.0), (1000.0, 1.0))
    """Way of the top over time (s): 1 where the blocks are shortened by `shortening`, 0 at the start."""
    times: tuple[float, ...] = (*RAMP, *HOLD)  # ends of the time steps, s
    width: tuple[float, float] = (1.0, 1.0)  # cross-section, mm
    across: tuple[int, int] | None = None  # elements along x and y on both meshes; by default 2 x 2, and 4 x 4 on 3 x 3
    warp: float = 0.0  # height (mm) by which the surfaces in contact are warped
    # Concentration of each solute below and above, mM.
    below: tuple[float, ...] = (1.0,)
    above: tuple[float, ...] = (0.0,)
    initial: tuple[float, ...] = ()  # concentration of each solute at the start, mM; without it none
    newton: float = NEWTON  # Newton's relative tolerances
    penalties: float = 1.0  # factor on all penalties
    augmented: float | None = None  # relative tolerance of augmentations (AUGLAG); without it there are none
    extra: tuple[parts.Param, ...] = field(default=())
    inlet: float = 0.0  # fluid pressure below, MPa; none above
    stepper: parts.TimeStepper | None = None
    """Chooses the time steps instead of `times`, whose first and last entries then are the first step and the end."""
    tolerance: float = 2e-3  # largest error allowed of force and concentration, relative to their largest values
    name: str = "press"

    def model(self, mesh: Fineness, interface: Interface) -> Model:
        """The model; its conditions hold the ambient values at both ends."""
        made = self._mesh(mesh)
        top = -(self.shortening + self._gap(mesh))
        control, steps = timed(self.times, 2, self.newton)
        control = replace(control, stepper=self.stepper or control.stepper)
        conditions = (
            parts.fix("all", "xy"),
            parts.fix("lower-bottom", "z"),
            parts.displace("upper-top", "z", top, 1),
            *ambient_at("lower-bottom", self.below, self.inlet),
            *ambient_at("upper-top", self.above),
            *(parts.initial_concentration("all", value, sol=number) for number, value in enumerate(self.initial, 1)),
        )
        joined = interface.contacts(made, self.extra, self.penalties, self.augmented)
        text = f"Hard case {self.name}: two confined blocks, the upper one moved down."
        about, materials = (self.name, text, "multiphasic"), {"lower": self.lower, "upper": self.upper}
        curves = (parts.Curve(self.path), steps)
        return finished(Model(*about, made, materials, conditions, control, joined, curves), interface)

    def _gap(self, mesh: Fineness) -> float:
        return self.gap / self._elements(mesh)[1][2] if self.in_elements else self.gap

    def _elements(self, mesh: Fineness) -> tuple[tuple[int, int, int], tuple[int, int, int]]:
        """Elements of the two blocks along x, y, z; on the fine mesh the facets do not match."""
        if mesh is Fineness.COARSE:
            x, y = self.across or (2, 2)
            return (x, y, 3), (x, y, 3)
        x, y = self.across or (4, 4)
        return (x, y, 6), ((x, y, 5) if self.across or self.warp else (3, 3, 5))

    def _mesh(self, mesh: Fineness) -> Mesh:
        below, above = self._elements(mesh)
        made = assemble(
            [
                Box("lower", "lower", (0.0, 0.0, -1.0), (*self.width, 1.0), below),
                Box("upper", "upper", (0.0, 0.0, self._gap(mesh)), (*self.width, 1.0), above),
            ]
        )
        if self.warp:
            made = replace(made, nodes=warped(made.nodes, self.warp))
        return replace(made, pairs={"lower/upper": ("lower-top", "upper-bottom")})

    def fineness(self, run: RunResult) -> Fineness:
        """The mesh of a run."""
        return next(m for m in Fineness if len(self._mesh(m).nodes) == len(run.model.mesh.nodes))

    def reference(self, mesh: Fineness) -> Model:
        """The same two blocks as one body; their facets must match and their surfaces must be flat."""
        (x, y, below), (_, _, above) = self._elements(mesh)
        layers = [Layer("lower", "lower", 1.0, below), Layer("upper", "upper", 1.0, above)]
        conforming = conforming_column(layers, bottom=-1.0, section=Section(self.width, (x, y)))
        split = self.model(mesh, Interface.MIXTURE)
        bare = replace(split, contacts=(), surface_columns=(), facet_columns=())
        return replace(bare, mesh=conforming, name=f"{self.name}-conforming")

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """Force and concentration at the end against the closed form of the steady state."""
        below, above = stretches(self.lower.solid, self.upper.solid, self.shortening)
        area = self.width[0] * self.width[1]
        force = -stress(self.lower.solid, below) * area
        nodes, top = run.nodes, run.model.mesh.node_sets["upper-top"] - 1
        found = float(nodes["Rz"][-1, top].sum())
        measures = [Measure("force at the end, relative error", abs(found / force - 1.0), self.tolerance)]
        for number in range(1, run.model.n_solutes + 1):
            exact = self._concentration(run.model, number, (below, above))
            scale = max(self.below[number - 1], self.above[number - 1])
            error = float(np.max(np.abs(nodes[f"c{number}"][-1] - exact))) / (scale or 1.0)
            measures.append(Measure(f"c{number} at the end, relative error", error, self.tolerance))
        return measures

    def _concentration(self, model: Model, number: int, stretched: tuple[float, float]) -> Array:
        """Steady effective concentration (mM) at the nodes, without convection: equal fluxes, linear in each block."""
        resistance = []
        for material, stretch in zip((self.lower, self.upper), stretched, strict=True):
            solute = next(s for s in material.solutes if s.sol == number)
            porosity = 1.0 - (1.0 - material.porosity) / stretch
            resistance.append(stretch / (solute.solubility * porosity * solute.diffusivity))
        first, last = self.below[number - 1], self.above[number - 1]
        middle = first + (last - first) * resistance[0] / sum(resistance)
        exact = np.empty(len(model.mesh.nodes))
        # Bottoms of the two blocks, which are 1 mm high but for a warp.
        base = (-1.0, float(model.mesh.nodes[:, 2].max()) - 1.0)
        ends = ((first, middle), (middle, last))
        for part, (low, high), start in zip(model.mesh.parts, ends, base, strict=True):
            ids = np.unique(part.elements) - 1
            z = model.mesh.nodes[ids, 2]
            exact[ids] = low + (high - low) * (z - start)
        return exact


def warped(nodes: Array, height: float) -> Array:
    """Nodes of both blocks moved so that the surfaces in contact are saddles of twisted facets; the ends stay flat."""
    x, y, z = nodes.T
    lift = height * np.sin(np.pi * (x - 0.3)) * np.cos(np.pi * (y + 0.2))
    fade = np.clip(1.0 - np.abs(z), 0.0, 1.0)
    return np.column_stack([x, y, z + lift * fade])
