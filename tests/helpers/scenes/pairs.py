"""Two blocks of any two kinds of body, pressed together, with differences of pressure and concentrations across."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, column, contacts, header
from harness.models.mesh import Layer, Mesh
from harness.models.parts import (
    Condition,
    Control,
    Curve,
    Elastic,
    Material,
    Mixture,
    Param,
    Rigid,
    Solid,
    Solute,
    concentration,
    displace,
    fix,
    hold_rigid,
    initial_concentration,
    pressure,
    push_rigid,
)
from studies.models.pieces import move_rigid
from studies.models.sheared_blocks import Kind

HEIGHT = 1.0
"""mm, of each block; their section is 1 mm x 1 mm."""
CLOSING = 0.01
"""mm by which the upper block is moved down."""
RIGID_PENALTY = 10.0
"""MPa/mm between two rigid blocks."""
PRESSURE = 0.02
"""Effective fluid pressure at the lower end, MPa; 0 at the upper end."""
BELOW, ABOVE = 2.0, 1.0
"""Effective concentrations at the two ends, mM, the same for all solutes so that the ions are neutral there."""
CHARGES = (0, 1, -1)
"""Charge numbers of the solutes of the models: neutral, cation, anion."""
STEP = 2e4
"""s. The slowest time, (2 HEIGHT)^2/d of `SOLUTES`, is 8000 s, so that a few steps reach the steady state."""
STEPS = 8
"""Further ones would change nothing but rounding, and FEBio's relative norms then compare rounding with rounding."""
FORCES = ("contact_force.x", "contact_force.y", "contact_force.z")
SOLVENT_FLOW = "contact solvent flow"

SOLID = Solid(10.0)
PERMEABILITY = 1e-3
"""mm^4/(N s)."""
POROSITY = 0.8
DIFFUSIVITY = 5e-4
"""mm^2/s, of all solutes; the free diffusivities and the solubilities differ."""
SOLUTES = {sol: Solute(sol, DIFFUSIVITY, DIFFUSIVITY * (1.0 + 0.2 * sol), 1.0 - 0.1 * sol) for sol in (1, 2, 3)}
"""Neutral solute, cation and anion, by their numbers."""

ABOUT = """\
Two blocks of 1 mm x 1 mm x 1 mm: {lower} below, {upper} above.

The upper block is moved down by 0.01 mm. Between the two ends there are differences of effective
pressure (0.02 MPa) and of effective concentrations (2 mM and 1 mM), held until fluxes are steady."""
SOLUTES_OF = {Kind.SOLUTE: (1,), Kind.TRIPHASIC: (2, 3), Kind.MULTIPHASIC: (3, 1, 2)}
"""Numbers of the solutes that a body of a kind has, in the order in which its material lists them."""


def mixture(kind: Kind, solutes: tuple[int, ...]) -> Mixture:
    """A porous body with these solutes; triphasic and multiphasic ones carry fixed charges."""
    charge = -2.0 if kind in (Kind.TRIPHASIC, Kind.MULTIPHASIC) else 0.0
    return Mixture(SOLID, PERMEABILITY, POROSITY, tuple(SOLUTES[sol] for sol in solutes), 1.0, charge, kind.value)


def material(kind: Kind) -> Material:
    """A body of this kind."""
    if kind is Kind.RIGID:
        return Rigid()
    return Elastic(SOLID) if kind is Kind.ELASTIC else mixture(kind, SOLUTES_OF.get(kind, ()))


def module(*kinds: Kind) -> str:
    """The smallest of FEBio's modules that has these kinds."""
    if Kind.TRIPHASIC in kinds or Kind.MULTIPHASIC in kinds:
        return "multiphasic"
    if Kind.SOLUTE in kinds:
        return "solute"
    return "biphasic" if Kind.BIPHASIC in kinds else "solid"


