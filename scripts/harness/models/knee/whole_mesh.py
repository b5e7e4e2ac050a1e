"""The mesh of the knee: its parts, contact surfaces and pairs, and the springs of the menisci's horns."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum
from itertools import repeat

import numpy as np

from harness.arrays import Array, Ids
from harness.models.knee import anatomy, structured_blocks
from harness.models.knee.anatomy import COMPARTMENTS, Compartment
from harness.models.knee.structured_blocks import Block, Divisions, Fit
from harness.models.mesh import Mesh, Part
from harness.models.parts import Springs

_Named = tuple[str, Ids]  # a surface with its name


class Size(str, Enum):
    """How fine the mesh is, by its number of equations where all bodies are elastic."""

    COARSE = "coarse"  # about 5 000 equations, for a first look
    SMALL = "small"  # about 25 000 equations
    MEDIUM = "medium"  # about 100 000 equations
    LARGE = "large"  # about 300 000 equations


DIVISIONS = {
    Size.COARSE: Divisions((3, 12, 1), (12, 16, 1), (28, 3, 1)),
    Size.SMALL: Divisions((4, 16, 3), (16, 22, 3), (46, 5, 3)),
    Size.MEDIUM: Divisions((6, 28, 5), (28, 36, 5), (74, 8, 5)),
    Size.LARGE: Divisions((9, 40, 7), (40, 54, 7), (112, 12, 7)),
}
_POROUS_COARSE = Divisions((2, 8, 3), (8, 12, 3), (20, 2, 3))
POROUS_DIVISIONS: Mapping[Size, Divisions] = {
    size: replace(divisions, depths=structured_blocks.graded)
    for size, divisions in (DIVISIONS | {Size.COARSE: _POROUS_COARSE}).items()
}
"""Those of porous bodies: at least three layers, thinner towards surface and bone, where the fluid pressure bends."""
HORN_STIFFNESS = 2000.0  # N/mm of all springs of a horn together: Haut Donahue et al. (2002), J Biomech Eng 124:273.
STAND_STIFFNESS = 1000.0  # N/mm of a stand at the start
REACH = 8.0  # how far from a horn, along x and y, its springs end in the bone, mm
FEMORAL, TIBIAL, MENISCAL = "femoral-cartilage", "tibial-cartilage", "meniscus"
FEMUR, TIBIA = "femur", "tibia"
POROUS, BATH = "porous", "bath"
"""Node sets of porous bodies: all their nodes, and those in the synovial fluid that no contact has."""


@dataclass(frozen=True)
class Meshed:
    """A knee without materials and loads."""

    mesh: Mesh
    horns: tuple[Springs, ...]  # of the menisci
    stands: tuple[Springs, ...]  # between femur and tibia, one in each compartment
    axis: float  # height of the axis of flexion, mm


def meshed(size: Size, *, porous: bool = False) -> Meshed:
    """The knee of a size."""
    divisions = POROUS_DIVISIONS[size] if porous else DIVISIONS[size]
    fits = [structured_blocks.touching(side, divisions) if porous else Fit(divisions.seat) for side in COMPARTMENTS]
    sides = [structured_blocks.compartment(*each) for each in zip(COMPARTMENTS, repeat(divisions), fits, strict=False)]
    blocks = structured_blocks.numbered(sides[0] + sides[1])
    parts: list[Part] = []
    surfaces: dict[str, Ids] = {}
    pairs: dict[str, tuple[str, str]] = {}
    horns: list[Springs] = []
    stands: list[Springs] = []
    for side, (femur, tibia, meniscus) in zip(COMPARTMENTS, (blocks[:3], blocks[3:]), strict=True):
        parts += _parts(side, femur, tibia, meniscus)
        for name, both in _contacts(side, femur, tibia, meniscus).items():
            surfaces |= dict(both)
            pairs[name] = (both[0][0], both[1][0])
        horns += [_horn(side, meniscus, tibia, end) for end in (0, -1)]
        stands.append(_stand(side, femur, tibia))
    nodes = np.concatenate([block.points.reshape(-1, 3) for block in blocks])
    sets = {"all": np.arange(1, len(nodes) + 1, dtype=np.int64)}
    if porous:
        sets |= {
            POROUS: np.concatenate([block.nodes[:, :, block.bone :].ravel() for block in blocks]),
            BATH: np.concatenate([block.sides for block in blocks]),
        }
    axis = anatomy.SAGITTAL - fits[0].seat
    return Meshed(Mesh(nodes, tuple(parts), sets, surfaces, pairs), tuple(horns), tuple(stands), axis)


def _parts(side: Compartment, femur: Block, tibia: Block, meniscus: Block) -> list[Part]:
    bone, cartilage = slice(None, 1), slice(1, None)
    return [
        Part(f"{FEMORAL}-{side.name}", FEMORAL, femur.elements(cartilage)),
        Part(f"{FEMUR}-{side.name}", FEMUR, femur.elements(bone)),
        Part(f"{TIBIAL}-{side.name}", TIBIAL, tibia.elements(cartilage)),
        Part(f"{TIBIA}-{side.name}", TIBIA, tibia.elements(bone)),
        Part(f"{MENISCAL}-{side.name}", MENISCAL, meniscus.elements(slice(None))),
    ]


def _contacts(side: Compartment, femur: Block, tibia: Block, meniscus: Block) -> dict[str, tuple[_Named, _Named]]:
    """The three contacts of a compartment, the finer side of each first.

    A surface that has two contacts has a name for each: FEBio's plot file has the results of one contact per name.
    """
    name = side.name
    return {
        f"femur-tibia-{name}": ((f"tibia-to-femur-{name}", tibia.top), (f"femur-to-tibia-{name}", femur.top)),
        f"femur-meniscus-{name}": (
            (f"meniscus-to-femur-{name}", meniscus.top),
            (f"femur-to-meniscus-{name}", femur.top),
        ),
        f"meniscus-tibia-{name}": (
            (f"meniscus-to-tibia-{name}", meniscus.bottom),
            (f"tibia-to-meniscus-{name}", tibia.top),
        ),
    }


def _horn(side: Compartment, meniscus: Block, tibia: Block, end: int) -> Springs:
    """Springs from each node of a meniscus's end to four nodes at the underside of the tibial bone."""
    face, under = meniscus.nodes[end].ravel(), tibia.nodes[:, :, 0].ravel()
    middle = meniscus.points[end].reshape(-1, 3).mean(axis=0)
    reach = REACH * np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]])
    nearest = [_nearest(tibia.points[:, :, 0], target) for target in middle[:2] + reach]
    ends = np.array([(node, under[place]) for node in face for place in nearest], dtype=np.int64)
    name = f"{'anterior' if middle[1] > 0 else 'posterior'}-horn-{side.name}"
    return Springs(name, HORN_STIFFNESS / len(ends), ends)


def _stand(side: Compartment, femur: Block, tibia: Block) -> Springs:
    """A spring between the bones, upright through the middle of the compartment."""
    middle = np.array([side.centre, 0.0])
    ends = [block.nodes[:, :, 0].ravel()[_nearest(block.points[:, :, 0], middle)] for block in (femur, tibia)]
    return Springs(f"stand-{side.name}", STAND_STIFFNESS, np.array([ends], dtype=np.int64))


def _nearest(points: Array, target: Array) -> int:
    """Which of the points is nearest to a place in x and y, by its number in the flat order."""
    return int(np.argmin(np.linalg.norm(points.reshape(-1, 3)[:, :2] - target, axis=1)))
