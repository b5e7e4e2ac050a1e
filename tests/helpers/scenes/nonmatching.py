"""Two blocks whose facets do not match at the contact, under uniform traction, linear pressure and concentration.

The field is exact for any mesh: with d = d0 and p~ = -R T c~ no solvent flows and the actual fluid pressure is zero, so
stress is uniform, and displacement, effective pressure and effective concentration are linear in z.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from harness.arrays import Ids
from harness.models.diffusion import DIFFUSIVITY, MATERIAL
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Box, Mesh, Nodes, Part, assemble
from harness.models.parts import GAS_CONSTANT, TEMPERATURE, Condition, Control, concentration, displace, fix, pressure
from studies.models.quadratic import quadratic

CLOSING = 1e-3
"""mm by which the upper block's top is pressed down."""
AMBIENT = 1.0
"""Effective concentration at the bottom of the lower block, mM; 0 at the top of the upper one."""
STEADY = Control(
    1,
    1e12 / DIFFUSIVITY,
    displacement_tolerance=1e-9,
    energy_tolerance=1e-16,
    pressure_tolerance=1e-9,
    concentration_tolerance=1e-9,
)
"""One implicit step of 1e12 diffusion times of 1 mm, which leaves 1e-12 of the initial state."""
ABOUT = """\
Patch test of the contact: two blocks of 1 mm height, whose facets do not match, in contact at z = 0.

The top is pressed down by 0.001 mm; the effective concentration is 1 mM at the bottom and 0 at the top. Displacement,
effective pressure and effective concentration are linear in z."""


@dataclass(frozen=True)
class Block:
    """One of the two blocks.

    Attributes
    ----------
    divided : tuple of int
        Elements along x and y.
    width : float
        Of its square section, mm.
    angle : float
        By which it is turned about the z axis through the middle of its section, degrees.
    wedges : bool
        Whether its elements are triangular prisms, two for each hexahedron.
    """

    divided: tuple[int, int]
    width: float = 1.0
    angle: float = 0.0
    wedges: bool = False


@dataclass(frozen=True)
class NonMatching:
    """Choices of the patch test.

    Attributes
    ----------
    lower, upper : Block
    settings : ContactSettings, optional
    held : bool
        Whether all displacements, pressures and concentrations of the lower block are given, which keeps the field
        exact where its surface is not covered.
    lower_is_primary : bool
    nodes : int
        Of a hexahedron: 8, 20 or 27; prisms have 15 instead of 6 where it is not 8.
    name : str
    """

    lower: Block
    upper: Block
    settings: ContactSettings | None = None
    held: bool = False
    lower_is_primary: bool = True
    nodes: int = 8
    interface: InterfaceType = InterfaceType.MIXTURE
    name: str = "non-matching"

    def model(self) -> Model:
        """The model of these choices."""
        mesh = _mesh(self.lower, self.upper, layers=1 if self.held else 2, lower_is_primary=self.lower_is_primary)
        if self.nodes != 8:
            mesh = quadratic(mesh, self.nodes)
        conditions = (
            fix("all", "xy"),
            fix("lower" if self.held else "lower-bottom", "z"),
            displace("upper-top", "z", -CLOSING),
            *_ambient_at("lower-bottom", AMBIENT),
            *_ambient_at("upper-top", 0.0),
            *(_ambient_at("lower-top", AMBIENT / 2) if self.held else ()),
        )
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "multiphasic",
            mesh,
            {"gel": MATERIAL},
            conditions,
            STEADY,
            contacts(self.interface, mesh, self.settings),
        )

    def exact(self, z: Nodes) -> dict[str, Nodes]:
        """The exact field at heights `z` (mm) in the undeformed state: ``uz`` (mm), ``p`` (MPa), ``c1`` (mM)."""
        c = AMBIENT * (1.0 - z) / 2.0
        uz = -CLOSING * np.clip(z, 0.0, None) if self.held else -CLOSING * (1.0 + z) / 2.0
        return {"uz": uz, "p": -GAS_CONSTANT * TEMPERATURE * c, "c1": c}


