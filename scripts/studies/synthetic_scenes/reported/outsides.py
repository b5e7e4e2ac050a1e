"""Whole outsides as surfaces, edges and leans, folded sheets and bodies that touch themselves."""

from collections.abc import Mapping
from functools import partial

import numpy as np

from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported.shapes import (
    Shape,
    arc,
    box,
    grid,
    joined,
    mapped,
    sheet,
    shifted,
    turned,
    union,
    where,
)
from studies.synthetic_scenes.reported.sketch import Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import auglag, auto, hold, neo, ogden, press, radius, rigid, shift


def _several(*parts: tuple[tuple[int, int, int], tuple[float, ...], tuple[float, ...]]) -> Shape:
    """Boxes that share faces of the same mesh, as one body: cells, lowest and highest corner of each."""
    cells, lows, highs = zip(*parts, strict=True)
    return joined([grid(each) for each in cells], [box(a, b) for a, b in zip(lows, highs, strict=True)], "hex8")


def _base(shape: Shape, axis: int, value: float) -> Shape:
    return where(shape, base=lambda x: np.abs(x[..., axis] - value) < 1e-9)


def boxes(params: str = auto(5.0), element: str = "hex8", updates: int = 0, lean: float = 0.0) -> Sketch:
    """A box, whose sides may lean, is pressed into a wider one; both surfaces are whole outsides."""
    low = mapped((6, 6, 3), box((-1.5, -1.5, -1), (1.5, 1.5, 0)), element)
    upright = box((-0.8, -0.8, 0.01), (0.8, 0.8, 1.0))

    def leaning(u: np.ndarray) -> np.ndarray:
        points = upright(u)
        return np.asarray(points * np.column_stack([*[1.0 + lean * points[:, 2]] * 2, np.ones(len(u))]))

    high = mapped((5, 5, 3), leaning, element)
    return Sketch(
        {"low": low, "high": high},
        {"low": neo(1.0), "high": neo(2.0)},
        (Touch("high-outside", "low-outside", params=params),),
        (fixed("low-z0"), fixed("high-z1", "x", "y"), moved("high-z1", "z", -0.2)),
        Scheme(updates=updates),
    )


def plate_on_slab(further: str = "") -> Sketch:
    """A plate a tenth of its width thick lies on a slab under a pressure; both surfaces are whole outsides."""
    return Sketch(
        {
            "slab": mapped((6, 6, 2), box((-1.5, -1.5, -1), (1.5, 1.5, 0))),
            "plate": mapped((7, 7, 1), box((-1, -1, -0.005), (1, 1, 0.1))),
        },
        {"slab": neo(1.0), "plate": neo(5.0)},
        (Touch("plate-outside", "slab-outside", params=auto(1.0, further)),),
        (fixed("slab-z0"), fixed("plate-x0", "x"), fixed("plate-y0", "y"), press("plate-z1", 0.02)),
    )


def corner(sides: tuple[str, str]) -> Sketch:
    """A block is pushed into the inner corner of an L, on both of whose arms it then bears."""
    angle = _several(
        ((2, 4, 2), (-1, 0, -1), (0, 1, 0)),
        ((6, 4, 2), (0, 0, -1), (2.4, 1, 0)),
        ((2, 4, 6), (-1, 0, 0), (0, 1, 2.4)),
    )
    angle = union(_base(where(angle, left=lambda x: x[..., 0] < -1 + 1e-9), 2, -1.0), "held", "left", "base")
    bottom = where(angle, inner=lambda x: (np.abs(x[..., 2]) < 1e-9) & (x[..., 0] > -1e-9))
    angle = where(bottom, wall=lambda x: (np.abs(x[..., 0]) < 1e-9) & (x[..., 2] > -1e-9))
    angle = union(angle, "arms", "inner", "wall")
    block = union(mapped((5, 3, 5), box((0.02, 0.1, 0.02), (1.5, 0.9, 1.5))), "faces", "x0", "z0")
    block = union(block, "driven", "x1", "z1")
    return Sketch(
        {"angle": angle, "block": block},
        {"angle": neo(1.0), "block": neo(1.0)},
        (Touch(f"block-{sides[0]}", f"angle-{sides[1]}", params=auto(5.0, radius(0.3))),),
        (
            fixed("angle-held"),
            fixed("block-driven", "y"),
            moved("block-driven", "x", -0.15),
            moved("block-driven", "z", -0.15),
        ),
    )


