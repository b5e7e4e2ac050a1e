"""Thin shells and strips on rigid bodies: tendons over bones, caps on heads, plates under rods."""

from collections.abc import Mapping
from functools import partial

from studies.models.small import fixed, moved
from studies.synthetic_scenes.reported.shapes import Shape, arc, ball, box, mapped, scaled, shell, shifted, turned
from studies.synthetic_scenes.reported.sketch import Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import auto, given, hold, neo, press, push, radius, rigid, shift

SKIN = neo(10.0)
USUALLY = auto(1.0, radius(0.5))  # parameters of a contact that a scene does not say otherwise


def _bone(outer: float, x: float = 0.0) -> Shape:
    return mapped((2, 24, 3), shifted(turned(arc(0.5 * outer, outer, 3.0), "x", 90.0), (x, 0.0, 0.0)))


def _strap(level: float, half: float, cells: tuple[int, int] = (24, 4), element: str = "quad4") -> Shape:
    """A shell along x whose front looks down, 0.1 mm thick."""
    return shell(cells, scaled(box((-half, -1.0, level), (half, 1.0, level)), (-1.0, 1.0, 1.0)), 0.1, element)


def _pulled() -> tuple[str, ...]:
    """Both ends of a strap are pulled down."""
    ends = ("strap-x0", "strap-x1")
    return (*(fixed(end, "x", "y") for end in ends), *(moved(end, "z", -1.0) for end in ends))


def strap_on_bone(
    surface: str = "x1", element: str = "quad4", kind: str = "sliding-elastic", params: str = USUALLY
) -> Sketch:
    """A strap is pulled over a rigid cylinder."""
    return Sketch(
        {"bone": _bone(2.0), "strap": _strap(2.02, 3.0, element=element)},
        {"bone": rigid(), "strap": SKIN},
        (Touch("strap-face", f"bone-{surface}", kind, params),),
        (*_pulled(), hold("bone")),
    )


def strap_on_two_bones(reach: str) -> Sketch:
    """A strap is pulled over two rigid cylinders whose whole outsides are surfaces."""
    return Sketch(
        {"one": _bone(1.2, -1.5), "two": _bone(1.2, 1.5), "strap": _strap(1.22, 3.5, (28, 4))},
        {"one": rigid((-1.5, 0, 0)), "two": rigid((1.5, 0, 0)), "strap": SKIN},
        tuple(Touch("strap-face", f"{bone}-outside", params=auto(1.0, reach)) for bone in ("one", "two")),
        (*_pulled(), hold("one"), hold("two")),
    )


def ball_in_trampoline(primary: str = "net-face", secondary: str = "ball-outside") -> Sketch:
    """A rigid ball is pushed up into a shell that is held at its edges."""
    net = shell((12, 12), scaled(box((-2, -2, 0.0), (2, 2, 0.0)), (-1.0, 1.0, 1.0)), 0.1)
    return Sketch(
        {"ball": mapped((5, 5, 5), shifted(ball(1.0), (0, 0, -0.98))), "net": net},
        {"ball": rigid((0, 0, -0.98)), "net": SKIN},
        (Touch(primary, secondary, params=auto(1.0, radius(0.6))),),
        (
            *(fixed(f"net-{edge}") for edge in ("x0", "x1", "y0", "y1")),
            hold("ball", "xyuvw"),
            shift("ball", "z", 0.6),
        ),
    )


def rod_on_plate() -> Sketch:
    """A rigid rod, its whole outside a surface, is pressed by a force into a shell that is held at two edges."""
    plate = shell((16, 6), box((-2, -1, 0.0), (2, 1, 0.0)), 0.1)
    return Sketch(
        {"rod": mapped((2, 20, 3), shifted(turned(arc(0.2, 0.5, 3.0), "x", 90.0), (0, 0, 0.48))), "plate": plate},
        {"rod": rigid((0, 0, 0.48)), "plate": SKIN},
        (Touch("plate-face", "rod-outside", params=auto(1.0, radius(0.3))),),
        (fixed("plate-x0"), fixed("plate-x1"), hold("rod", "xyuvw"), push("rod", "z", -0.02)),
    )


