"""Bodies of any stiffness, unit and element that are pressed, stacked, turned, bent or blown onto each other."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise

from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported.shapes import (
    Place,
    arc,
    ball,
    box,
    bulged,
    mapped,
    scaled,
    shell,
    shifted,
    turned,
)
from studies.synthetic_scenes.reported.sketch import USUAL, Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import (
    TWO_PASS,
    Material,
    auglag,
    auto,
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
    shift,
    spin,
)

NEAR = radius(0.5)
USUALLY = auto(1.0, NEAR)  # parameters of a contact that a scene does not say otherwise
FIBRES = (
    "solid mixture",
    '<solid type="neo-Hookean"><density>1e-9</density><E>0.5</E><v>0.2</v></solid>'
    '<solid type="fiber-exp-pow"><alpha>20</alpha><beta>2</beta><ksi>1</ksi>'
    '<fiber type="vector"><vector>1,0,0</vector></fiber></solid>',
)
VISCOUS = (
    "viscoelastic",
    '<t1>0.3</t1><g0>1</g0><g1>2</g1><elastic type="neo-Hookean"><density>1e-9</density><E>1</E><v>0.4</v></elastic>',
)


def dome(gap: float = 0.01) -> Place:
    """A block whose lower face bulges downwards."""
    flat = box((-0.6, -0.6, gap), (0.6, 0.6, gap + 0.8))
    return bulged(flat, lambda x: 0.3 * (x[:, 0] ** 2 + x[:, 1] ** 2))


@dataclass(frozen=True)
class Dome:
    """A block with a round lower face is pressed into a slab, moved down or by a pressure on its top."""

    low: Material = field(default_factory=neo)
    high: Material = field(default_factory=neo)
    params: str = USUALLY
    elements: tuple[str, str] = ("hex8", "hex8")
    depth: float = 0.15
    load: float = 0.0
    unit: float = 1.0
    gap: float = 0.01
    scheme: Scheme = USUAL
    first: str = "dome"
    held: bool = False

    def __call__(self) -> Sketch:
        quadratic = [element in ("hex20", "hex27", "tet10", "tet15", "penta15") for element in self.elements]
        cells = {"slab": (4, 4, 2) if quadratic[0] else (8, 8, 4), "dome": (3, 3, 2) if quadratic[1] else (6, 6, 4)}
        places = {"slab": box((-1, -1, -0.8), (1, 1, 0)), "dome": dome(gap=self.gap)}
        sides = ("dome-z0", "slab-z1") if self.first == "dome" else ("slab-z1", "dome-z0")
        curve = 4 if self.held else 1
        pressed = press("dome-z1", self.load, curve)
        drive = pressed if self.load else moved("dome-z1", "z", -self.depth * self.unit, curve)
        return Sketch(
            {
                body: mapped(cells[body], scaled(places[body], self.unit), element)
                for body, element in zip(places, self.elements, strict=True)
            },
            {"slab": self.low, "dome": self.high},
            (Touch(*sides, params=self.params),),
            (fixed("slab-z0"), fixed("dome-z1", "x", "y"), drive),
            self.scheme,
        )


def stack(stiffnesses: Sequence[float] = (1.0, 2.0, 0.5, 1.0), element: str = "hex8") -> Sketch:
    """Four blocks on each other, the top of the highest one moved down."""
    names = ["one", "two", "three", "four"]
    sizes = (1.0, 0.8, 0.9, 0.7)
    places = [box((-s, -0.5 * s, 0.5 * k), (s, 0.5 * s, 0.5 * k + 0.5)) for k, s in enumerate(sizes)]
    cells = [(4, 3, 2), (5, 3, 2), (4, 2, 2), (5, 3, 2)]
    return Sketch(
        {name: mapped(c, place, element) for name, c, place in zip(names, cells, places, strict=True)},
        {name: neo(stiffness) for name, stiffness in zip(names, stiffnesses, strict=True)},
        tuple(Touch(f"{above}-z0", f"{below}-z1", params=USUALLY) for below, above in pairwise(names)),
        (
            fixed("one-z0"),
            fixed("four-z1", "x", "y"),
            *(fixed(f"{name}-x0", "x", "y") for name in names[1:3]),
            moved("four-z1", "z", -0.15),
        ),
    )


def two_on_one(params: str = USUALLY) -> Sketch:
    """Two rigid spheres are pressed into one slab next to each other; one slides to the other."""
    places = {name: shifted(ball(0.5), (x, 0, 0.48)) for name, x in (("left", -0.6), ("right", 0.6))}
    return Sketch(
        {
            "slab": mapped((12, 6, 3), box((-1.5, -0.8, -0.8), (1.5, 0.8, 0))),
            **{name: mapped((4, 4, 4), place) for name, place in places.items()},
        },
        {"slab": neo(), "left": rigid((-0.6, 0, 0.5)), "right": rigid((0.6, 0, 0.5))},
        tuple(Touch("slab-z1", f"{name}-outside", params=params) for name in ("left", "right")),
        (
            fixed("slab-z0"),
            hold("left", "yuvw"),
            hold("right", "xyuvw"),
            shift("left", "z", -0.15),
            shift("right", "z", -0.15),
            shift("left", "x", 0.2, 2),
        ),
        Scheme(20),
    )


def beam(rest: str, element: str = "hex8") -> Sketch:
    """A cantilever bends by a pressure, until it rests on a body below it: a force alone closes the gap."""
    cells = (10, 1, 1) if element in ("hex20", "tet10", "hex27") else (20, 3, 3)
    low = shifted(turned(arc(0.2, 0.5, 1.0), "x", 90.0), (2.5, 0, -0.7))
    is_rigid = rest == "rigid"
    held = hold("rest") if is_rigid else fixed("rest-x0")
    return Sketch(
        {"beam": mapped(cells, box((0, -0.4, 0), (3, 0.4, 0.3)), element), "rest": mapped((1, 24, 2), low)},
        {"beam": neo(10.0), "rest": rigid((2.5, 0, -0.7)) if is_rigid else neo(1.0)},
        (Touch("beam-z0", "rest-x1", params=USUALLY),),
        (fixed("beam-x0"), held, press("beam-z1", 0.02)),
    )


def blown(rest: Material) -> Sketch:
    """A membrane of shells is blown by a pressure onto a block above it."""
    above = mapped((6, 6, 2), box((-1.2, -1.2, 0.15), (1.2, 1.2, 0.75)))
    held = hold("rest") if rest[0] == "rigid body" else fixed("rest-z1")
    edges = [fixed(f"skin-{side}") for side in ("x0", "x1", "y0", "y1")]
    return Sketch(
        {"skin": shell((10, 10), box((-1, -1, 0), (1, 1, 0)), 0.05), "rest": above},
        {"skin": neo(5.0), "rest": rest},
        (Touch("skin-face", "rest-z0", params=USUALLY),),
        (*edges, held, press("skin-back", 0.1)),
    )


def twist(angle: float, params: str = USUALLY, material: Material | None = None, element: str = "hex8") -> Sketch:
    """A rigid disc is pressed onto a block and turned about its axis."""
    disc = shifted(arc(0.1, 0.7, 0.3), (0, 0, 0.16))
    cells = (3, 3, 2) if element in ("hex20", "tet10", "hex27") else (6, 6, 3)
    return Sketch(
        {"block": mapped(cells, box((-1, -1, -0.8), (1, 1, 0)), element), "disc": mapped((3, 16, 1), disc)},
        {"block": material or neo(), "disc": rigid((0, 0, 0.16))},
        (Touch("disc-z0", "block-z1", params=params),),
        (fixed("block-z0"), hold("disc", "xyuv"), shift("disc", "z", -0.1), spin("disc", "Rw", angle, 2)),
        Scheme(20),
    )


def plug(params: str = USUALLY, force: float = 0.0, material: Material | None = None) -> Sketch:
    """A rigid conical plug is moved or pulled by a force into a soft ring."""
    cone = arc(0.2, 0.55 if not force else 0.57, 1.0, flare=0.3)
    return Sketch(
        {"ring": mapped((2, 20, 4), arc(0.8, 1.3, 0.6)), "plug": mapped((1, 24, 5), cone)},
        {"ring": material or mooney(0.3, 0.0, 20.0), "plug": rigid()},
        (Touch("ring-x0", "plug-x1", params=params),),
        (fixed("ring-x1"), hold("plug", "xyuvw"), push("plug", "z", -force) if force else shift("plug", "z", -0.25)),
    )


def arch() -> Sketch:
    """A rigid ball presses a shallow arch until it has snapped through."""
    bow = turned(arc(2.9, 3.0, 0.6, (60.0, 120.0)), "x", 90.0)
    return Sketch(
        {
            "arch": mapped((2, 24, 2), shifted(bow, (0, 0, -2.6))),
            "ball": mapped((5, 5, 5), shifted(ball(0.4), (0, 0, 0.805))),
        },
        {"arch": neo(10.0), "ball": rigid((0, 0, 0.8))},
        (Touch("arch-x1", "ball-outside", params=USUALLY),),
        (fixed("arch-y0"), fixed("arch-y1"), hold("ball", "xyuvw"), shift("ball", "z", -0.6)),
        Scheme(20, 0.05),
    )


def crushed(element: str = "hex8") -> Sketch:
    """Half a soft tube that stands on its symmetry plane is crushed by a rigid roller."""
    half = turned(arc(0.8, 1.0, 2.0, (0.0, 180.0)), "x", 90.0)
    cells = (1, 8, 2) if element in ("hex20", "tet10", "hex27") else (2, 16, 3)
    roll = shifted(turned(arc(0.2, 0.5, 2.4), "x", 90.0), (0, 0, 1.505))
    return Sketch(
        {"tube": mapped(cells, half, element), "roll": mapped((1, 20, 2), roll)},
        {"tube": mooney(1.0, 0.0, 100.0), "roll": rigid((0, 0, 1.505))},
        (Touch("tube-x1", "roll-x1", params=USUALLY),),
        (
            fixed("tube-y0", "x", "z"),
            fixed("tube-y1", "z"),
            fixed("tube-z0", "y"),
            hold("roll", "xyuvw"),
            shift("roll", "z", -0.3),
        ),
    )


SCENES: Mapping[str, Drawn] = {
    "dome-pa-m": Drawn("a dome on a slab in Pa and m", Dome(neo(1e6), neo(2e6), auto(1.0, radius(5e-4)), unit=1e-3)),
    "dome-pa-m-load": Drawn(
        "a dome on a slab in Pa and m, under a pressure",
        Dome(neo(1e6), neo(2e6), auto(1.0, radius(5e-4)), unit=1e-3, load=3e4, gap=-0.03),
    ),
    "dome-micrometres": Drawn(
        "a dome on a slab in micrometres and kPa, BFGS",
        Dome(neo(1.0), neo(2.0), auto(1.0), unit=50.0, scheme=Scheme(updates=10)),
    ),
    "dome-stiff-on-soft": Drawn("a dome 1e3 times as stiff as the slab", Dome(neo(0.1), neo(100.0))),
    "dome-soft-on-stiff": Drawn("a dome 1e4 times as soft as the slab", Dome(neo(1e3), neo(0.1))),
    "dome-soft-on-stiff-slab-first": Drawn(
        "a soft dome on a stiff slab, the slab as primary surface", Dome(neo(1e3), neo(0.1), first="slab")
    ),
    "dome-overlap": Drawn(
        "a dome that overlaps a slab by a third of an element at the start", Dome(gap=-0.06, depth=0.1)
    ),
    "dome-overlap-tet10": Drawn(
        "a dome of tet10 that overlaps a slab of tet10 at the start",
        Dome(gap=-0.06, depth=0.1, elements=("tet10", "tet10")),
    ),
    "dome-deep": Drawn(
        "an Ogden dome, pressed deep in five steps", Dome(ogden(), ogden(), depth=0.4, scheme=Scheme(5, 0.2))
    ),
    "dome-deep-two-pass": Drawn(
        "a Mooney-Rivlin dome, pressed deep, two passes", Dome(mooney(), mooney(), USUALLY + TWO_PASS, depth=0.4)
    ),
    "dome-hex20-on-tet10": Drawn("hex20 on tet10", Dome(elements=("tet10", "hex20"))),
    "dome-hex27-on-penta15": Drawn("hex27 on penta15", Dome(elements=("penta15", "hex27"))),
    "dome-tet4-on-hex20": Drawn(
        "tet4 on hex20, two passes", Dome(params=USUALLY + TWO_PASS, elements=("hex20", "tet4"))
    ),
    "dome-penta6-friction": Drawn(
        "wedges on tetrahedra, friction 0.5", Dome(params=USUALLY + friction(0.5), elements=("tet4", "penta6"))
    ),
    "dome-load-held": Drawn(
        "a pressure that is held for a long time", Dome(load=0.05, gap=-0.03, held=True, scheme=Scheme(20, 0.1))
    ),
    "dome-held": Drawn("a displacement that is held for a long time", Dome(held=True, scheme=Scheme(20, 0.1))),
    "dome-fibres": Drawn("fibres that bear tension alone", Dome(FIBRES, FIBRES)),
    "dome-viscoelastic": Drawn("viscoelastic bodies, BFGS", Dome(VISCOUS, VISCOUS, scheme=Scheme(updates=10))),
    "dome-symmetric": Drawn("a dome, FEBio's default solver", Dome(scheme=Scheme(updates=10, symmetric=None))),
    "dome-augmented-fine": Drawn(
        "a dome, augmented to a gap of 1e-4 mm", Dome(params=auglag(1.0, 0.0, NEAR + "<gaptol>1e-4</gaptol>"))
    ),
    "dome-given-soft": Drawn("a numerical penalty that is softer than the bodies", Dome(params=given(0.5, NEAR))),
    "dome-load": Drawn("a dome under a large pressure", Dome(neo(1.0, 0.45), neo(1.0, 0.45), load=0.3, gap=-0.03)),
    "stack": Drawn("four blocks on each other", stack),
    "stack-unlike": Drawn(
        "four blocks on each other, with stiffnesses of 1 to 100", partial(stack, (1.0, 100.0, 1.0, 100.0))
    ),
    "stack-tet4": Drawn("four blocks of tet4 on each other", partial(stack, element="tet4")),
    "two-on-one": Drawn("two rigid spheres in one slab, one slides to the other", two_on_one),
    "two-on-one-friction": Drawn(
        "two rigid spheres in one slab, friction 0.3", partial(two_on_one, USUALLY + friction(0.3))
    ),
    "beam-on-rigid": Drawn("a cantilever bends onto a rigid cylinder", partial(beam, "rigid")),
    "beam-on-soft": Drawn("a cantilever bends onto a soft cylinder", partial(beam, "soft")),
    "beam-on-soft-hex20-bfgs": Drawn(
        "a cantilever of hex20 bends onto a soft cylinder", partial(beam, "soft", "hex20")
    ),
    "blown-on-rigid": Drawn("a pressure inflates a membrane against a rigid block", partial(blown, rigid())),
    "blown-on-soft": Drawn("a pressure inflates a membrane against a soft block", partial(blown, neo(0.5))),
    "twist": Drawn("a rigid disc is pressed and turned, friction 0.3", partial(twist, 0.5, USUALLY + friction(0.3))),
    "twist-hex20-augmented": Drawn(
        "a rigid disc turns on hex20, augmented, friction 0.2",
        partial(twist, 0.4, auglag(0.2, 0.1, NEAR + friction(0.2)), mooney(), "hex20"),
    ),
    "twist-frictionless": Drawn("a rigid disc is pressed and turned by 90 degrees", partial(twist, 1.57)),
    "plug": Drawn("a rigid cone is moved into a ring", plug),
    "plug-friction": Drawn(
        "a rigid cone is pulled into a ring by a force, friction 0.2, augmented",
        partial(plug, auglag(0.2, 0.1, NEAR + friction(0.2)), 0.3),
    ),
    "plug-incompressible": Drawn(
        "a rigid cone in a nearly incompressible ring", partial(plug, material=mooney(0.3, 0.0, 1000.0))
    ),
    "arch-snaps": Drawn("a rigid ball causes snap-through of an arch", arch),
    "crushed": Drawn("half a tube under a rigid roller", crushed),
    "crushed-hex20": Drawn("half a tube of hex20 under a rigid roller", partial(crushed, "hex20")),
}