def clip() -> Sketch:
    """A plate is pushed sideways between the arms of a U, whose whole outside is the surface; it bears on one arm."""
    fork = _several(
        ((2, 3, 2), (0, 0, -0.5), (1, 1, 0)),
        ((8, 3, 2), (1, 0, -0.5), (4, 1, 0)),
        ((2, 3, 2), (0, 0, 0), (1, 1, 0.4)),
        ((2, 3, 2), (0, 0, 0.4), (1, 1, 0.9)),
        ((8, 3, 2), (1, 0, 0.4), (4, 1, 0.9)),
    )
    fork = _base(fork, 0, 0.0)
    plate = mapped((7, 2, 1), box((2.0, 0.1, 0.05), (4.6, 0.9, 0.35)))
    return Sketch(
        {"fork": fork, "plate": plate},
        {"fork": neo(2.0), "plate": neo(2.0)},
        (Touch("plate-outside", "fork-outside", params=auto(1.0, radius(0.3))),),
        (fixed("fork-base"), fixed("plate-x1", "x", "y"), moved("plate-x1", "z", 0.3)),
    )


def wedge_between(params: str = auto(1.0, radius(0.3))) -> Sketch:
    """A wedge, its whole outside a surface of two contacts, between a block and a slab: a meniscus in section."""

    def thin(u: np.ndarray) -> np.ndarray:
        x = 0.3 + 1.2 * u[:, 0]
        half = 0.05 + 0.2 * u[:, 0]
        return np.column_stack([x, u[:, 1], (2.0 * u[:, 2] - 1.0) * half])

    def over(u: np.ndarray) -> np.ndarray:
        x = 2.0 * u[:, 0]
        face = 0.02 + np.maximum(0.0, 0.05 + 0.2 * (x - 0.3) / 1.2)
        return np.column_stack([x, u[:, 1], face + u[:, 2] * (1.2 - face)])

    return Sketch(
        {
            "slab": mapped((8, 3, 2), box((0, 0, -1.2), (2, 1, -0.27))),
            "wedge": mapped((8, 3, 2), thin),
            "block": mapped((7, 3, 3), over),
        },
        {"slab": neo(1.0), "wedge": neo(3.0, 0.1), "block": neo(1.0)},
        tuple(Touch("wedge-outside", f"{body}-outside", params=params) for body in ("slab", "block")),
        (
            fixed("slab-z0"),
            fixed("block-z1", "x", "y"),
            moved("block-z1", "z", -0.15),
            fixed("wedge-x1", "x", "y"),
            *(fixed(f"wedge-{side}", "y") for side in ("y0", "y1")),
        ),
    )


def edge_down(degrees: float, side: str = "z1", params: str = auto(1.0)) -> Sketch:
    """A turned box is pressed with its edge into a slab."""
    high = shifted(turned(box((-0.6, -0.8, -0.6), (0.6, 0.8, 0.6)), "y", degrees), (0, 0, 0.01))
    rise = 0.6 * (np.cos(np.radians(degrees)) + np.sin(np.radians(degrees)))
    return Sketch(
        {
            "slab": mapped((8, 5, 3), box((-1.5, -1, -1.2), (1.5, 1, 0))),
            "box": mapped((4, 4, 4), shifted(high, (0, 0, rise))),
        },
        {"slab": neo(1.0), "box": rigid((0, 0, 0.01 + rise))},
        (Touch(f"slab-{side}", "box-outside", params=params),),
        (fixed("slab-z0"), hold("box", "xyuvw"), shift("box", "z", -0.25)),
    )


