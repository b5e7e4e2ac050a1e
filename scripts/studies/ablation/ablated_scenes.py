"""The scenes that devices are left out of: joints, hard cases on the coarse mesh, synthetic and reported scenes."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from harness.models.document import Model
from studies.ablation import tied_scenes
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.scene import Fineness, Interface
from studies.price import joints
from studies.synthetic_scenes import collections_of_scenes, comparison
from studies.synthetic_scenes.comparison import Written
from studies.synthetic_scenes.reported.kinds_of_scene import SCENES as REPORTED

JOINT, HARD_CASE, SYNTHETIC, REPORT, TIE = "joint", "hard case", "synthetic scene", "reported scene", "tie"


@dataclass(frozen=True)
class AblatedScene:
    """A scene with the plugin's contact."""

    kind: str
    """`JOINT`, `HARD_CASE`, `SYNTHETIC`, `REPORT` or `TIE`."""
    write: Callable[[Path], Path]
    """Writes the model into a folder, and returns its path."""


def _write(make: Callable[[], Model], folder: Path) -> Path:
    return make().write(folder)


def _write_converted(name: str, scene: Written, folder: Path) -> Path:
    """Write a scene converted, with its penalties deleted."""
    original = scene.write(name, folder / "febio")
    return comparison.write_converted(original, folder, comparison.without_penalties)


def _converted(kind: str, scenes: Mapping[str, Written]) -> Mapping[str, AblatedScene]:
    return {f"{kind}: {name}": AblatedScene(kind, partial(_write_converted, name, scenes[name])) for name in scenes}


SCENES: Mapping[str, AblatedScene] = {
    **{f"{JOINT}: {name}": AblatedScene(JOINT, partial(_write, scene.model)) for name, scene in joints.SCENES.items()},
    **{
        f"{HARD_CASE}: {name}": AblatedScene(
            HARD_CASE, partial(_write, partial(case.scene.model, Fineness.COARSE, Interface.MIXTURE))
        )
        for name, case in CASES.items()
    },
    **_converted(SYNTHETIC, collections_of_scenes.SCENES),
    **_converted(REPORT, REPORTED),
    **{f"{TIE}: {name}": AblatedScene(TIE, write) for name, write in tied_scenes.WRITERS.items()},
}
