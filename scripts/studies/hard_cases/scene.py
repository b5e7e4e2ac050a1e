"""What a hard case consists of, and the pieces that all of them use."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from typing import Protocol

from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, automatic
from harness.models.mesh import Mesh
from harness.models.parts import Condition, Contact, Control, Curve, Mixture, Param, Solid, Solute
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from studies.models import pieces
from studies.models.pieces import PREDICTOR, UNCLAMPED

GEL = Mixture(Solid(1.0), permeability=1e-3, solutes=(Solute(1, 5e-4, 5e-4),))
"""E = 1 MPa, nu = 0, k = 1e-3 mm^4/(N s), d = d0 = 5e-4 mm^2/s, phi_w = 0.8.
Over 1 mm both diffusion times are 1000 to 2000 s."""
NEWTON = 1e-3
"""Newton's relative tolerances. At a steady state far smaller ones ask for less than the rounding of an increment."""
FLOWS = ("contact_force.x", "contact_force.y", "contact_force.z", "contact solvent flow", "contact solute flow 1")
FACETS = ("contact gap", "contact pressure")


class Fineness(str, Enum):
    """Which of two meshes."""

    COARSE = "coarse"
    FINE = "fine"


class Interface(str, Enum):
    """What joins the bodies: the plugin's interface, without or with its predictor, or FEBio's with a factor.

    FEBio's interfaces need such a factor, because their default is the number 1 in the units of the model. 1 is what
    runs most easily, 1000 what is about as accurate as the plugin's default.
    """

    MIXTURE = "sliding-mixture"
    PREDICTED = "sliding-mixture-predictor"
    FEBIO_1 = "febio-1"
    FEBIO_1000 = "febio-1000"

    @property
    def ours(self) -> bool:
        """Whether it is the plugin's."""
        return self in (Interface.MIXTURE, Interface.PREDICTED)

    @property
    def contact_type(self) -> InterfaceType:
        """The type of contact."""
        return InterfaceType.MIXTURE if self.ours else InterfaceType.MULTIPHASIC

    def settings(self, scale: float = 1.0) -> ContactSettings:
        """Parameters of the interface, with all penalties times `scale`.

        The plugin's default factors are 1e3 on the stiffness and 1e5 on the conductances. FEBio's interfaces get their
        non-symmetric tangent, and a search radius below the size of a body.
        """
        if self.ours:
            own = (
                ContactSettings() if scale == 1.0 else replace(automatic(1e5 * scale), laugon=None, penalty=1e3 * scale)
            )
            return replace(own, extra=(PREDICTOR,)) if self is Interface.PREDICTED else own
        given = automatic((1.0 if self is Interface.FEBIO_1 else 1000.0) * scale)
        return replace(given, search_radius=0.5, extra=(Param("symmetric_stiffness", False),))

    def contacts(
        self, mesh: Mesh, extra: Sequence[Param] = (), scale: float = 1.0, augmented: float | None = None
    ) -> tuple[Contact, ...]:
        """One interface for each pair of a mesh; augmented to a relative tolerance where one is given."""
        settings = self.settings(scale)
        if augmented is not None:
            settings = replace(settings, laugon="AUGLAG", tolerance=augmented)
        params = (*settings.params(), *extra)
        return tuple(Contact(self.contact_type.value, pair, params) for pair in mesh.pairs)


UNDERSHOOT = 2.0 - 3.0**0.5
"""How far concentrations may leave the range of what is given, relative to that range.

For steps that are short against h^2/d the linear elements solve c[j-1] + 4 c[j] + c[j+1] = 0 next to a jump at the
boundary: c[j] is proportional to (sqrt(3) - 2)^j. This is a property of the bodies, not of the contact.
"""


class Scene(Protocol):
    """A hard case: a model for each mesh and interface, and what its solution has to satisfy."""

    def model(self, mesh: Fineness, interface: Interface) -> Model:
        """The model."""

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """The physical checks of a run that ended normally."""


@dataclass(frozen=True)
class Case:
    """A hard case."""

    about: str  # what is hard about it, in a few words
    scene: Scene
    undershoot: float = UNDERSHOOT  # how far concentrations may leave their range, relative to it
    pointwise: float = 0.02
    """Deepest overlap, and largest gap under load, of the facets' means, relative to the length of a facet."""
    swap: float = 0.05  # relative difference with primary and secondary exchanged: the error of these coarse meshes


def timed(times: Sequence[float], curve: int, newton: float = NEWTON) -> tuple[Control, Curve]:
    """Time steps that end at `times` (s) with these tolerances, and their load curve, of number `curve`."""
    return pieces.timed(
        times,
        curve,
        displacement_tolerance=newton,
        energy_tolerance=newton,
        pressure_tolerance=newton,
        concentration_tolerance=newton,
        reformations=25,
    )


def finished(model: Model, interface: Interface) -> Model:
    """The same model with the output that the checks read, and negative concentrations left as they are.

    FEBio's interfaces have no flows to write. The clamp on concentrations, which only the multiphasic solver can do
    without, makes solute from nothing.
    """
    flows = FLOWS[:4] + tuple(f"contact solute flow {k + 1}" for k in range(model.n_solutes))
    return replace(
        model,
        control=replace(model.control, solver=UNCLAMPED),
        further_columns=("Rx", "Ry", "Rz"),
        surface_columns=flows if interface.ours else (),
        facet_columns=FACETS,
    )


def prescribed(conditions: Sequence[Condition], kind: str) -> set[str]:
    """Names of the node sets on which a kind of boundary condition acts."""
    return {condition.where for condition in conditions if condition.kind == kind}
