"""Pairs of models of one scene: contact between whole outsides of bodies, and between the sides alone that face.

Bodies are boxes of hex8 that are bent into shape. What a surface holds beside the facing sides must not change a
result.
Numbers are in mm, N, s.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from studies.models.small import Document, Parts, biphasic, contact, control, curve, elastic, fixed, moved, rigid

Facets = list[tuple[int, ...]]
Bend = Callable[[np.ndarray], np.ndarray]
"""Positions of nodes, shape (n, 3), after it."""
SEALED = "<free_draining>0</free_draining>"
"""Else sides that face nothing have the ambient pressure where they are in the surface, and are sealed where not."""


@dataclass(frozen=True)
class Box:
    """A part of a body; its side `facing` is the one that touches, `held` the one that is moved or fixed.

    Attributes
    ----------
    cut : sequence of boxes (low, high)
        What is missing from it.
    bend : callable
        Moves its nodes.
    """

    low: Sequence[float]
    high: Sequence[float]
    cells: Sequence[int]
    facing: str
    held: str
    cut: Sequence[tuple[Sequence[float], Sequence[float]]] = ()
    bend: Bend | None = None
    facing_at: tuple[int, float] | None = None
    """Of a body that is cut: axis and place of the plane that its facing side lies in."""
    shell: float = 0.0
    """Not a box but a plate of shells, this thick, over the unit square at z = 0, of which all nodes are held."""
    facing_down: float = 0.0
    """Of a body that is bent: the facing side is all that looks down by at least this cosine."""


@dataclass(frozen=True)
class FacingScene:
    """Two boxes, the upper of which is moved; a displacement and what the contact is given.

    Attributes
    ----------
    upper, lower : Box
    travel : float
        Of the upper one along z.
    upper_primary : bool
    porous : bool
    rigid_lower : bool
    params : str
        Of the contact.
    steps : int
    """

    upper: Box
    lower: Box
    travel: float
    upper_primary: bool = True
    porous: bool = False
    rigid_lower: bool = False
    params: str = ""
    steps: int = 2

    def document(self, *, whole: bool) -> Document:
        """The model with whole outsides, or with the facing sides alone."""
        parts = self._parts()
        pair = ["up", "low"] if self.upper_primary else ["low", "up"]
        kind = "whole" if whole else "facing"
        return Document(
            parts.mesh({"pair": (f"{pair[0]}-{kind}", f"{pair[1]}-{kind}")}),
            self._materials(),
            module="biphasic" if self.porous else "solid",
            control=_tight(self.porous, self.steps),
            boundary=self._boundary(),
            rigid=(_held_rigid("low"),) if self.rigid_lower else (),
            contacts=(contact("c", "pair", params=self.params + (SEALED if self.porous else "")),),
            curves=(curve(1, (0, 0), (1, 1)),),
            node_data="Rx;Ry;Rz;ux;uy;uz" + (";p" if self.porous else ""),
        )

    def force(self, nodes: np.ndarray) -> np.ndarray:
        """The force that moves the upper one (N), from the last data of `nodes.txt`."""
        held = [n - 1 for n in self._parts().node_sets["up-held"]]
        return np.asarray(nodes[held, :3].sum(axis=0))

    def _parts(self) -> Parts:
        parts = Parts()
        for name, box in (("low", self.lower), ("up", self.upper)):
            _add(parts, name, box)
        return parts

    def _materials(self) -> tuple[str, ...]:
        of = biphasic if self.porous else elastic
        return (rigid("low", 1) if self.rigid_lower else of("low", 1, 10.0), of("up", 2, 10.0))

    def _boundary(self) -> tuple[str, ...]:
        held_below = () if self.rigid_lower else (fixed("low-held", "x", "y", "z"),)
        drained = ('<bc type="zero fluid pressure" node_set="up-held"/>',) if self.porous else ()
        return (*held_below, fixed("up-held", "x", "y"), moved("up-held", "z", self.travel), *drained)


def _held_rigid(name: str) -> str:
    inner = "".join(f"<{dof}_dof>1</{dof}_dof>" for dof in ("Rx", "Ry", "Rz", "Ru", "Rv", "Rw"))
    return f'<rigid_bc name="hold-{name}" type="rigid_fixed"><rb>{name}</rb>{inner}</rigid_bc>'


def _tight(porous: bool, steps: int) -> str:
    scheme = control(
        "biphasic" if porous else "solid", steps, 1.0 / steps, retries=5, analysis="TRANSIENT" if porous else "STATIC"
    )
    return scheme.replace("<max_refs>", "<dtol>1e-7</dtol><rtol>1e-12</rtol><max_refs>")


def _add(parts: Parts, name: str, box: Box) -> None:
    """A box with the surfaces `name`-whole and `name`-facing and the node set `name`-held."""
    if box.shell > 0:
        parts.plate(name, name, 0.0, box.shell, faces_up=False)
        parts.surfaces |= {f"{name}-{kind}": parts.surfaces[name] for kind in ("whole", "facing")}
        parts.node_sets[f"{name}-held"] = parts.node_sets[name]
        return
    parts.box(name, box.low, box.high, box.cells, name)
    for low, high in box.cut:
        parts.cut_out(name, low, high)
    outside = parts.outside(name)
    facing = parts.surfaces[f"{name}-{box.facing}"]
    if box.facing_at:
        facing = parts.facets_in(outside, *box.facing_at)
    held = parts.node_sets[f"{name}-{box.held}"]
    for side in ("bottom", "top", "front", "right", "back", "left"):
        parts.surfaces.pop(f"{name}-{side}")
        parts.node_sets.pop(f"{name}-{side}")
    parts.node_sets[f"{name}-held"] = held
    if box.bend is not None:
        _bend(parts, name, box.bend)
    if box.facing_down > 0:
        facing = [facet for facet in outside if _downwards(parts, facet) >= box.facing_down]
    parts.surfaces |= {f"{name}-whole": outside, f"{name}-facing": facing}


def _bend(parts: Parts, name: str, bend: Bend) -> None:
    own = sorted({n for part in parts.parts if part.name == name for ids in part.elements for n in ids})
    bent = bend(np.array([parts.nodes[n - 1] for n in own]))
    for n, x in zip(own, bent.tolist(), strict=True):
        parts.nodes[n - 1] = tuple(x)


def _downwards(parts: Parts, facet: tuple[int, ...]) -> float:
    """Cosine between the outward normal of a facet and -z."""
    x = np.array([parts.nodes[n - 1] for n in facet])
    area = np.cross(x[2] - x[0], x[3] - x[1])
    return float(-area[2] / np.linalg.norm(area))


# ------------------------------------------------------------ bends


def leaning(lean: float) -> Bend:
    """Sides along x and y that lean outwards from z = 0 on, by this part of the height."""

    def bend(x: np.ndarray) -> np.ndarray:
        wider = 1.0 + lean * np.maximum(x[:, 2:], 0.0)
        return np.hstack([x[:, :2] * wider, x[:, 2:]])

    return bend


def rounded(radius: float, half: float) -> Bend:
    """The edges of the face z = 0, at x = -half and half, rounded."""

    def bend(x: np.ndarray) -> np.ndarray:
        beyond = np.clip((np.abs(x[:, 0]) - (half - radius)) / radius, 0.0, 1.0)
        lift = radius * (1.0 - np.sqrt(1.0 - beyond**2)) if radius else 0.0 * beyond
        height = x[:, 2].max()
        return np.column_stack([x[:, 0], x[:, 1], x[:, 2] + lift * (1.0 - x[:, 2] / height)])

    return bend


def tapered(rim: float) -> Bend:
    """A plate that is as thin as this part of its thickness at x = 1, from its full thickness at x = -1."""

    def bend(x: np.ndarray) -> np.ndarray:
        return np.column_stack([x[:, :2], x[:, 2] * (1.0 + (rim - 1.0) * (x[:, 0] + 1.0) / 2.0)])

    return bend


def rolled(x: np.ndarray) -> np.ndarray:
    """A strip that is rolled around the y axis: x is the angle, z the radius; it starts at the top."""
    return np.column_stack([x[:, 2] * np.sin(x[:, 0]), x[:, 1], x[:, 2] * np.cos(x[:, 0])])


# ------------------------------------------------------------ scenes

INTEGRATIONS = ("segments", "gauss")
LEANS = (0.0, 1e-3, 0.02, 0.1, 0.3)
SLAB = Box((-1.5, -1.5, -1.0), (1.5, 1.5, 0.0), (3, 3, 1), "top", "bottom")
BLOCK = Box((-1.0, -1.0, 0.0), (1.0, 1.0, 1.0), (2, 2, 2), "bottom", "top")
FINE_BLOCK = replace(BLOCK, cells=(3, 3, 2))
TURN = 2.0 * np.pi
_ROOM = 9.0


def _scenes() -> dict[str, FacingScene]:
    """By name, those of segments."""
    return {
        **{f"lean-{lean:g}": FacingScene(replace(FINE_BLOCK, bend=leaning(lean)), SLAB, -0.1) for lean in LEANS},
        **{
            f"lean-{lean:g}-of-faced": FacingScene(
                replace(FINE_BLOCK, bend=leaning(lean)), SLAB, -0.1, upper_primary=False
            )
            for lean in LEANS
        },
        **{
            f"fluid-lean-{lean:g}": FacingScene(replace(BLOCK, bend=leaning(lean)), SLAB, -0.05, porous=True)
            for lean in (0.0, 0.02, 0.3)
        },
        "layers": FacingScene(_layer(0.2, 0.0), _layer(-0.2, 0.0), -0.02),
        "layers-pressed-by-half": FacingScene(_layer(0.2, 0.0), _layer(-0.2, 0.0), -0.2, steps=4),
        "layers-uneven": FacingScene(_layer(0.02, 0.0), _layer(-1.0, 0.0), -0.02),
        "layers-from-a-gap": FacingScene(_layer(0.2, 0.0, gap=0.3), _layer(-0.2, 0.0), -0.32),
        "fluid-layers": FacingScene(_layer(0.2, 0.0), _layer(-0.2, 0.0), -0.02, porous=True),
        "ledge": FacingScene(FINE_BLOCK, _ledge(0.5), -0.1),
        "ledge-near": FacingScene(FINE_BLOCK, _ledge(0.75), -0.1),
        "table": FacingScene(FINE_BLOCK, TABLE, -0.1),
        "tray": FacingScene(FINE_BLOCK, TRAY, -0.1),
        "legs": FacingScene(LEGS, SLAB, -0.1),
        "legs-in-tray": FacingScene(LEGS, TRAY, -0.1),
        "clamp": FacingScene(FINE_BLOCK, CLAMP, -0.1),
        "fluid-clamp": FacingScene(FINE_BLOCK, CLAMP, -0.05, porous=True),
        "rounded": FacingScene(replace(ROUNDED, bend=rounded(0.4, 1.0)), SLAB, -0.1),
        "rounded-pressed": FacingScene(replace(ROUNDED, bend=rounded(0.4, 1.0)), SLAB, -0.4, steps=6),
        "rim": FacingScene(replace(PLATE, bend=tapered(0.1)), SLAB, -0.02),
        "rim-sharp": FacingScene(replace(PLATE, bend=tapered(0.01)), SLAB, -0.02),
        "rod-in-tube": FacingScene(ROD, TUBE, -0.1),
        "rod-in-thin-tube": FacingScene(ROD, replace(TUBE, high=(TURN, 0.5, 1.07)), -0.1),
        "ring-on-rod": FacingScene(replace(ROD, high=(TURN, 1.0, 1.0), cells=(16, 2, 1)), RING, -0.1),
        "layers-within-a-radius": FacingScene(
            _layer(0.2, 0.0), _layer(-0.2, 0.0), -0.02, params="<search_radius>1</search_radius>"
        ),
        "lean-0.3-pressed": FacingScene(
            replace(FINE_BLOCK, bend=leaning(0.3)), replace(SLAB, cells=(1, 1, 1)), -0.5, rigid_lower=True, steps=8
        ),
        "layer-on-bone": FacingScene(_layer(0.02, 0.0), BONE, -0.002, rigid_lower=True),
        "fluid-layer-on-bone": FacingScene(_layer(0.1, 0.0), BONE, -0.01, rigid_lower=True, porous=True),
        "shell-on-bone": FacingScene(SHELL, replace(BONE, cells=(3, 3, 4)), -0.01),
        "shell-under-bone": FacingScene(SHELL, replace(BONE, cells=(3, 3, 4)), -0.01, upper_primary=False),
        "folded-sheet": FacingScene(_layer(0.5, 0.1), SHEET, -0.02),
        "folded-sheet-faces-block": FacingScene(_layer(0.5, 0.1), SHEET, -0.02, upper_primary=False),
    }


def _layer(to: float, inset: float, gap: float = 0.0) -> Box:
    """A layer over the unit square, above (to > 0) or below z = 0."""
    low, high = (gap, gap + to) if to > 0 else (to, 0.0)
    sides = ("bottom", "top") if to > 0 else ("top", "bottom")
    return Box((inset, inset, low), (1.0 - inset, 1.0 - inset, high), (2, 2, 1), *sides)


def _ledge(depth: float) -> Box:
    """A slab whose right half lies lower."""
    return replace(SLAB, cells=(6, 3, 4), cut=(((0.5, -_ROOM, -depth), (_ROOM, _ROOM, _ROOM)),), facing_at=(2, 0.0))


TABLE = Box(
    (-1.5, -1.5, -1.0),
    (1.5, 1.5, 0.0),
    (6, 3, 4),
    "top",
    "bottom",
    cut=(((-_ROOM, -_ROOM, -0.75), (-0.5, _ROOM, _ROOM)), ((0.5, -_ROOM, -0.75), (_ROOM, _ROOM, _ROOM))),
    facing_at=(2, 0.0),
)
"""A stem on a broad foot."""
TRAY = Box(
    (-3.0, -1.5, -1.0),
    (3.0, 1.5, 1.0),
    (12, 3, 4),
    "top",
    "bottom",
    cut=(((-2.0, -_ROOM, 0.0), (2.0, _ROOM, _ROOM)),),
    facing_at=(2, 0.0),
)
LEGS = Box(
    (-1.0, -1.0, 0.0),
    (1.0, 1.0, 1.5),
    (4, 2, 3),
    "bottom",
    "top",
    cut=(((-0.5, -_ROOM, -_ROOM), (0.5, _ROOM, 1.0)),),
)
CLAMP = Box(
    (-1.5, -1.5, -1.0),
    (2.5, 1.5, 3.0),
    (8, 3, 8),
    "top",
    "bottom",
    cut=(((-_ROOM, -_ROOM, 0.0), (1.5, _ROOM, 2.5)),),
    facing_at=(2, 0.0),
)
"""A block lies on its lower arm; the outer side of its upper arm looks up as well."""
ROUNDED = Box((-1.0, -1.0, 0.0), (1.0, 1.0, 1.0), (10, 2, 2), "bottom", "top", facing_down=0.3)
PLATE = Box((-1.0, -1.0, 0.0), (1.0, 1.0, 0.3), (4, 2, 1), "bottom", "top")
ROD = Box((0.0, 0.0, 0.3), (TURN, 0.5, 1.0), (16, 1, 1), "top", "bottom", bend=rolled)
TUBE = Box((0.0, 0.0, 1.02), (TURN, 0.5, 1.3), (16, 1, 1), "bottom", "top", bend=rolled)
RING = replace(TUBE, low=(0.0, 0.25, 1.02), high=(TURN, 0.75, 1.3))
BONE = Box((-1.0, -1.0, -3.0), (2.0, 2.0, 0.0), (9, 9, 12), "top", "bottom")
SHELL = Box((), (), (), "", "", shell=0.01)
SHEET = Box(
    (0.0, 0.0, -1.0),
    (2.0, 1.0, 0.0),
    (6, 2, 5),
    "top",
    "bottom",
    cut=(((-_ROOM, -_ROOM, -0.8), (1.6, _ROOM, -0.2)),),
    facing_at=(2, 0.0),
)
"""Two leaves of 0.2 mm, joined on the right."""


PENALTIES = "<auto_penalty>0</auto_penalty><penalty>2e4</penalty><pressure_penalty>100</pressure_penalty>"
"""Automatic ones are means over all facets around a node of the edge, facing or not."""


def scenes(penalties: str = PENALTIES) -> dict[str, FacingScene]:
    """All, by name and integration."""
    return {
        f"{name}-{integration}": replace(
            scene, params=f"<integration>{integration}</integration>{penalties}{scene.params}"
        )
        for name, scene in _scenes().items()
        for integration in INTEGRATIONS
    }
