"""Bodies with random shapes, meshes, materials, contacts, loads and solvers, from seeds."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import pairwise
from typing import TypeVar

import numpy as np

from harness.models.mesh import Nodes
from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported import words
from studies.synthetic_scenes.reported.shapes import Shape, arc, ball, box, mapped, shell
from studies.synthetic_scenes.reported.sketch import Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import Material

Value = TypeVar("Value")
SEEDS = 1000  # how many scenes there are
LINEAR, QUADRATIC = ("hex8", "tet4", "penta6"), ("hex20", "hex27", "tet10", "tet15", "penta15")
POROUS_ELEMENTS = ("hex8", "hex20", "hex27", "tet10", "tet15")
PRESSURE_ONLY = ("sliding-facet-on-facet", "sliding-biphasic-solute")  # FEBio's types without friction
RELIEFS: Mapping[str, Callable[[Nodes], Nodes]] = {
    "flat": lambda u: 0.0 * u[..., 0],
    "roll": lambda u: u[..., 0] ** 2,
    "dome": lambda u: u[..., 0] ** 2 + u[..., 1] ** 2,
    "saddle": lambda u: u[..., 0] ** 2 - u[..., 1] ** 2,
    "roof": lambda u: np.abs(u[..., 0]),
    "wave": lambda u: 0.5 * np.sin(np.pi * u[..., 0]),
    "lean": lambda u: 0.3 * u[..., 0],
}
"""Heights of a surface by name, for positions (..., 2) from -1 to 1."""
GRID = np.stack(np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41)), axis=-1)


class Draw:
    """Random choices of a seed."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)

    def pick(self, values: Sequence[Value]) -> Value:
        """One of some values."""
        return values[int(self._random.integers(len(values)))]

    def chance(self, probability: float) -> bool:
        """True with a probability."""
        return bool(self._random.random() < probability)

    def between(self, low: float, high: float) -> float:
        """A number between two others."""
        return float(self._random.uniform(low, high))

    def power(self, low: float, high: float) -> float:
        """A power of ten with an exponent between two numbers."""
        return float(10.0 ** self.between(low, high))


# ------------------------------------------------------------ bodies


@dataclass(frozen=True)
class Block:
    """A block with a curved face on its top or at its bottom."""

    # Mm.
    length: float
    width: float
    height: float
    relief: str
    rise: float  # the face rises by this times the relief, mm
    is_below: bool  # whether the face is on top of the block
    lift: float = 0.0  # by how much the block is higher than with its face around z = 0, mm

    def face(self, points: Nodes) -> Nodes:
        """Heights of the face at positions (..., 2), mm; those of a block below are negative, the others positive."""
        relief = RELIEFS[self.relief]
        heights = relief(2.0 * points / (self.length, self.width)) - relief(GRID).min()
        return np.asarray(self.lift + (-self.rise if self.is_below else self.rise) * heights)

    def place(self, u: Nodes) -> Nodes:
        """The map of the unit cube."""
        across = (u[:, :2] - 0.5) * (self.length, self.width)
        far = self.lift + (-self.height if self.is_below else self.height)
        to_face = u[:, 2] if self.is_below else 1.0 - u[:, 2]
        return np.column_stack([across, far + to_face * (self.face(across) - far)])

    def on(self, below: "Block", gap: float) -> "Block":
        """The block put on another with a gap, mm."""
        least = np.minimum((self.length, self.width), (below.length, below.width))
        points = 0.5 * GRID * least
        return replace(self, lift=gap - float((self.face(points) - below.face(points)).min()))

    def mesh(self, draw: Draw, element: str) -> Shape:
        """The block in elements of about the same size in all directions."""
        size = np.array([self.length, self.width, self.height])
        along = draw.between(5.0, 9.0) if element in LINEAR else draw.between(3.0, 5.0)
        cells = np.maximum(np.round(along * size / size.max()), (2, 2, 1)).astype(int)
        return mapped(tuple(cells.tolist()), self.place, element)


def _block(draw: Draw, *, is_below: bool) -> Block:
    length, height = draw.between(1.2, 3.0), draw.between(0.5, 1.2)
    relief, rise = draw.pick(list(RELIEFS)), draw.between(0.05, 0.25) * height
    return Block(length, length * draw.between(0.5, 1.0), height, relief, rise, is_below)


def _blocks(draw: Draw) -> tuple[Block, Block]:
    """A block and one on it, with a gap or a slight overlap."""
    low = _block(draw, is_below=True)
    return low, _block(draw, is_below=False).on(low, draw.pick([0.0, 0.005, 0.02, -0.002]))


def _element(draw: Draw) -> str:
    return draw.pick(LINEAR if draw.chance(0.6) else QUADRATIC)


