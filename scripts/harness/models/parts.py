"""The pieces of a model: materials, conditions, contact, springs, control. Each appends its XML to a section."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar, TypeAlias

from lxml import etree

from harness.arrays import Ids

Element = etree._Element
Value: TypeAlias = float | int | str | bool | tuple[float, ...]

GAS_CONSTANT = 8.314e-6  # mJ/(nmol K), with mm, N, s, nmol
TEMPERATURE = 298.0  # K
FARADAY = 9.64853321e-5  # C/nmol; the electric potential is then in mV


def text_of(value: Value) -> str:
    """A value as FEBio reads it: 12 significant digits, 0/1 for truth values, commas between components."""
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, tuple):
        return ",".join(text_of(v) for v in value)
    if isinstance(value, float):
        return f"{value:.12g}"
    return str(value)


def child(parent: Element, tag: str, value: Value | None = None, **attributes: str) -> Element:
    """Append an element with attributes and, where given, a text."""
    made = etree.SubElement(parent, tag, attributes)
    if value is not None:
        made.text = text_of(value)
    return made


def fill(parent: Element, **values: Value) -> None:
    """Append an element for each name, with its value as the text."""
    for tag, value in values.items():
        child(parent, tag, value)


@dataclass(frozen=True)
class Param:
    """One parameter: tag, value, and where needed a load curve number and attributes."""

    tag: str
    value: Value
    curve: int | None = None
    attributes: Mapping[str, str] = field(default_factory=dict)

    def write(self, parent: Element) -> None:
        """Append the parameter to `parent`."""
        made = child(parent, self.tag, self.value, **dict(self.attributes))
        if self.curve is not None:
            made.set("lc", str(self.curve))


@dataclass(frozen=True)
class Solid:
    """Neo-Hookean solid."""

    modulus: float  # Young's modulus at small strain, MPa
    poisson: float = 0.0  # Poisson's ratio

    def write(self, parent: Element, tag: str = "solid") -> Element:
        made = child(parent, tag, type="neo-Hookean")
        fill(made, density=1.0, E=self.modulus, v=self.poisson)
        return made


@dataclass(frozen=True)
class Solute:
    """Transport of one solute in one material."""

    sol: int = 1  # number of the solute in the model's list, from 1
    # d in the mixture and d0 in the solvent, mm^2/s.
    diffusivity: float = 5e-4
    free_diffusivity: float = 5e-4
    solubility: float = 1.0  # effective solubility kappa~, dimensionless: actual c = kappa~ c~

    def write(self, parent: Element) -> None:
        made = child(parent, "solute", sol=str(self.sol))
        diffusivity = child(made, "diffusivity", type="diff-const-iso")
        fill(diffusivity, free_diff=self.free_diffusivity, diff=self.diffusivity)
        child(child(made, "solubility", type="solub-const"), "solub", self.solubility)


@dataclass(frozen=True)
class Mixture:
    """Porous material: biphasic without solutes, biphasic-solute, triphasic or multiphasic with them."""

    solid: Solid
    permeability: float  # hydraulic permeability k, mm^4/(N s)
    porosity: float = 0.8  # reference volume fraction of the solvent, phi_w
    solutes: tuple[Solute, ...] = ()
    osmotic: float = 1.0  # osmotic coefficient Phi
    fixed_charge: float = 0.0  # charge density of the solid matrix, mM (mEq/L); for triphasic and multiphasic
    # FEBio's name of the material; without it, multiphasic in the module of that name and biphasic-solute otherwise.
    febio_type: str | None = None

    def kind(self, module: str) -> str:
        """FEBio's name of the material in `module`."""
        if self.febio_type:
            return self.febio_type
        if not self.solutes:
            return "biphasic"
        return "multiphasic" if module == "multiphasic" else "biphasic-solute"

    def write(self, parent: Element, number: int, name: str, module: str) -> None:
        made = child(parent, "material", id=str(number), name=name, type=self.kind(module))
        child(made, "phi0", 1.0 - self.porosity)
        if self.kind(module) in ("triphasic", "multiphasic"):
            child(made, "fixed_charge_density", self.fixed_charge)
        self.solid.write(made)
        child(child(made, "permeability", type="perm-const-iso"), "perm", self.permeability)
        if self.solutes:
            child(child(made, "osmotic_coefficient", type="osm-coef-const"), "osmcoef", self.osmotic)
        for solute in self.solutes:
            solute.write(made)


@dataclass(frozen=True)
class Elastic:
    """Elastic material: neither solvent nor solutes pass."""

    solid: Solid
    solutes: ClassVar[tuple[Solute, ...]] = ()

    def write(self, parent: Element, number: int, name: str, module: str) -> None:  # noqa: ARG002 the same in all modules
        made = self.solid.write(parent, "material")
        made.set("id", str(number))
        made.set("name", name)


