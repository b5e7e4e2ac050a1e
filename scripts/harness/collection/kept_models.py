"""The models that stand in models/ for a user to open, run and copy."""

from __future__ import annotations

from pathlib import Path

from harness.models.ball_in_socket import BallInSocket
from harness.models.composite import Composite
from harness.models.confined import Confined
from harness.models.convection import PRESSURES, Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.graft import Graft
from harness.models.indentation import Indentation
from harness.models.interface import InterfaceType
from harness.models.joint import Joint, Source
from harness.models.layers import Layers
from harness.models.membrane import Membrane
from harness.models.parts import Control, Param
from harness.models.plate_on_layer import PlateOnLayer
from harness.models.platens import Platens
from harness.models.sliding_joint import SlidingJoint

INDENTATION = Indentation(module="multiphasic", clamp=False, plot=True)
JOINT = Joint(plot=True)
JOINT_RELEASE = Joint(source=Source.UPPER, name="joint-release", plot=True)
GRAFT = Graft(plot=True)
PLATENS = Platens(plot=True)
"""Models from practice."""


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
    ]


def write(folder: Path) -> list[Path]:
    """Write the collection into `folder` and return the paths."""
    return [model.write(folder) for model in (*models(), *to_convert())]


def outdated(folder: Path) -> list[str]:
    """Names of the files in `folder` that are missing or differ from what `write` would write."""
    files = {folder / f"{model.name}.feb": model.text() for model in (*models(), *to_convert())}
    return [path.name for path, text in files.items() if not path.is_file() or path.read_text("iso-8859-1") != text]
