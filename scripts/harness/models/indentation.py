"""Problem 3.3: a semi-cylinder is driven into a slab, and solute leaves the slab into it and into the surroundings."""

from dataclasses import dataclass, replace

from harness.models import parts
from harness.models.document import Model
from harness.models.indentation_mesh import Grid, Primary, mesh
from harness.models.interface import ContactSettings, InterfaceType, contacts, header

CONCENTRATION = 1.0  # initial concentration of the slab, mM; the cylinder and the surroundings have none
DEPTH = 2.0  # mm by which the cylinder's flat top is driven down
RAMP = 1.0  # s in which it is driven
END = 6000.0  # s
TIMES = (1.0, 100.0, 1000.0, 6000.0)  # times of the pictures of figure 3.4, s; a time step ends at each
GEL = parts.Mixture(
    parts.Solid(1.0, 0.3), permeability=1e-3, solutes=(parts.Solute(1, diffusivity=5e-4, free_diffusivity=1e-3),)
)

RAMP_CURVE, STEP_CURVE = 1, 2
STEPS = parts.Curve(((0.0, 0.1), (RAMP, 0.1), (100.0, 20.0), (1000.0, 250.0), (END, 250.0)))
"""Largest time step (s) over time; its points must be met. Fronts need small steps early, and nothing does later."""
CONTROL = parts.Control(
    round(END / 0.01),
    0.01,
    reformations=25,
    stepper=parts.TimeStepper(0.0, retries=8, optimal_iterations=15, must_points=STEP_CURVE, aggressive=True),
)

ABOUT = """\
Transient contact with solute transport: problem 3.3 and figure 3.4 of Ateshian, Maas and Weiss (2012),
J Biomech 45(6):1023-1027, doi:10.1016/j.jbiomech.2012.01.003.

A semi-cylinder of radius {radius:g} mm moves {depth:g} mm into a slab 3 mm wide and 2 mm high within 1 s, and stays
there until 6000 s. The slab has a concentration of 1 mM at the start, and the semi-cylinder and the surrounding fluid
have 0 mM. Diffusion and the flow of solvent carry solute out of the slab. The surrounding fluid wets all surfaces
that are not in contact.
By symmetry, the model contains one half, as a layer of one element with no displacement along z."""


@dataclass(frozen=True)
class Indentation:
    """Choices of problem 3.3."""

    interface: InterfaceType = InterfaceType.MIXTURE
    settings: ContactSettings | None = None  # default settings without it
    grid: Grid = Grid()
    primary: Primary = Primary.CYLINDER  # which body has the primary surface
    # Whether FEBio's multiphasic solver sets negative concentrations to zero; its solute solver always does.
    clamp: bool = True
    # Whether the round body's flat top is held along x and z. Its edge is then a singular corner, where a fine mesh
    # turns inside out.
    gripped: bool = True
    control: parts.Control = CONTROL
    module: str | None = None  # the module that `interface` asks for without it
    name: str = "indentation"
    plot: bool = False

    def model(self) -> Model:
        """The model of these choices."""
        made = mesh(self.grid, self.primary)
        module = self.module or self.interface.module
        clamp = parts.Param("force_positive_concentrations", self.clamp)
        return Model(
            self.name,
            header(self.name, ABOUT.format(radius=self.grid.radius, depth=DEPTH), self.interface),
            module,
            made,
            {"slab": GEL, "cylinder": GEL},
            self._conditions(),
            self.control if module != "multiphasic" else replace(self.control, solver=(clamp, *self.control.solver)),
            contacts(self.interface, made, self.settings),
            (parts.Curve(((0.0, 0.0), (RAMP, 1.0))), STEPS),
            plot=self.plot,
            further_columns=("Rx", "Ry", "Rz"),
        )

    def _conditions(self) -> tuple[parts.Condition, ...]:
        """With the initial p~ = -R T Phi c the actual fluid pressure is zero at the start, as in the surroundings."""
        grip = (parts.fix("top", "xz"),) if self.gripped else ()
        return (
            parts.fix("all", "z"),
            parts.fix("symmetry", "x"),
            parts.fix("bottom", "y"),
            *grip,
            parts.displace("top", "y", -DEPTH, RAMP_CURVE),
            parts.initial_concentration("slab", CONCENTRATION),
            parts.initial_pressure("slab", parts.effective_pressure(CONCENTRATION)),
        )