@dataclass(frozen=True)
class Rigid:
    """Rigid body: neither solvent nor solutes pass. Held by `hold_rigid`."""

    # Point on which forces act and about which the body turns, mm; the centre of mass without it.
    centre: tuple[float, float, float] | None = None
    solutes: ClassVar[tuple[Solute, ...]] = ()

    def write(self, parent: Element, number: int, name: str, module: str) -> None:  # noqa: ARG002 the same in all modules
        made = child(parent, "material", id=str(number), name=name, type="rigid body")
        child(made, "density", 1.0)
        if self.centre is not None:
            child(made, "center_of_mass", self.centre)


Material: TypeAlias = Mixture | Elastic | Rigid


@dataclass(frozen=True)
class Curve:
    """A load curve: points (time in s, factor) joined by lines or steps, constant beyond both ends."""

    points: tuple[tuple[float, float], ...]
    interpolate: str = "LINEAR"

    def write(self, parent: Element, number: int) -> None:
        made = child(parent, "load_controller", id=str(number), type="loadcurve")
        fill(made, interpolate=self.interpolate, extend="CONSTANT")
        points = child(made, "points")
        for point in self.points:
            child(points, "pt", point)


@dataclass(frozen=True)
class Condition:
    """A boundary or initial condition on a node set, a load on a surface, or a constraint of a rigid body."""

    # ``bc``, ``ic``, ``surface_load``, ``rigid_bc`` or ``rigid_load``, and FEBio's type.
    tag: str
    kind: str
    where: str  # name of the node set, surface, or material of the rigid body
    params: tuple[Param, ...] = ()

    @property
    def on_nodes(self) -> bool:
        """Whether `where` is a node set."""
        return self.tag in ("bc", "ic")

    @property
    def of_rigid_body(self) -> bool:
        """Whether `where` is the material of a rigid body."""
        return self.tag in ("rigid_bc", "rigid_load")

    def write(self, parent: Element) -> None:
        made = child(parent, self.tag, name=f"{self.kind} {self.where}", type=self.kind)
        if self.of_rigid_body:
            child(made, "rb", self.where)
        else:
            made.set("node_set" if self.on_nodes else "surface", self.where)
        for param in self.params:
            param.write(made)


def fix(where: str, axes: str) -> Condition:
    """Hold the displacement along the axes in `axes` (letters x, y, z) on a node set."""
    return Condition("bc", "zero displacement", where, tuple(Param(f"{a}_dof", a in axes) for a in "xyz"))


def displace(where: str, axis: str, value: float, curve: int | None = None) -> Condition:
    """Prescribe the displacement (mm) along one axis on a node set."""
    params = (Param("dof", axis), Param("value", value, curve), Param("relative", False))
    return Condition("bc", "prescribed displacement", where, params)


def hold_rigid(material: str, dofs: str) -> Condition:
    """Hold a rigid body: translations x, y, z and rotations u, v, w about these axes, by the letters in `dofs`."""
    return Condition("rigid_bc", "rigid_fixed", material, tuple(Param(f"R{d}_dof", d in dofs) for d in "xyzuvw"))


def turn_rigid(material: str, axis: str, angle: float, curve: int | None = None) -> Condition:
    """Prescribe the rotation (rad) of a rigid body about one axis, by its letter u, v or w for x, y or z."""
    params = (Param("dof", f"R{axis}"), Param("value", angle, curve), Param("relative", False))
    return Condition("rigid_bc", "rigid_rotation", material, params)


def push_rigid(material: str, axis: str, force: float, curve: int | None = None) -> Condition:
    """Load a rigid body with a force (N) along one axis."""
    return Condition("rigid_load", "rigid_force", material, (Param("dof", f"R{axis}"), Param("value", force, curve)))


def pressure(where: str, value: float, curve: int | None = None) -> Condition:
    """Prescribe the effective fluid pressure p~ (MPa) on a node set."""
    return Condition("bc", "prescribed fluid pressure", where, (Param("value", value, curve), Param("relative", False)))


def concentration(where: str, value: float, curve: int | None = None, sol: int = 1) -> Condition:
    """Prescribe the effective concentration c~ (mM) of solute `sol` on a node set."""
    params = (Param("dof", f"c{sol}"), Param("value", value, curve), Param("relative", False))
    return Condition("bc", "prescribed concentration", where, params)


def effective_pressure(concentration: float, fluid: float = 0.0) -> float:
    """Effective pressure p~ = p - R T c (MPa) at a fluid pressure (MPa) and a concentration (mM) of all solutes."""
    return fluid - GAS_CONSTANT * TEMPERATURE * concentration


def initial_pressure(where: str, value: float) -> Condition:
    """Effective fluid pressure p~ (MPa) of a node set at the start."""
    return Condition("ic", "initial fluid pressure", where, (Param("value", value),))


def initial_concentration(where: str, value: float, sol: int = 1) -> Condition:
    """Effective concentration c~ (mM) of solute `sol` on a node set at the start."""
    return Condition("ic", "initial concentration", where, (Param("dof", f"c{sol}"), Param("value", value)))