def shells_on_shells() -> Sketch:
    """One shell is pressed onto another that is held at its edges."""
    lower = shell((10, 10), box((-2, -2, 0.0), (2, 2, 0.0)), 0.1)
    upper = shell((8, 8), scaled(box((-1.5, -1.5, 0.02), (1.5, 1.5, 0.02)), (-1.0, 1.0, 1.0)), 0.1)
    held = ("x0", "x1", "y0", "y1")
    return Sketch(
        {"lower": lower, "upper": upper},
        {"lower": SKIN, "upper": SKIN},
        (Touch("upper-face", "lower-face", params=USUALLY),),
        (
            *(fixed(f"lower-{edge}") for edge in held),
            *(fixed(f"upper-{edge}", "x", "y") for edge in held),
            *(moved(f"upper-{edge}", "z", -0.1) for edge in held),
            press("upper-back", 0.002),
        ),
    )


def strip_on_bone(element: str = "hex8", sides: tuple[str, str] = ("z0", "x1"), params: str = USUALLY) -> Sketch:
    """A strip of solid elements, one through its thickness, is pulled over a rigid cylinder."""
    strip = mapped((20, 4, 1), box((-3, -1, 2.02), (3, 1, 2.14)), element)
    return Sketch(
        {"bone": _bone(2.0), "strap": strip},
        {"bone": rigid(), "strap": neo(5.0)},
        (Touch(f"strap-{sides[0]}", f"bone-{sides[1]}", params=params),),
        (*_pulled(), hold("bone")),
    )


SCENES: Mapping[str, Drawn] = {
    "strap-on-bone": Drawn("a shell is pulled over a rigid cylinder", strap_on_bone),
    "strap-on-bone-outside": Drawn(
        "a shell is pulled over a rigid cylinder, whole outside", partial(strap_on_bone, "outside")
    ),
    "strap-on-bone-tri3": Drawn(
        "a shell of triangles is pulled over a rigid cylinder", partial(strap_on_bone, element="tri3")
    ),
    "strap-on-bone-unlimited": Drawn(
        "a shell over a rigid cylinder, whole outside, sliding-facet-on-facet with unlimited search",
        partial(strap_on_bone, "outside", kind="sliding-facet-on-facet", params=auto(1.0, radius(0.0))),
    ),
    "strap-on-two-bones": Drawn("a shell over two rigid cylinders, whole outsides", partial(strap_on_two_bones, "")),
    "strap-on-two-bones-near": Drawn(
        "a shell over two rigid cylinders, whole outsides, a search radius of an element",
        partial(strap_on_two_bones, radius(0.3)),
    ),
    "ball-in-trampoline": Drawn("a rigid ball in a shell held at its edges", ball_in_trampoline),
    "ball-in-trampoline-ball-first": Drawn(
        "a rigid ball in a shell held at its edges, the ball as primary surface",
        partial(ball_in_trampoline, "ball-outside", "net-face"),
    ),
    "rod-on-plate": Drawn("a rigid rod under a force on a shell", rod_on_plate),
    "shells-on-shells": Drawn("a shell is pressed onto a shell", shells_on_shells),
    "strip-on-bone": Drawn("a strip of hex8 over a rigid cylinder", strip_on_bone),
    "strip-on-bone-outsides": Drawn(
        "a strip of hex8 over a rigid cylinder, whole outsides", partial(strip_on_bone, sides=("outside", "outside"))
    ),
    "strip-on-bone-tet10": Drawn(
        "a strip of tet10 over a rigid cylinder, numerical penalty",
        partial(strip_on_bone, "tet10", params=given(20.0, radius(0.5))),
    ),
}