def _u(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A sheet that turns back: 2 mm, a half circle of radius 0.35 mm, and 2 mm."""
    bend = 0.35 * np.pi
    way = s * (4.0 + bend)
    turn = np.clip((way - 2.0) / 0.35, 0.0, np.pi)
    before, after = np.minimum(way, 2.0), np.maximum(way - 2.0 - bend, 0.0)
    x = before + 0.35 * np.sin(turn) - after
    z = 0.35 * (1.0 - np.cos(turn))
    return np.column_stack([x, z]), np.column_stack([-np.sin(turn), np.cos(turn)])


def _s(s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A wave of two turns."""
    phase = 2.0 * np.pi * s
    points = np.column_stack([0.9 * np.sin(phase), 2.4 * s])
    slope = np.column_stack([0.9 * 2 * np.pi * np.cos(phase), np.full_like(s, 2.4)])
    slope /= np.linalg.norm(slope, axis=1)[:, None]
    return points, np.column_stack([-slope[:, 1], slope[:, 0]])


def fold(
    element: str = "hex8", side: str = "z1", params: str = auto(1.0, radius(0.4)), updates: int = 0, depth: float = 0.6
) -> Sketch:
    """A sheet like a U is pressed flat until its arms touch."""
    return Sketch(
        {"sheet": mapped((28, 3, 1 if element == "hex20" else 2), sheet(_u, 0.6, 0.25), element)},
        {"sheet": neo(1.0)},
        (Touch(f"sheet-{side}", f"sheet-{side}", params=params),),
        (fixed("sheet-x0"), fixed("sheet-x1", "x", "y"), moved("sheet-x1", "z", -depth)),
        Scheme(updates=updates),
    )


def wave() -> Sketch:
    """A wavy sheet is pushed together until its turns touch."""
    return Sketch(
        {"sheet": mapped((36, 2, 1), sheet(_s, 0.5, 0.2))},
        {"sheet": neo(1.0, 0.2)},
        (Touch("sheet-outside", "sheet-outside", params=auto(1.0, radius(0.15))),),
        (
            fixed("sheet-x0"),
            fixed("sheet-x1", "x", "y"),
            *(fixed(f"sheet-{side}", "y") for side in ("y0", "y1")),
            moved("sheet-x1", "z", -1.6),
        ),
        Scheme(20, 0.05),
    )


def ring_between_plates(*, inner: bool) -> Sketch:
    """A ring is squashed between rigid plates until its inside touches itself; half of it, plane strain."""
    params = auto(1.0, radius(0.3))
    ring = mapped((2, 20, 1), turned(arc(0.75, 1.0, 0.3, (-90.0, 90.0)), "x", 90.0))
    touching = (Touch("ring-x0", "ring-x0", params=params),) if inner else ()
    return Sketch(
        {
            "ring": ring,
            "low": mapped((1, 1, 1), box((-0.2, -0.3, -1.3), (2.2, 0.3, -1.01))),
            "high": mapped((1, 1, 1), box((-0.2, -0.3, 1.01), (2.2, 0.3, 1.3))),
        },
        {"ring": ogden(0.3, 2.0, 20.0), "low": rigid((1, 0, -1.15)), "high": rigid((1, 0, 1.15))},
        (Touch("ring-x1", "low-z1", params=params), Touch("ring-x1", "high-z0", params=params), *touching),
        (
            *(fixed(f"ring-{side}", "x") for side in ("y0", "y1")),
            *(fixed(f"ring-{side}", "y") for side in ("z0", "z1")),
            *(hold(plate, "xyuvw") for plate in ("low", "high")),
            shift("low", "z", 0.65 if inner else 0.4),
            shift("high", "z", -0.65 if inner else -0.4),
        ),
        Scheme(20, 0.05),
    )


SCENES: Mapping[str, Drawn] = {
    "outsides-boxes": Drawn("a box on a box, whole outsides", boxes),
    "outsides-boxes-tet4-bfgs": Drawn(
        "a box on a box of tet4, whole outsides, BFGS", partial(boxes, element="tet4", updates=10)
    ),
    "outsides-boxes-lean": Drawn(
        "a box whose sides are inclined by a twentieth towards the other body, whole outsides",
        partial(boxes, lean=0.05),
    ),
    "outsides-boxes-augmented": Drawn(
        "a box with inclined sides, whole outsides, AUGLAG with a small penalty", partial(boxes, auglag(0.2), lean=0.02)
    ),
    "outsides-plate-on-slab": Drawn("a thin plate on a slab, whole outsides", plate_on_slab),
    "outsides-plate-on-slab-near": Drawn(
        "a thin plate on a slab, whole outsides, a search radius of three thicknesses",
        partial(plate_on_slab, radius(0.3)),
    ),
    "corner": Drawn("a block in the corner of an L", partial(corner, ("faces", "arms"))),
    "corner-outsides": Drawn("a block in the corner of an L, whole outsides", partial(corner, ("outside", "outside"))),
    "clip-outsides": Drawn("a plate between the arms of a U, whole outsides", clip),
    "wedge-outsides": Drawn("a wedge between two bodies, whole outsides, two contacts", wedge_between),
    "edge-down": Drawn("the edge of a rigid box is pressed into a slab", partial(edge_down, 45.0)),
    "edge-down-slight": Drawn("a rigid box that is tilted by five degrees", partial(edge_down, 5.0)),
    "edge-down-outsides": Drawn(
        "the edge of a rigid box is pressed into a slab, whole outsides",
        partial(edge_down, 30.0, "outside", auto(1.0, radius(0.5))),
    ),
    "fold": Drawn("a U is pressed flat, self-contact of its inside", fold),
    "fold-outside": Drawn(
        "a U is pressed flat, self-contact of its whole outside",
        partial(fold, side="outside", params=auto(0.3, radius(0.2)), depth=0.52),
    ),
    "fold-hex20-bfgs": Drawn("a U of hex20 is pressed flat, BFGS", partial(fold, "hex20", updates=10)),
    "fold-tet4": Drawn("a U of tet4 is pressed flat", partial(fold, "tet4", depth=0.52)),
    "wave": Drawn("a wavy sheet is pushed together", wave),
    "ring-between-plates": Drawn("a ring between rigid plates", partial(ring_between_plates, inner=False)),
    "ring-between-plates-closes": Drawn(
        "a ring between rigid plates until its inside touches itself", partial(ring_between_plates, inner=True)
    ),
}