def _ambient_at(where: str, c: float) -> tuple[Condition, Condition]:
    """Given concentration without fluid pressure."""
    return concentration(where, c), pressure(where, -GAS_CONSTANT * TEMPERATURE * c)


def _mesh(lower: Block, upper: Block, *, layers: int, lower_is_primary: bool) -> Mesh:
    boxes = [_box("lower", lower, -1.0, layers), _box("upper", upper, 0.0, 2)]
    mesh = assemble(boxes)
    nodes = mesh.nodes.copy()
    sets = dict(mesh.node_sets)
    for part, block in zip(mesh.parts, (lower, upper), strict=True):
        ids = np.unique(part.elements)
        nodes[ids - 1, :2] = _turned(nodes[ids - 1, :2], block.angle)
        sets[part.name] = ids
    parts = tuple(
        _wedges(part) if block.wedges else part for part, block in zip(mesh.parts, (lower, upper), strict=True)
    )
    surfaces = {
        "lower-top": _triangles(mesh.surfaces["lower-top"]) if lower.wedges else mesh.surfaces["lower-top"],
        "upper-bottom": _triangles(mesh.surfaces["upper-bottom"]) if upper.wedges else mesh.surfaces["upper-bottom"],
    }
    pair = ("lower-top", "upper-bottom") if lower_is_primary else ("upper-bottom", "lower-top")
    return replace(mesh, nodes=nodes, parts=parts, node_sets=sets, surfaces=surfaces, pairs={"contact": pair})


def _box(name: str, block: Block, bottom: float, layers: int) -> Box:
    half = block.width / 2
    return Box(name, "gel", (-half, -half, bottom), (block.width, block.width, 1.0), (*block.divided, layers))


def _turned(plane: Nodes, degrees: float) -> Nodes:
    """Positions (n, 2) turned about the origin."""
    angle = np.radians(degrees)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return np.asarray(plane @ turn.T)


def _wedges(part: Part) -> Part:
    """Each hexahedron cut in two along the diagonals of its lower and upper face."""
    prisms = [part.elements[:, places] for places in ([0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7])]
    return replace(part, elements=np.stack(prisms, axis=1).reshape(-1, 6))


def _triangles(facets: Ids) -> Ids:
    """The facets of such prisms: a hexahedron's lower face begins at its first corner, too."""
    halves = [facets[:, places] for places in ([0, 1, 2], [0, 2, 3])]
    return np.asarray(np.stack(halves, axis=1).reshape(-1, 3), dtype=np.int64)


_LARGE, _TURNED = Block((5, 5), width=2.0), Block((3, 3), angle=30.0)
PATCHES = {
    **{f"{a} to {b}": NonMatching(Block((a, a)), Block((b, b))) for a, b in ((2, 3), (3, 4), (4, 3), (7, 5))},
    "triangles to quadrilaterals": NonMatching(Block((3, 3), wedges=True), Block((2, 2))),
    "quadrilaterals to triangles": NonMatching(Block((3, 3)), Block((2, 2), wedges=True)),
    "triangles": NonMatching(Block((3, 3), wedges=True), Block((4, 4), wedges=True)),
    "partly covered": NonMatching(Block((5, 5), width=1.5), Block((3, 3)), held=True),
    "turned, partly covered": NonMatching(_LARGE, _TURNED, held=True),
    "turned, fully covered": NonMatching(_LARGE, _TURNED, held=True, lower_is_primary=False),
}
"""Linear facets of both kinds that do not match, turned, and covered in part."""

_COARSE, _FEW = Block((3, 3), width=2.0), Block((2, 2), angle=30.0)
_PRISMS = replace(_COARSE, wedges=True), replace(_FEW, wedges=True)
QUADRATIC_PATCHES = {
    "hex20, turned, partly covered": NonMatching(_COARSE, _FEW, held=True, nodes=20),
    "hex27, turned, partly covered": NonMatching(_COARSE, _FEW, held=True, nodes=27),
    "penta15, turned, partly covered": NonMatching(*_PRISMS, held=True, nodes=20),
    "hex20, 2 to 3": NonMatching(Block((2, 2)), Block((3, 3)), nodes=20),
}
"""Quadratic facets, turned, and covered in part."""
