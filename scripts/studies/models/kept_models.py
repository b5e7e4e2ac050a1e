"""The models that stand in models/ for a user to open, run and copy; `pages` writes them there."""

from harness.models.composite import Composite
from harness.models.confined import Confined
from harness.models.convection import PRESSURES, Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.indentation import Indentation
from harness.models.indentation_mesh import Grid
from harness.models.interface import InterfaceType
from harness.models.layers import Layers
from harness.models.parts import Control, Param
from studies.models.ball_in_socket import BallInSocket
from studies.models.delamination import Delamination
from studies.models.graft import Graft
from studies.models.joint import Joint, Source
from studies.models.membrane import Membrane
from studies.models.plate_on_layer import PlateOnLayer
from studies.models.platens import Platens
from studies.models.plug import Plug
from studies.models.sliding_joint import SlidingJoint

LEVELS = (Grid(across=9, down=6, around=3), Grid(), Grid(across=36, down=24, around=12))
"""Meshes of problem 3.3, each with half the element size of the one before."""
INDENTATION = Indentation(module="multiphasic", clamp=False, plot=True)
JOINT = Joint(plot=True)
JOINT_RELEASE = Joint(source=Source.UPPER, name="joint-release", plot=True)
GRAFT = Graft(plot=True)
PLATENS = Platens(plot=True)
PLUG = Plug(plot=True)
DELAMINATION = Delamination(plot=True)  # models from practice


def before_migration() -> Model:
    """A small model with one of FEBio's own interfaces, for `convert` to change."""
    return Diffusion(InterfaceType.SOLUTE, elements=5, control=Control(50, 160.0), name="before-migration").model()


def joint_before() -> Model:
    """A joint in its simplest shape with FEBio's interface and a penalty of the usual kind, for `convert` to change."""
    params = (Param("laugon", "PENALTY"), Param("auto_penalty", True), Param("penalty", 10.0))
    contact = InterfaceType.ELASTIC.value
    return BallInSocket(
        elements=6, primary="socket", contact=contact, params=params, name="joint-before", plot=True
    ).model()


def to_convert() -> list[Model]:
    """Models with FEBio's own interfaces."""
    return [before_migration(), joint_before()]


def models() -> list[Model]:
    """Every model of the collection, with the plugin's interface in its default settings and a plot file."""
    return [
        Diffusion(plot=True).model(),
        *(Convection(peclet=peclet, plot=True).model() for peclet in PRESSURES),
        Composite(plot=True).model(),
        Layers(plot=True).model(),
        Membrane(plot=True).model(),
        Confined(plot=True).model(),
        PlateOnLayer(plot=True).model(),
        SlidingJoint(plot=True).model(),
        INDENTATION.model(),
        JOINT.model(),
        JOINT_RELEASE.model(),
        GRAFT.model(),
        PLATENS.model(),
        PLUG.model(),
        DELAMINATION.model(),
    ]


def every_model() -> list[Model]:
    """The whole collection."""
    return [*models(), *to_convert()]