def _elastic(draw: Draw) -> Material:
    stiff, ratio = 2.0 ** draw.between(-1.5, 1.5), draw.between(0.0, 0.49)
    bulk = draw.power(0.7, 2.0)
    return draw.pick(
        [words.neo(stiff, ratio), words.mooney(0.2 * stiff, 0.05, bulk), words.ogden(0.3 * stiff, 4.0, bulk)]
    )


def _porous(draw: Draw, make: Callable[[float, float, float], Material]) -> Material:
    return make(2.0 ** draw.between(-1.0, 1.0), draw.between(0.0, 0.4), draw.power(-3.0, -1.0))


# ------------------------------------------------------------ contacts and solvers


def _parameters(draw: Draw, kind: str) -> str:
    """Enforcement and penalties as users set them."""
    further = words.TWO_PASS if draw.chance(0.3) else ""
    if kind not in PRESSURE_ONLY and draw.chance(0.3):
        further += words.friction(draw.between(0.05, 0.5))
    if draw.chance(0.3):
        further += words.radius(draw.between(0.2, 1.5))
    if draw.chance(0.7):
        return words.auto(draw.power(-1.0, 1.3), further)
    return words.auglag(draw.power(-1.0, 1.0), draw.pick([0.2, 0.1, 0.05, 0.02]), further)


def _scheme(draw: Draw, *, later: bool = False) -> Scheme:
    """Full Newton iterations or updates between matrices; `later`: for conditions that last 2 s."""
    method, updates = draw.pick([("BFGS", 0), ("BFGS", 0), ("BFGS", 10), ("Broyden", 10)])
    steps = draw.pick([5, 10, 10, 20])
    return Scheme(2 * steps if later else steps, 1.0 / steps, method=method, updates=updates)


def _sides(draw: Draw, one: str, other: str) -> tuple[str, str]:
    return (one, other) if draw.chance(0.5) else (other, one)


# ------------------------------------------------------------ scenes


def _pressed(draw: Draw) -> Sketch:
    """A block on another, one of them rigid or both deformable, moved or loaded, and slid or turned afterwards."""
    low, high = _blocks(draw)
    bodies = {"low": low.mesh(draw, _element(draw)), "high": high.mesh(draw, _element(draw))}
    materials = {"low": _elastic(draw), "high": _elastic(draw)}
    depth = draw.between(0.03, 0.25) * min(low.height, high.height)
    slide = draw.between(0.1, 0.5) * high.length if draw.chance(0.35) else 0.0
    kind = draw.pick(["sliding-elastic", "sliding-elastic", "sliding-facet-on-facet", "sliding-node-on-facet"])
    drive = [fixed("high-z1", "y"), moved("high-z1", "x", slide, 2), moved("high-z1", "z", -depth)]
    sides = _sides(draw, "high-z0", "low-z1")
    turn = 0.0
    if draw.chance(0.35):
        materials["high"] = words.rigid((0.0, 0.0, high.lift + high.height / 2.0))
        turn = draw.between(0.3, 1.5) if draw.chance(0.3) else 0.0
        held = words.hold("high", "yuv" if turn else "yuvw")
        drive = [held, words.shift("high", "x", slide, 2), words.shift("high", "z", -depth)]
        drive += [words.spin("high", "w", turn, 2)] if turn else []
        sides = ("low-z1", "high-z0")
    scheme = _scheme(draw, later=slide > 0.0 or turn > 0.0)
    touch = Touch(*sides, kind=kind, params=_parameters(draw, kind))
    return Sketch(bodies, materials, (touch,), (fixed("low-z0"), *drive), scheme)


def _soaked(draw: Draw) -> Sketch:
    """Porous blocks, with a solute or without, pressed and slid."""
    has_solute = draw.chance(0.35)
    low, high = _blocks(draw)
    blocks = {"low": low, "high": high}
    bodies = {name: block.mesh(draw, draw.pick(POROUS_ELEMENTS)) for name, block in blocks.items()}
    make = words.with_solute if has_solute else words.biphasic
    kinds = ["sliding-multiphasic", "sliding-biphasic-solute"] if has_solute else ["sliding-biphasic"]
    kind = draw.pick(kinds)
    depth = draw.between(0.03, 0.2) * min(low.height, high.height)
    slide = draw.between(0.1, 0.5) * high.length if draw.chance(0.35) else 0.0
    conditions = [
        fixed("low-z0"),
        fixed("high-z1", "y"),
        moved("high-z1", "x", slide, 2),
        moved("high-z1", "z", -depth),
        *(words.drained(nodes) for nodes in ("low-z0", "high-z1") if draw.chance(0.6)),
        *((words.concentration("low-z0", 1.0),) if has_solute else ()),
    ]
    penalties = words.fluid(1.0, 1.0 if has_solute else 0.0)
    touch = Touch(*_sides(draw, "high-z0", "low-z1"), kind=kind, params=_parameters(draw, kind) + penalties)
    return Sketch(
        bodies,
        {name: _porous(draw, make) for name in blocks},
        (touch,),
        conditions,
        replace(_scheme(draw, later=slide > 0.0), analysis="TRANSIENT"),
        "multiphasic" if has_solute else "biphasic",
        words.SOLUTE if has_solute else "",
    )


