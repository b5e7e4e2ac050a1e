"""Impacts, and elements that erode while they are in contact. Densities are in t/mm^3."""

from collections.abc import Mapping
from functools import partial

from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported.shapes import ball, box, mapped, scaled, shell, shifted
from studies.synthetic_scenes.reported.sketch import Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import (
    TWO_PASS,
    auglag,
    auto,
    friction,
    given,
    hold,
    mooney,
    neo,
    radius,
    rigid,
    shift,
    thrown,
)

USUALLY = auto(1.0, radius(0.5))  # parameters of a contact that a scene does not say otherwise
FAST = Scheme(40, 2.5e-6, "DYNAMIC")  # a wave crosses a millimetre in some 30 microseconds


def impact(
    params: str = USUALLY, *, wall: bool = False, scheme: Scheme = FAST, sides: tuple[str, str] = ("z0", "z1")
) -> Sketch:
    """A block is thrown onto another one, or onto a rigid wall."""
    slab = mapped((1, 1, 1) if wall else (6, 6, 3), box((-1, -1, -1), (1, 1, 0)))
    return Sketch(
        {"slab": slab, "block": mapped((5, 5, 5), box((-0.7, -0.7, 0.02), (0.7, 0.7, 1.2)))},
        {"slab": rigid((0, 0, -0.5)) if wall else neo(2.0), "block": neo(1.0)},
        (Touch(f"block-{sides[0]}", f"slab-{sides[1]}", params=params),),
        (hold("slab") if wall else fixed("slab-z0"), thrown("block", (0.0, 0.0, -3000.0))),
        scheme,
    )


def ball_bounces(params: str = USUALLY, along: float = 0.0) -> Sketch:
    """A ball is thrown at a slab, and leaves it again."""
    return Sketch(
        {
            "slab": mapped((6, 6, 2), box((-1.5, -1.5, -0.8), (1.5, 1.5, 0))),
            "ball": mapped((5, 5, 5), shifted(ball(0.8, 0.85), (0, 0, 0.8))),
        },
        {"slab": neo(5.0), "ball": mooney(0.3, 0.0, 10.0)},
        (Touch("ball-outside", "slab-z1", params=params),),
        (fixed("slab-z0"), thrown("ball", (along, 0.0, -4000.0))),
        Scheme(60, 3e-6, "DYNAMIC"),
    )


def bullet(surfaces: str, kind: str, params: str) -> Sketch:
    """A rigid plate of shells is driven into a block whose elements erode by their stress."""
    stress = '<criterion type="min-max filter"><min>0.15</min><clamp>0</clamp><data type="stress"/></criterion>'
    inner = f"<max_iters>1</max_iters><max_elems>3</max_elems><erode_surfaces>{surfaces}</erode_surfaces>{stress}"
    head = shell((3, 3), scaled(box((-0.35, -0.35, 0.01), (0.35, 0.35, 0.01)), (-1.0, 1.0, 1.0)), 0.1)
    return Sketch(
        {"bullet": head, "block": mapped((7, 7, 4), box((-1, -1, -1), (1, 1, 0)))},
        {"bullet": rigid((0, 0, 0.01)), "block": neo(1.0)},
        (Touch("block-z1", "bullet-face", kind, params),),
        (
            fixed("block-z0"),
            hold("bullet", "xyuvw"),
            shift("bullet", "z", -0.5),
            f'<mesh_adaptor type="erosion">{inner}</mesh_adaptor>',
        ),
        Scheme(15, 1.0 / 15.0, "DYNAMIC"),
    )


def wears(criterion: str, surfaces: str) -> Sketch:
    """A block is pressed and drawn over a slab, whose elements erode one in a step."""
    inner = f"<max_iters>1</max_iters><max_elems>1</max_elems><erode_surfaces>{surfaces}</erode_surfaces>{criterion}"
    return Sketch(
        {
            "slab": mapped((8, 4, 2), box((-1.5, -0.6, -0.6), (1.5, 0.6, 0))),
            "block": mapped((5, 3, 2), box((-0.8, -0.4, 0.005), (0.6, 0.4, 0.5))),
        },
        {"slab": neo(1.0), "block": neo(2.0)},
        (Touch("block-z0", "slab-z1", params=USUALLY),),
        (
            fixed("slab-z0"),
            fixed("block-z1", "y"),
            moved("block-z1", "z", -0.06),
            moved("block-z1", "x", 0.3, 2),
            f'<mesh_adaptor type="erosion">{inner}</mesh_adaptor>',
        ),
        Scheme(20),
    )


_GAP = '<criterion type="contact gap"><gap>{}</gap></criterion>'
_CHOSEN = '<criterion type="element_selection"><value>1</value><element_list>{}</element_list></criterion>'

SCENES: Mapping[str, Drawn] = {
    "impact": Drawn("a block is thrown onto a block", impact),
    "impact-outsides": Drawn(
        "a block is thrown onto a block, whole outsides", partial(impact, sides=("outside", "outside"))
    ),
    "impact-wall": Drawn("a block is thrown onto a rigid wall", partial(impact, wall=True)),
    "impact-two-pass-augmented": Drawn(
        "a block is thrown onto a block, two passes, AUGLAG with a small penalty",
        partial(impact, auglag(0.2, 0.1, TWO_PASS + radius(0.5))),
    ),
    "impact-bfgs": Drawn(
        "a block is thrown onto a block, numerical penalty, BFGS",
        partial(impact, given(20.0, radius(0.5)), scheme=Scheme(40, 2.5e-6, "DYNAMIC", updates=10)),
    ),
    "ball-bounces": Drawn("a soft ball bounces off a slab", ball_bounces),
    "ball-bounces-friction": Drawn(
        "a soft ball is thrown obliquely at a slab, friction 0.3",
        partial(ball_bounces, USUALLY + friction(0.3), 2000.0),
    ),
    "bullet-erodes": Drawn(
        "a rigid plate erodes a block by stress", partial(bullet, "yes", "sliding-elastic", USUALLY)
    ),
    "bullet-erodes-facets": Drawn(
        "a rigid plate erodes a block by stress, surfaces that adapt, sliding-facet-on-facet",
        partial(bullet, "grow", "sliding-facet-on-facet", auto(1.0)),
    ),
    "erosion-by-gap": Drawn(
        "a slab erodes by FEBio's criterion of the gap", partial(wears, _GAP.format(0.002), "grow")
    ),
    "erosion-away": Drawn("elements without contact erode", partial(wears, _CHOSEN.format("1,2,3"), "yes")),
    "erosion-in-contact": Drawn("elements in contact erode", partial(wears, _CHOSEN.format("38,40"), "yes")),
}
