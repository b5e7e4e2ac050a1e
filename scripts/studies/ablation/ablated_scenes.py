"""The scenes that devices are left out of: joints, hard cases on the coarse mesh, synthetic test scenes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from studies.hard_cases.catalogue import CASES
from studies.hard_cases.scene import Fineness, Interface
from studies.price import joints
from studies.synthetic_scenes import all_scenes, comparison

JOINT, HARD_CASE, SYNTHETIC = "joint", "hard case", "synthetic scene"


@dataclass(frozen=True)
class AblatedScene:
    """A scene with the plugin's contact.

    Attributes
    ----------
    kind : str
        `JOINT`, `HARD_CASE` or `SYNTHETIC`.
    write : callable
        Writes the model into a folder, and returns its path.
    """

    kind: str
    write: Callable[[Path], Path]


def _write_joint(scene: joints.Scene, folder: Path) -> Path:
    return scene.model().write(folder)


def _write_hard_case(name: str, folder: Path) -> Path:
    return CASES[name].scene.model(Fineness.COARSE, Interface.MIXTURE).write(folder)


def _write_synthetic(name: str, folder: Path) -> Path:
    """Write a scene converted, with its penalties deleted."""
    original = all_scenes.SCENES[name].write(name, folder / "febio")
    return comparison.write_converted(original, folder, comparison.without_penalties)


SCENES: Mapping[str, AblatedScene] = {
    **{f"{JOINT}: {name}": AblatedScene(JOINT, partial(_write_joint, scene)) for name, scene in joints.SCENES.items()},
    **{f"{HARD_CASE}: {name}": AblatedScene(HARD_CASE, partial(_write_hard_case, name)) for name in CASES},
    **{f"{SYNTHETIC}: {name}": AblatedScene(SYNTHETIC, partial(_write_synthetic, name)) for name in all_scenes.SCENES},
}
"""By name."""