def _layers(draw: Draw) -> Sketch:
    names = [f"layer{n}" for n in range(draw.pick([3, 4]))]
    bodies: dict[str, Shape] = {}
    at = 0.0
    for name in names:
        height, half = draw.between(0.3, 0.7), draw.between(0.8, 1.2)
        element = _element(draw)
        cells = (6, 3, 2) if element in LINEAR else (4, 2, 1)
        bodies[name] = mapped(cells, box((-half, -half / 2, at), (half, half / 2, at + height)), element)
        at += height
    kind = draw.pick(["sliding-elastic", "sliding-facet-on-facet"])
    parameters, top = _parameters(draw, kind), f"{names[-1]}-z1"
    held = [fixed("layer0-z0"), fixed(top, "x", "y"), *(fixed(f"{name}-x0", "x", "y") for name in names[1:-1])]
    pairs = tuple(Touch(f"{above}-z0", f"{below}-z1", kind, parameters) for below, above in pairwise(names))
    drive = moved(top, "z", -draw.between(0.05, 0.25))
    return Sketch(bodies, {name: _elastic(draw) for name in names}, pairs, (*held, drive), _scheme(draw))


def _tubes(draw: Draw) -> Sketch:
    """A quarter of a tube that a pressure presses against a tube around it."""
    gap, inner, first, second = draw.pick([0.0, 0.02, 0.05]), *(draw.between(0.2, 0.5) for _ in range(3))
    radii = {"in": (0.5 + inner, first), "out": (0.5 + inner + first + gap, second)}
    bodies = {}
    for name, (radius, thickness) in radii.items():
        element = _element(draw)
        cells = (2, draw.pick([4, 5, 6]), 3) if element in LINEAR else (1, draw.pick([3, 4]), 2)
        bodies[name] = mapped(cells, arc(radius, radius + thickness, 1.0, (0.0, 90.0)), element)
    kind = draw.pick(["sliding-elastic", "sliding-facet-on-facet"])
    held = [fixed(f"{body}-{side}", dof) for body in bodies for side, dof in (("y0", "y"), ("y1", "x"), ("z0", "z"))]
    touch = Touch(*_sides(draw, "in-x1", "out-x0"), kind=kind, params=_parameters(draw, kind))
    conditions = (*held, words.press("in-x0", draw.between(0.02, 0.12)))
    return Sketch(bodies, {name: _elastic(draw) for name in bodies}, (touch,), conditions, _scheme(draw))


def _indented(draw: Draw) -> Sketch:
    """A rigid ball that is moved into a slab or into a plate of shells with held edges, and slides."""
    is_sheet, half = draw.chance(0.4), draw.between(1.0, 1.6)
    target = (
        shell((8, 8), box((-half, -half, 0), (half, half, 0)), draw.between(0.04, 0.15), draw.pick(["quad4", "tri3"]))
        if is_sheet
        else mapped((8, 8, 3), box((-half, -half, -0.8), (half, half, 0)), draw.pick(LINEAR))
    )
    sphere = mapped((5, 5, 5), ball(draw.between(0.4, 0.8), 0.95))
    up = 0.005 - float(sphere.nodes[:, 2].min())
    bodies = {"target": target, "ball": replace(sphere, nodes=np.add(sphere.nodes, (0.0, 0.0, up)))}
    edges = [f"target-{side}" for side in (("x0", "x1", "y0", "y1") if is_sheet else ("z0",))]
    slide = draw.between(0.1, 0.5) if draw.chance(0.4) else 0.0
    drive = [words.hold("ball", "yuvw"), words.shift("ball", "z", -draw.between(0.05, 0.25))]
    kind = draw.pick(["sliding-elastic", "sliding-facet-on-facet"])
    touch = Touch("target-face" if is_sheet else "target-z1", "ball-outside", kind, _parameters(draw, kind))
    return Sketch(
        bodies,
        {"target": _elastic(draw), "ball": words.rigid((0.0, 0.0, up))},
        (touch,),
        (*(fixed(edge) for edge in edges), *drive, words.shift("ball", "x", slide, 2)),
        _scheme(draw, later=slide > 0.0),
    )


FAMILIES = (*[_pressed] * 4, *[_soaked] * 3, _layers, _tubes, _indented, _indented)
"""How often a kind of scene is drawn."""


@lru_cache(maxsize=4)
def _sketch(seed: int) -> Sketch:
    draw = Draw(seed)
    return draw.pick(FAMILIES)(draw)


SCENES: Mapping[str, Drawn] = {
    f"seed-{seed:03d}": Drawn("random bodies", partial(_sketch, seed)) for seed in range(SEEDS)
}
"""By name."""