def normal_load(where: str, value: float, curve: int | None = None) -> Condition:
    """Press on a surface with `value` MPa, acting on the whole mixture, in the reference configuration."""
    params = (Param("pressure", value, curve), Param("linear", True), Param("symmetric_stiffness", False))
    return Condition("surface_load", "pressure", where, params)


def fluid_flux(where: str, value: float) -> Condition:
    """Prescribe the volume flux of solvent out of a surface relative to the solid (mm/s)."""
    params = (Param("flux", value), Param("linear", True), Param("mixture", False))
    return Condition("surface_load", "fluidflux", where, params)


@dataclass(frozen=True)
class TimeStepper:
    """FEBio's automatic time stepper."""

    max_step: float  # largest step, s; 0 where `must_points` is given, whose values then are the largest step
    retries: int = 5  # how often a failed step is tried again
    optimal_iterations: int = 11  # iterations above which the step shrinks
    must_points: int | None = None  # number of the load curve whose points must be met
    aggressive: bool = False  # halve a failed step instead of taking off a fixed part
    force: bool = False  # always take the largest step allowed

    def write(self, parent: Element) -> None:
        made = child(parent, "time_stepper", type="default")
        fill(made, max_retries=self.retries, opt_iter=self.optimal_iterations, dtmin=0.0)
        Param("dtmax", self.max_step, self.must_points).write(made)
        fill(made, aggressiveness=self.aggressive, cutback=0.5, dtforce=self.force)


@dataclass(frozen=True)
class Control:
    """Time steps and Newton tolerances."""

    steps: int  # number of steps
    step: float  # size of a step, s
    # dtol, etol, ptol, ctol of FEBio, relative.
    displacement_tolerance: float = 0.001
    energy_tolerance: float = 0.01
    pressure_tolerance: float = 0.01
    concentration_tolerance: float = 0.01
    residual_tolerance: float = 0.0  # rtol of FEBio; 0 switches that test off
    reformations: int = 15  # largest number of matrix reformations in a step
    # Adaptive steps; fixed ones without it. The analysis ends at `steps` times `step` all the same.
    stepper: TimeStepper | None = None
    solver: tuple[Param, ...] = ()  # further parameters of the solver
    # End of the analysis, s, instead of `steps` times `step`: FEBio's number of steps has 32 bits.
    end: float | None = None
    # FEBio's type of analysis; STATIC in the module `solid` and TRANSIENT elsewhere without it.
    analysis: str | None = None
    updates: int = 0  # largest number of quasi-Newton updates (BFGS) between two matrices
    matrix: str = "non-symmetric"  # FEBio's name of the form of the solver's matrix: ``non-symmetric`` or ``symmetric``

    def write(self, parent: Element, module: str, plot: bool) -> None:
        made = child(parent, "Control")
        child(made, "analysis", self.analysis or ("STATIC" if module == "solid" else "TRANSIENT"))
        child(made, "time_steps", self.steps if self.end is None else -1)
        if self.end is not None:
            child(made, "final_time", self.end)
        fill(made, step_size=self.step, plot_level="PLOT_MAJOR_ITRS" if plot else "PLOT_NEVER")
        if self.stepper:
            self.stepper.write(made)
        solver = child(made, "solver", type=module)
        fill(solver, symmetric_stiffness=self.matrix, max_refs=self.reformations)
        fill(solver, dtol=self.displacement_tolerance, etol=self.energy_tolerance, rtol=self.residual_tolerance)
        if module != "solid":
            child(solver, "ptol", self.pressure_tolerance)
        if module in ("solute", "multiphasic"):
            child(solver, "ctol", self.concentration_tolerance)
        for param in self.solver:
            param.write(solver)
        child(child(solver, "qn_method", type="BFGS"), "max_ups", self.updates)


@dataclass(frozen=True)
class Contact:
    """A contact interface between the two surfaces of a pair."""

    kind: str
    pair: str
    params: tuple[Param, ...] = ()

    def write(self, parent: Element) -> None:
        made = child(parent, "contact", name=self.pair, type=self.kind, surface_pair=self.pair)
        for param in self.params:
            param.write(made)


@dataclass(frozen=True)
class Springs:
    """Springs of one stiffness, which pull and push."""

    name: str
    stiffness: float  # of each spring, N/mm
    ends: Ids  # shape (n_springs, 2): node numbers, from 1
    curve: int | None = None  # number of a load curve that is a factor of the stiffness

    def write_mesh(self, parent: Element) -> None:
        made = child(parent, "DiscreteSet", name=self.name)
        for pair in self.ends:
            child(made, "delem", tuple(map(int, pair)))

    def write_material(self, parent: Element, number: int) -> None:
        made = child(parent, "discrete_material", id=str(number), name=self.name, type="linear spring")
        Param("E", self.stiffness, self.curve).write(made)

    def write_set(self, parent: Element, number: int) -> None:
        child(parent, "discrete", dmat=str(number), discrete_set=self.name)