@dataclass(frozen=True)
class Pair:
    """Choices of the scene.

    Attributes
    ----------
    lower, upper : Material
    module : str
        One of FEBio's that has both.
    name : str
    settings : ContactSettings
        Beside the ambient values, which are those of the upper end.
    charges : tuple of int
        Charge numbers of solutes 1, 2, ...
    primary : str
        The block whose surface is the primary one.
    force : float, optional
        N, by which an upper rigid block is pushed along z, where it is not moved by the given amount.
    """

    lower: Material
    upper: Material
    module: str
    name: str
    settings: ContactSettings = field(default_factory=ContactSettings)
    charges: tuple[int, ...] = CHARGES
    primary: Literal["lower", "upper"] = "lower"
    force: float | None = None

    def model(self) -> Model:
        """The model of these choices."""
        bodies = {"lower": self.lower, "upper": self.upper}
        layers = [Layer(body, body, HEIGHT, 2) for body in bodies]
        mesh = _prepared(column(InterfaceType.MIXTURE, layers, bottom=-HEIGHT), self.primary)
        sols = sorted({solute.sol for body in bodies.values() for solute in body.solutes})
        outside = tuple(Param("ambient_concentration", ABOVE, attributes={"sol": str(sol)}) for sol in sols)
        settings = replace(self.settings, extra=(*self.settings.extra, *outside))
        flows = tuple(f"contact solute flow {sol}" for sol in sols)
        return Model(
            name=self.name,
            header=header(
                self.name, ABOUT.format(lower=_called(self.lower), upper=_called(self.upper)), InterfaceType.MIXTURE
            ),
            module=self.module,
            mesh=mesh,
            materials=bodies,
            conditions=(*_held("lower", self.lower), *self._moved()),
            control=Control(STEPS, STEP),
            contacts=contacts(InterfaceType.MIXTURE, mesh, settings),
            curves=(Curve(((0.0, 0.0), (STEP, 1.0))),),
            further_columns=("Rz",),
            charges=self.charges[: max(sols, default=0)],
            surface_columns=(*FORCES, SOLVENT_FLOW, *flows),
            part_columns={name: _fluxes(body) for name, body in bodies.items()},
        )

    def _moved(self) -> list[Condition]:
        """What holds and moves the upper block."""
        if self.force is None:
            return _held("upper", self.upper)
        return [hold_rigid("upper", "xyuvw"), push_rigid("upper", "z", self.force, 1)]


def _prepared(mesh: Mesh, primary: str) -> Mesh:
    """The mesh with a node set ``<part>-all`` of each part's nodes, and the named part's surface as primary."""
    own = {f"{part.name}-all": np.unique(part.elements) for part in mesh.parts}
    pairs = {name: pair if primary == "lower" else pair[::-1] for name, pair in mesh.pairs.items()}
    return replace(mesh, node_sets=mesh.node_sets | own, pairs=pairs)


def of_kinds(lower: Kind, upper: Kind, primary: Literal["lower", "upper"] = "lower") -> Pair:
    """The scene of two bodies of these kinds."""
    both_rigid = lower is upper is Kind.RIGID
    settings = ContactSettings(penalty=RIGID_PENALTY) if both_rigid else ContactSettings()
    name = f"{lower.value}-below-{upper.value}-{primary}-primary"
    return Pair(material(lower), material(upper), module(lower, upper), name, settings, primary=primary)


def _called(body: Material) -> str:
    return body.febio_type or "biphasic" if isinstance(body, Mixture) else type(body).__name__.lower()


def _fluxes(body: Material) -> tuple[str, ...]:
    """FEBio's names of the fluxes along z in a body, solvent first, solutes as the material lists them."""
    if not isinstance(body, Mixture):
        return ()
    return ("wz", *(f"j{k + 1}z" for k in range(len(body.solutes))))


def _held(name: str, body: Material) -> list[Condition]:
    """What holds, moves and wets a block at its end."""
    at_bottom = name == "lower"
    moved = 0.0 if at_bottom else -CLOSING
    if isinstance(body, Rigid):
        return [hold_rigid(name, "xyuvw"), move_rigid(name, "z", moved, 1)]
    end = f"{name}-bottom" if at_bottom else f"{name}-top"
    conditions = [fix(f"{name}-all", "xy"), displace(end, "z", moved, 1)]
    if isinstance(body, Mixture):
        conditions.append(pressure(end, PRESSURE if at_bottom else 0.0))
        for solute in body.solutes:
            conditions.append(concentration(end, BELOW if at_bottom else ABOVE, sol=solute.sol))
            conditions.append(initial_concentration(f"{name}-all", ABOVE, solute.sol))
    return conditions
