"""The models that stand in models/ for a user to open, run and copy."""

from __future__ import annotations

from pathlib import Path

from harness.collection import entries
from harness.models.ball_in_socket import BallInSocket
from harness.models.composite import Composite
from harness.models.confined import Confined
from harness.models.convection import PRESSURES, Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.interface import InterfaceType
from harness.models.layers import Layers
from harness.models.parts import Control, Param
from harness.models.plate_on_layer import PlateOnLayer
from harness.models.sliding_joint import SlidingJoint


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
    validated = [
        Diffusion(plot=True).model(),
        *(Convection(peclet=peclet, plot=True).model() for peclet in PRESSURES),
        Composite(plot=True).model(),
        Layers(plot=True).model(),
        Confined(plot=True).model(),
        PlateOnLayer(plot=True).model(),
        SlidingJoint(plot=True).model(),
    ]
    names = {model.name for model in validated}
    return validated + [entry.model for entry in entries.entries() if entry.model.name not in names]


def write(folder: Path) -> list[Path]:
    """Write the collection into `folder` and return the paths."""
    return [model.write(folder) for model in (*models(), *to_convert())]


def outdated(folder: Path) -> list[str]:
    """Names of the files in `folder` that are missing or differ from what `write` would write."""
    names = []
    for model in (*models(), *to_convert()):
        path = folder / f"{model.name}.feb"
        if not path.is_file() or path.read_text(encoding="iso-8859-1") != model.text():
            names.append(path.name)
    return names
