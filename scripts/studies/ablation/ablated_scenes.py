"""The scenes that devices are left out of: joints, hard cases on the coarse mesh, synthetic and reported scenes."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import product
from pathlib import Path

from harness.models.document import Model
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.scene import Fineness, Interface
from studies.models.small import Scheme, fixed, moved
from studies.price import joints
from studies.synthetic_scenes import collections_of_scenes, comparison
from studies.synthetic_scenes.comparison import Written
from studies.synthetic_scenes.reported import words
from studies.synthetic_scenes.reported.kinds_of_scene import SCENES as REPORTED
from studies.synthetic_scenes.reported.shapes import box, mapped
from studies.synthetic_scenes.reported.sketch import Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import Material

LOADS = {
    "pulled": (("z", 0.1),),
    "sheared": (("x", 0.2), ("z", 0.0)),
    "lifted": (("x", 0.15), ("z", 0.1)),
}
"""Displacements (mm) of the top by direction."""


@dataclass(frozen=True)
class Tied:
    """A layer on a block, joined across meshes that do not match."""

    load: str  # one of `LOADS`
    material: Material  # of both bodies
    tie: str  # parameters of `tied-mixture`
    cells: int = 8  # elements along the layer; the block has two fewer

    def sketch(self) -> Sketch:
        """The model. One end of the layer is held if the load lifts the other."""
        bodies = {
            "block": mapped((self.cells - 2, 3, 3), box((0, 0, -0.5), (2, 0.5, 0))),
            "layer": mapped((self.cells, 4, 2), box((0, 0, 0), (2, 0.5, 0.3))),
        }
        end = "layer-x0" if self.load == "lifted" else "layer-z1"
        is_porous = self.material[0] == "biphasic"
        drained = (words.drained("layer-z1"),) if is_porous else ()
        return Sketch(
            bodies,
            dict.fromkeys(bodies, self.material),
            (Touch("layer-z0", "block-z1", "tied-mixture", self.tie),),
            (fixed("block-z0"), *(moved(end, dof, value) for dof, value in LOADS[self.load]), *drained),
            Scheme(20, 0.05),
            "biphasic" if is_porous else "solid",
        )


def _breaking(strength: float, energy: float) -> str:
    return f"<max_traction>{strength:g}</max_traction><fracture_energy>{energy:g}</fracture_energy>"


LASTING = {
    f"{load}-{name}": Tied(load, material, "")
    for load, (name, material) in product(LOADS, (("elastic", words.neo()), ("biphasic", words.biphasic())))
}
"""Ties that cannot break, by name."""
BREAKING = {
    f"{load}-{modulus:g}-MPa-{energy:g}-N-mm": Tied(load, words.neo(modulus), _breaking(0.05, energy))
    for load, modulus, energy in product(LOADS, (1.0, 3.0, 10.0, 30.0), (1e-4, 3e-4, 1e-3, 3e-3))
}
"""Ties whose bonds soften and break, by name."""


def _write_tied(tied: Tied, folder: Path) -> Path:
    return Drawn("ties", tied.sketch).write("ties", folder)


WRITERS = {name: partial(_write_tied, tied) for name, tied in {**LASTING, **BREAKING}.items()}
"""Writes the model of a name into a folder, and returns its path."""


JOINT, HARD_CASE, SYNTHETIC, REPORT, TIE = "joint", "hard case", "synthetic scene", "reported scene", "tie"


@dataclass(frozen=True)
class AblatedScene:
    """A scene with the plugin's contact."""

    kind: str  # `JOINT`, `HARD_CASE`, `SYNTHETIC`, `REPORT` or `TIE`
    write: Callable[[Path], Path]  # writes the model into a folder, and returns its path


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
    **{f"{TIE}: {name}": AblatedScene(TIE, write) for name, write in WRITERS.items()},
}
