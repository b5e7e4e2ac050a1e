"""Hyperelastic blocks, cylinders in grooves, rods in tubes and crossed tubes, pressed or sliding; every element."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial

from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported.shapes import arc, box, bulged, mapped, shifted, turned
from studies.synthetic_scenes.reported.sketch import Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import (
    TWO_PASS,
    Material,
    auglag,
    auto,
    biphasic,
    drained,
    fluid,
    friction,
    given,
    hold,
    mooney,
    neo,
    ogden,
    press,
    push,
    radius,
    rigid,
)

NEAR = radius(0.3)
USUALLY = auto(1.0, NEAR)  # parameters of a contact of tubes that a scene does not say otherwise
BFGS = Scheme(20, updates=10)


@dataclass(frozen=True)
class Blocks:
    """A block with a flat or a slightly curved lower face is pressed into a longer one, and slides."""

    material: Material = field(default_factory=neo)
    params: str = auto(1.0)
    element: str = "hex8"
    scheme: Scheme = Scheme(20)
    way: float = 0.5
    round_face: float = 0.0
    back: bool = False

    def __call__(self) -> Sketch:
        quadratic = self.element in ("hex20", "hex27", "tet10", "tet15", "penta15")
        low, high = ((6, 3, 2), (4, 2, 2)) if quadratic else ((10, 4, 3), (7, 3, 3))
        above = bulged(box((-0.8, -0.4, 0.01), (0.8, 0.4, 0.9)), lambda x: self.round_face * x[:, 0] ** 2)
        return Sketch(
            {
                "low": mapped(low, box((-1.6, -0.5, -0.8), (1.8, 0.5, 0.0)), self.element),
                "high": mapped(high, above, self.element),
            },
            {"low": self.material, "high": self.material},
            (Touch("high-z0", "low-z1", params=self.params),),
            (
                fixed("low-z0"),
                fixed("high-z1", "y"),
                moved("high-z1", "z", -0.12),
                moved("high-z1", "x", self.way, 3 if self.back else 2),
            ),
            Scheme(30) if self.back else self.scheme,
        )


@dataclass(frozen=True)
class Groove:
    """A cylinder is pressed into a groove of a radius a tenth larger, and turns or slides along it."""

    params: str
    element: str = "hex8"
    kind: str = "sliding-elastic"
    porous: bool = False
    slides: bool = False
    updates: int = 0
    primary: str = "cylinder-x1"

    def __call__(self) -> Sketch:
        held = shifted(turned(arc(0.5, 1.0, 1.6, (210.0, 330.0)), "x", 90.0), (0.0, 0.0, -(1.1 - 1.0) + 0.01))
        groove = turned(arc(1.1, 1.1 + 0.6, 2.0, (210.0, 330.0)), "x", 90.0)  # concave upwards: its face is x0
        cells = ((1, 8, 3), (1, 7, 3)) if self.element in ("hex20", "tet10") else ((3, 12, 4), (3, 10, 4))
        secondary = "groove-x0" if self.primary == "cylinder-x1" else "cylinder-x1"
        material = biphasic() if self.porous else neo()
        return Sketch(
            {"groove": mapped(cells[0], groove, self.element), "cylinder": mapped(cells[1], held, self.element)},
            {"groove": material, "cylinder": material},
            (Touch(self.primary, secondary, self.kind, self.params),),
            (
                fixed("groove-x1"),
                fixed("cylinder-x0", "x") if not self.slides else moved("cylinder-x0", "x", 0.15, 2),
                fixed("cylinder-x0", "y"),
                moved("cylinder-x0", "z", -0.12),
                *(drained(name) for name in ("groove-x1", "cylinder-x0") if self.porous),
            ),
            Scheme(20 if self.slides else 10, updates=self.updates),
            module="biphasic" if self.porous else "solid",
        )


SCENES: Mapping[str, Drawn] = {
    "mooney-slides-two-pass": Drawn(
        "Mooney-Rivlin blocks slide, two passes, a factor of 0.1", Blocks(mooney(), auto(0.1, TWO_PASS))
    ),
    "mooney-slides-two-pass-bfgs": Drawn(
        "Mooney-Rivlin blocks slide, two passes, a factor of 0.1, BFGS",
        Blocks(mooney(), auto(0.1, TWO_PASS), scheme=BFGS),
    ),
    "mooney-slides-hex20": Drawn("Mooney-Rivlin blocks of hex20", Blocks(mooney(), element="hex20")),
    "ogden-slides": Drawn("Ogden blocks slide", Blocks(ogden())),
    "ogden-slides-friction-augmented": Drawn(
        "Ogden blocks, friction 0.3, AUGLAG with a small penalty", Blocks(ogden(), auglag(0.1, 0.1, friction(0.3)))
    ),
    "ogden-slides-to-and-fro": Drawn(
        "Ogden blocks slide back and forth, friction 0.2, two passes",
        Blocks(ogden(), auto(1.0, friction(0.2) + TWO_PASS), way=0.4, back=True),
    ),
    "slides-over-the-edge": Drawn(
        "a block slides until half of it projects over an edge", Blocks(params=auto(2.0), way=1.9)
    ),
    "slides-tet15": Drawn("blocks of tet15 slide", Blocks(element="tet15")),
    "slides-penta15": Drawn("wedges of 15 nodes slide", Blocks(element="penta15")),
    "slides-hex27-broyden": Drawn(
        "blocks of hex27 slide, Broyden", Blocks(element="hex27", scheme=Scheme(20, method="Broyden", updates=10))
    ),
    "slides-penta6-friction": Drawn(
        "wedges slide, friction 0.2", Blocks(params=auto(1.0, friction(0.2)), element="penta6")
    ),
    "slides-tet4-friction-bfgs": Drawn(
        "tetrahedra slide, friction 0.2, BFGS", Blocks(params=auto(1.0, friction(0.2)), element="tet4", scheme=BFGS)
    ),
    "round-slides-two-pass": Drawn(
        "a round face slides on a slab, two passes", Blocks(params=auto(1.0, TWO_PASS), round_face=0.2)
    ),
    "round-drags-augmented-broyden": Drawn(
        "a round face is pulled sideways, friction 0.015, augmented, Broyden, fixed steps",
        Blocks(
            neo(1.0, 0.0),
            auglag(1.0, 0.02, friction(0.015)),
            scheme=Scheme(40, 0.05, retries=0, method="Broyden", updates=10, reformations=15),
            round_face=0.1,
        ),
    ),
    "groove-two-pass": Drawn(
        "incongruent cylinders, two passes, numerical penalty", Groove(given(5.0, TWO_PASS + NEAR))
    ),
    "groove-two-pass-slides": Drawn(
        "incongruent cylinders slide, two passes, numerical penalty", Groove(given(5.0, TWO_PASS + NEAR), slides=True)
    ),
    "groove-hex20": Drawn("incongruent cylinders of hex20", Groove(auto(1.0, NEAR), "hex20")),
    "groove-tet4-facets": Drawn(
        "incongruent cylinders of tet4, sliding-facet-on-facet, the groove as primary surface",
        Groove(auto(0.3), "tet4", kind="sliding-facet-on-facet", primary="groove-x0"),
    ),
    "groove-friction-augmented": Drawn(
        "incongruent cylinders slide, friction 0.3, AUGLAG with a small penalty, BFGS",
        Groove(auglag(0.2, 0.1, NEAR + friction(0.3)), slides=True, updates=10),
    ),
    "groove-biphasic-two-pass": Drawn(
        "incongruent porous cylinders, two passes",
        Groove(auto(1.0, TWO_PASS + NEAR + fluid(1.0)), kind="sliding-biphasic", porous=True),
    ),
    "groove-biphasic-slides-augmented": Drawn(
        "incongruent porous cylinders slide, two passes, AUGLAG with a small penalty, friction 0.1",
        Groove(
            auglag(0.2, 0.2, TWO_PASS + NEAR + fluid(0.2) + friction(0.1)),
            kind="sliding-biphasic",
            porous=True,
            slides=True,
        ),
    ),
}


@dataclass(frozen=True)
class RodInTube:
    """A rod (its outside is x1) is pressed sideways against the inside (x0) of a tube, and drawn along it."""

    sides: tuple[str, str] = ("x1", "x0")
    element: str = "hex8"
    params: str = auto(5.0, NEAR)
    slides: bool = False
    outer: float = 1.0
    updates: int = 0

    def __call__(self) -> Sketch:
        rod, tube = arc(0.4, self.outer, 3.0), arc(1.02, 1.6, 2.4)
        cells = ((1, 10, 2), (1, 12, 2)) if self.element == "tet10" else ((2, 20, 4), (2, 24, 4))
        ends = ("rod-z0", "rod-z1")
        drawn = [moved(end, "z", 0.4, 2) if self.slides else fixed(end, "z") for end in ends]
        return Sketch(
            {"rod": mapped(cells[0], rod, self.element), "tube": mapped(cells[1], tube, self.element)},
            {"rod": neo(2.0), "tube": neo(1.0)},
            (Touch(f"rod-{self.sides[0]}", f"tube-{self.sides[1]}", params=self.params),),
            (fixed("tube-x1"), *(fixed(end, "y") for end in ends), *(moved(end, "x", 0.15) for end in ends), *drawn),
            Scheme(20 if self.slides else 10, updates=self.updates),
        )


def rigid_rod_in_tube(primary: str = "tube-x0", secondary: str = "rod-x1") -> Sketch:
    """A rigid rod falls by a force onto the inside of a soft tube."""
    rod = shifted(arc(0.4, 0.9, 3.0), (0.125, 0, 0))
    return Sketch(
        {"rod": mapped((1, 24, 4), rod), "tube": mapped((2, 24, 4), arc(1.02, 1.6, 2.4))},
        {"rod": rigid((0.125, 0, 0)), "tube": neo(1.0)},
        (Touch(primary, secondary, params=USUALLY),),
        (fixed("tube-x1"), hold("rod", "yzuvw"), push("rod", "x", 0.3)),
    )


def ring_grows(params: str = USUALLY, updates: int = 0) -> Sketch:
    """A thin ring is blown up by a pressure until it bears on a tube; both are quarters."""
    quarter = (0.0, 90.0)
    symmetry = [fixed(f"{b}-{s}", d) for b in ("ring", "tube") for s, d in (("y0", "y"), ("y1", "x"))]
    return Sketch(
        {
            "ring": mapped((1, 10, 3), arc(0.9, 0.98, 1.0, quarter)),
            "tube": mapped((2, 7, 3), arc(1.0, 1.3, 1.4, quarter)),
        },
        {"ring": mooney(1.0, 0.0, 100.0), "tube": neo(0.2)},
        (Touch("ring-x1", "tube-x0", params=params),),
        (*symmetry, *(fixed(f"{b}-{s}", "z") for b in ("ring", "tube") for s in ("z0", "z1")), press("ring-x0", 0.15)),
        Scheme(updates=updates),
    )


@dataclass(frozen=True)
class Crossed:
    """A tube along x is pressed onto one along y; outsides are x1."""

    material: Material = field(default_factory=mooney)
    params: str = USUALLY
    element: str = "hex8"
    side: str = "x1"
    updates: int = 0
    slides: bool = False
    depth: float = 0.5

    def __call__(self) -> Sketch:
        low = turned(arc(0.6, 1.0, 4.0), "x", 90.0)
        high = shifted(turned(arc(0.6, 1.0, 4.0), "y", 90.0), (0, 0, 2.01))
        cells = ((1, 10, 5), (1, 10, 4)) if self.element == "tet10" else ((1, 16, 9), (1, 16, 8))
        ends = ("high-z0", "high-z1")
        away = [moved(end, "y", 0.4, 2) if self.slides else fixed(end, "y") for end in ends]
        return Sketch(
            {"low": mapped(cells[0], low, self.element), "high": mapped(cells[1], high, self.element)},
            {"low": self.material, "high": self.material},
            (Touch(f"high-{self.side}", f"low-{self.side}", params=self.params),),
            (
                *(fixed(f"low-{end}") for end in ("z0", "z1")),
                *(fixed(end, "x") for end in ends),
                *away,
                *(moved(end, "z", -self.depth) for end in ends),
            ),
            Scheme(20 if self.slides else 10, updates=self.updates),
        )


TUBES: Mapping[str, Drawn] = {
    "rod-in-tube": Drawn("a rod pressed against the inside of a tube", RodInTube()),
    "rod-in-tube-outsides": Drawn(
        "a rod pressed against the inside of a tube, whole outsides", RodInTube(("outside", "outside"))
    ),
    "rod-in-tube-tet10": Drawn("a rod in a tube, tet10", RodInTube(element="tet10")),
    "rod-in-tube-friction": Drawn(
        "a rod is pressed and pulled along the tube, friction 0.2",
        RodInTube(params=auto(2.0, NEAR + friction(0.2)), slides=True),
    ),
    "rod-in-tube-two-pass-bfgs": Drawn(
        "a rod is pulled along a tube, two passes, BFGS", RodInTube(params=USUALLY + TWO_PASS, slides=True, updates=10)
    ),
    "press-fit": Drawn("a rod that is wider than its tube at the start", RodInTube(outer=1.05, params=USUALLY)),
    "rigid-rod-in-tube": Drawn("a rigid rod under a force in a soft tube", rigid_rod_in_tube),
    "rigid-rod-in-tube-outsides": Drawn(
        "a rigid rod under a force in a soft tube, whole outsides",
        partial(rigid_rod_in_tube, "tube-outside", "rod-outside"),
    ),
    "ring-grows": Drawn("a ring expands against a tube", ring_grows),
    "ring-grows-augmented-bfgs": Drawn(
        "a ring expands against a tube, AUGLAG with a small penalty, BFGS",
        partial(ring_grows, auglag(0.2, 0.1, NEAR), 10),
    ),
    "crossed-tubes-two-pass": Drawn(
        "crossed Mooney-Rivlin tubes, two passes, numerical penalty", Crossed(params=given(5.0, TWO_PASS + NEAR))
    ),
    "crossed-tubes-two-pass-bfgs": Drawn(
        "crossed Mooney-Rivlin tubes, two passes, numerical penalty, BFGS",
        Crossed(params=given(5.0, TWO_PASS + NEAR), updates=10),
    ),
    "crossed-tubes-ogden": Drawn("crossed Ogden tubes", Crossed(ogden())),
    "crossed-tubes-tet10": Drawn("crossed tubes of tet10", Crossed(neo(), element="tet10")),
    "crossed-tubes-friction-augmented": Drawn(
        "crossed tubes slide, friction 0.2, AUGLAG with a small penalty",
        Crossed(params=auglag(0.2, 0.1, NEAR + friction(0.2)), slides=True),
    ),
    "crossed-tubes-outsides": Drawn("crossed tubes, whole outsides, including the insides", Crossed(side="outside")),
    "crossed-tubes-two-pass-deep": Drawn(
        "crossed Mooney-Rivlin tubes, two passes, pressed flat", Crossed(params=auto(1.0, TWO_PASS + NEAR), depth=0.9)
    ),
}
