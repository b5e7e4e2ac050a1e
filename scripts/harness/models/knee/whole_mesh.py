"""The mesh of the knee: its parts, contact surfaces and pairs, and the springs of the menisci's horns."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

import numpy as np

from harness.models.knee import structured_blocks
from harness.models.knee.anatomy import COMPARTMENTS, Compartment
from harness.models.knee.structured_blocks import Block, Divisions
from harness.models.mesh import Ids, Mesh, Part
from harness.models.springs import Springs

_Named = tuple[str, Ids]
"""A surface with its name."""


class Size(str, Enum):
    """How fine the mesh is, by its number of equations where all bodies are elastic."""

    COARSE = "coarse"
    """About 3 000 equations, for a first look."""
    SMALL = "small"
    """About 25 000 equations."""
    MEDIUM = "medium"
    """About 100 000 equations."""
    LARGE = "large"
    """About 300 000 equations."""


DIVISIONS: Mapping[Size, Divisions] = {
    Size.COARSE: Divisions((3, 12, 1), (12, 16, 1), (28, 3, 1)),
    Size.SMALL: Divisions((4, 16, 3), (16, 22, 3), (46, 5, 3)),
    Size.MEDIUM: Divisions((6, 28, 5), (28, 36, 5), (74, 8, 5)),
    Size.LARGE: Divisions((9, 40, 7), (40, 54, 7), (112, 12, 7)),
}
HORN_STIFFNESS = 2000.0
"""N/mm of all springs of a horn together: Haut Donahue et al. (2002), J Biomech Eng 124:273."""
REACH = 8.0
"""How far from a horn, along x and y, its springs end in the bone, mm."""
FEMORAL, TIBIAL, MENISCAL = "femoral-cartilage", "tibial-cartilage", "meniscus"
FEMUR, TIBIA = "femur", "tibia"


def meshed(size: Size) -> tuple[Mesh, tuple[Springs, ...]]:
    """The knee's mesh and the springs of its horns."""
    divisions = DIVISIONS[size]
    makers = (structured_blocks.femur, structured_blocks.tibia, structured_blocks.meniscus)
    blocks = structured_blocks.numbered([make(side, divisions) for side in COMPARTMENTS for make in makers])
    parts: list[Part] = []
    surfaces: dict[str, Ids] = {}
    pairs: dict[str, tuple[str, str]] = {}
    springs: list[Springs] = []
    for side, (femur, tibia, meniscus) in zip(COMPARTMENTS, (blocks[:3], blocks[3:]), strict=True):
        parts += _parts(side, femur, tibia, meniscus)
        for name, both in _contacts(side, femur, tibia, meniscus).items():
            surfaces |= dict(both)
            pairs[name] = (both[0][0], both[1][0])
        springs += [_horn(side, meniscus, tibia, end) for end in (0, -1)]
    nodes = np.concatenate([block.points.reshape(-1, 3) for block in blocks])
    sets = {"all": np.arange(1, len(nodes) + 1, dtype=np.int64)}
    return Mesh(nodes, tuple(parts), sets, surfaces, pairs), tuple(springs)


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
    places = tibia.points[:, :, 0].reshape(-1, 3)
    reach = REACH * np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]])
    nearest = [int(np.argmin(np.linalg.norm(places[:, :2] - target, axis=1))) for target in middle[:2] + reach]
    ends = np.array([(node, under[place]) for node in face for place in nearest], dtype=np.int64)
    name = f"{'anterior' if middle[1] > 0 else 'posterior'}-horn-{side.name}"
    return Springs(name, HORN_STIFFNESS / len(ends), ends)
