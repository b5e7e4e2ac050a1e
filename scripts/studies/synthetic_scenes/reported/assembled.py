"""Bodies that joints, springs, weights and shells hold, contact that begins in a later step, and rolling bodies."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from studies.models.small import Scheme, fixed, moved, step
from studies.synthetic_scenes.reported.shapes import Place, arc, ball, box, mapped, shell, shifted, turned
from studies.synthetic_scenes.reported.sketch import USUAL, Drawn, Sketch, Touch
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
    shift,
    spin,
    thrown,
)

NEAR = radius(0.5)
USUALLY = auto(1.0, NEAR)  # parameters of a contact that a scene does not say otherwise
TENSION = "<tension>1</tension>"
_CONTROL = re.compile(r"<Control>.*?</Control>", re.DOTALL)
_CONTACT = re.compile(r"<Contact>.*?</Contact>", re.DOTALL)


def cylinder(radius_: float, length: float, centre: tuple[float, float, float]) -> Place:
    """A tube along y, of a wall of 0.6 of its radius."""
    return shifted(turned(arc(0.4 * radius_, radius_, length), "x", 90.0), centre)


class InTwoSteps(Sketch):
    """A model whose contacts begin in the second of two steps of the analysis."""

    def text(self) -> str:
        """The model as FEBio 4 XML."""
        whole = super().text()
        control = _CONTROL.search(whole)
        contacts = _CONTACT.search(whole)
        assert control is not None
        assert contacts is not None
        steps = f"<Step>{step(1, control[0])}{step(2, control[0] + contacts[0])}</Step>"
        return _CONTACT.sub("", _CONTROL.sub("", whole)).replace("<LoadData>", f"{steps}<LoadData>")


def later(kind: str = "sliding-elastic") -> Sketch:
    """A block is bent in one step; in the next one, contact with a cylinder below it begins, and it is pressed down."""
    return InTwoSteps(
        {
            "block": mapped((12, 3, 3), box((-1.5, -0.4, 0.02), (1.5, 0.4, 0.5))),
            "roller": mapped((1, 24, 2), cylinder(0.5, 1.0, (0, 0, -0.5))),
        },
        {"block": neo(2.0), "roller": rigid((0, 0, -0.5))},
        (Touch("block-z0", "roller-x1", kind, USUALLY),),
        (
            fixed("block-x0", "x", "y"),
            fixed("block-x1", "y"),
            moved("block-x0", "z", -0.25, 2),
            moved("block-x1", "z", -0.25, 2),
            press("block-z1", 0.005),
            hold("roller"),
        ),
    )


def hinged(params: str = USUALLY) -> Sketch:
    """A rigid lever, which a joint holds at one end, is pressed onto a soft block by a force at its middle."""
    inner = (
        "<tolerance>0</tolerance><gaptol>1e-4</gaptol><angtol>1e-4</angtol><force_penalty>1e3</force_penalty>"
        "<moment_penalty>1e3</moment_penalty><body_a>post</body_a><body_b>lever</body_b>"
        "<joint_origin>-1.6,0,0.3</joint_origin><rotation_axis>0,1,0</rotation_axis>"
        "<transverse_axis>1,0,0</transverse_axis><laugon>AUGLAG</laugon><minaug>0</minaug><maxaug>10</maxaug>"
    )
    low = shifted(turned(arc(0.3, 0.6, 0.8), "x", 90.0), (0.6, 0.0, 0.59))
    return Sketch(
        {
            "block": mapped((6, 4, 3), box((0, -0.6, -0.8), (1.2, 0.6, 0.0))),
            "lever": mapped((1, 24, 2), low),
            "post": mapped((1, 1, 1), box((-1.8, -0.2, 0.1), (-1.4, 0.2, 0.5))),
        },
        {"block": neo(), "lever": rigid((0, 0, 0.5)), "post": rigid((-1.6, 0, 0.3))},
        (Touch("block-z1", "lever-x1", params=params),),
        (
            fixed("block-z0"),
            hold("post"),
            push("lever", "z", -0.1),
            f'<rigid_connector type="rigid revolute joint" name="hinge">{inner}</rigid_connector>',
        ),
    )


def sprung(first: str = "ball") -> Sketch:
    """A rigid ball on springs of a rigid body is brought down onto a soft slab: springs alone hold it sideways."""
    spring = (
        '<rigid_connector type="rigid spring" name="spring{n}"><body_a>hand</body_a><body_b>ball</body_b>'
        "<insertion_a>{x},{y},1.6</insertion_a><insertion_b>{x},{y},0.9</insertion_b><free_length>0.7</free_length>"
        "<k>{k}</k></rigid_connector>"
    )
    places = ((-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (-0.3, 0.3))
    springs = [spring.format(n=n, x=x, y=y, k=0.5) for n, (x, y) in enumerate(places)]
    sides = ("ball-outside", "slab-z1") if first == "ball" else ("slab-z1", "ball-outside")
    return Sketch(
        {
            "slab": mapped((8, 8, 3), box((-1.5, -1.5, -1.0), (1.5, 1.5, 0.0))),
            "ball": mapped((5, 5, 5), shifted(ball(0.8, 1.0), (0, 0, 0.79))),
            "hand": mapped((1, 1, 1), box((-0.4, -0.4, 1.6), (0.4, 0.4, 1.8))),
        },
        {"slab": neo(), "ball": rigid((0, 0, 0.8)), "hand": rigid((0, 0, 1.7))},
        (Touch(*sides, params=USUALLY),),
        (fixed("slab-z0"), hold("hand", "xyuvw"), hold("ball", "xyuvw"), shift("hand", "z", -0.4), *springs),
    )


def rolls() -> Sketch:
    """A rigid cylinder under a force is drawn over a slab by a force of friction: it rolls."""
    return Sketch(
        {
            "slab": mapped((20, 3, 3), box((-1, -0.5, -0.6), (2.6, 0.5, 0.0))),
            "roller": mapped((1, 36, 2), cylinder(0.8, 0.6, (0, 0, 0.79))),
        },
        {"slab": neo(2.0), "roller": rigid((0, 0, 0.79))},
        (Touch("slab-z1", "roller-x1", params=USUALLY + friction(0.5)),),
        (fixed("slab-z0"), hold("roller", "yuw"), push("roller", "z", -0.05, 4), spin("roller", "Rv", 1.5, 2)),
        Scheme(40, 0.05),
    )


@dataclass(frozen=True)
class Hertz:
    """Half a ball is moved onto a block, both of the same element."""

    element: str = "hex8"
    params: str = USUALLY
    material: Material = field(default_factory=neo)
    scheme: Scheme = USUAL
    depth: float = 0.12

    def __call__(self) -> Sketch:
        fine = self.element in ("hex8", "tet4", "penta6")

        def half(u: np.ndarray) -> np.ndarray:
            points = box((-0.7, -0.7, 0.0), (0.7, 0.7, 0.7))(u)
            sag = 1.2 - np.sqrt(1.44 - np.minimum(points[:, 0] ** 2 + points[:, 1] ** 2, 1.3))
            return np.asarray(points + np.column_stack([np.zeros((len(u), 2)), sag * (1.0 - u[:, 2]) + 0.005]))

        return Sketch(
            {
                "block": mapped((8, 8, 4) if fine else (4, 4, 2), box((-1, -1, -0.8), (1, 1, 0)), self.element),
                "ball": mapped((6, 6, 4) if fine else (3, 3, 2), half, self.element),
            },
            {"block": neo(), "ball": self.material},
            (Touch("ball-z0", "block-z1", params=self.params),),
            (fixed("block-z0"), fixed("ball-z1", "x", "y"), moved("ball-z1", "z", -self.depth)),
            self.scheme,
        )


def skin_on_foam(element: str = "quad4") -> Sketch:
    """A stiff shell lies on a soft block, and a rigid ball presses both: two contacts, the shell between them."""
    return Sketch(
        {
            "foam": mapped((8, 8, 4), box((-1.1, -1.1, -1), (1.1, 1.1, -0.005))),
            "skin": shell((8, 8), box((-1, -1, 0.0), (1, 1, 0.0)), 0.05, element),
            "ball": mapped((4, 4, 4), shifted(ball(0.6), (0, 0, 0.6))),
        },
        {"foam": neo(0.5), "skin": neo(20.0), "ball": rigid((0, 0, 0.6))},
        (Touch("skin-back", "foam-z1", params=USUALLY), Touch("skin-face", "ball-outside", params=USUALLY)),
        (
            fixed("foam-z0"),
            fixed("skin-x0", "y"),
            fixed("skin-y0", "x"),
            hold("ball", "xyuvw"),
            push("ball", "z", -0.04),
        ),
    )


def peeled() -> Sketch:
    """A strip that tension holds on a block is pulled up at one end."""
    return Sketch(
        {
            "block": mapped((10, 3, 2), box((-1.2, -0.5, -0.6), (1.2, 0.5, 0))),
            "strip": mapped((14, 2, 1), box((-1.0, -0.3, 0), (1.0, 0.3, 0.2))),
        },
        {"block": neo(2.0), "strip": neo(1.0)},
        (Touch("strip-z0", "block-z1", params=USUALLY + TENSION),),
        (fixed("block-z0"), fixed("strip-x0", "x", "y"), fixed("strip-x1", "y"), moved("strip-x1", "z", 0.15)),
    )


def dropped(mu: float = 0.0) -> Sketch:
    """A soft ball falls by its weight, askew, onto a slab; implicit dynamics."""
    return Sketch(
        {
            "slab": mapped((8, 8, 2), box((-1.5, -1.5, -0.6), (1.5, 1.5, 0))),
            "ball": mapped((5, 5, 5), shifted(ball(0.7), (0, 0, 0.75))),
        },
        {"slab": neo(2.0, 0.3, 1e-6), "ball": neo(0.5, 0.4, 1e-6)},
        (Touch("ball-outside", "slab-z1", params=USUALLY + (friction(mu) if mu else "")),),
        (fixed("slab-z0"), thrown("ball", (100.0 if mu else 0.0, 0.0, -150.0))),
        Scheme(40, 1e-4, "DYNAMIC"),
    )


def capped(force: float = 0.02) -> Sketch:
    """A rigid ball dents a shallow cap of shells until it snaps through."""

    def cap(u: np.ndarray) -> np.ndarray:
        points = box((-1, -1, 0), (1, 1, 0))(u)
        r2 = points[:, 0] ** 2 + points[:, 1] ** 2
        return np.asarray(np.column_stack([points[:, :2], 0.25 * (1.0 - 0.5 * r2)]))

    edges = [fixed(f"cap-{side}") for side in ("x0", "x1", "y0", "y1")]
    return Sketch(
        {"cap": shell((12, 12), cap, 0.04), "ball": mapped((5, 5, 5), shifted(ball(0.5), (0, 0, 0.77)))},
        {"cap": neo(10.0), "ball": rigid((0, 0, 0.77))},
        (Touch("cap-face", "ball-outside", params=USUALLY),),
        (*edges, hold("ball", "xyuvw"), shift("ball", "z", -0.5) if not force else push("ball", "z", -force)),
        Scheme(20, 0.05),
    )


def flat_pair(params: str, kind: str, module: str = "solid") -> Sketch:
    """A small soft block is pressed onto a larger stiff one and drawn along it."""
    porous = module == "biphasic"
    low, high = (biphasic(5.0), biphasic(1.0)) if porous else (neo(50.0), neo(1.0))
    ends = [drained("low-z0"), drained("high-z1")] if porous else []
    return Sketch(
        {
            "low": mapped((10, 4, 2), box((-1.2, -0.6, -0.6), (1.4, 0.6, 0.0))),
            "high": mapped((5, 3, 3), box((-0.7, -0.4, 0.01), (0.5, 0.4, 0.6))),
        },
        {"low": low, "high": high},
        (Touch("high-z0", "low-z1", kind, params),),
        (fixed("low-z0"), fixed("high-z1", "y"), moved("high-z1", "z", -0.1), moved("high-z1", "x", 0.4, 2), *ends),
        module=module,
    )


def meniscus() -> Sketch:
    """A porous ring that friction alone would hold, soft springs aside, between a rigid ball and a porous layer."""
    return Sketch(
        {
            "layer": mapped((10, 10, 2), box((-1.2, -1.2, -0.4), (1.2, 1.2, 0))),
            "ring": mapped((3, 20, 1), shifted(arc(0.35, 0.75, 0.12), (0, 0, 0.065))),
            "ball": mapped((6, 6, 6), shifted(ball(1.5, 1.0), (0, 0, 1.48))),
        },
        {"layer": biphasic(1.0, 0.1, 1e-3), "ring": biphasic(5.0, 0.1, 1e-3), "ball": rigid((0, 0, 1.5))},
        tuple(
            Touch(*sides, "sliding-biphasic", _FLUID)
            for sides in (("ring-z1", "ball-z0"), ("ring-z0", "layer-z1"), ("layer-z1", "ball-z0"))
        ),
        (fixed("layer-z0"), fixed("ring-x1", "x", "y"), hold("ball", "xyuvw"), push("ball", "z", -0.3)),
        module="biphasic",
    )


_FLUID = auto(1.0, NEAR + fluid(1.0))
SCENES: Mapping[str, Drawn] = {
    "contact-begins-later": Drawn("contact begins in the second step of an analysis", later),
    "contact-begins-later-facets": Drawn(
        "contact begins in the second step of an analysis, sliding-facet-on-facet",
        partial(later, "sliding-facet-on-facet"),
    ),
    "lever-on-hinge": Drawn("a rigid lever on a revolute joint presses a block", hinged),
    "lever-on-ball-joint-friction": Drawn(
        "a rigid lever on a revolute joint presses a block, friction 0.3, augmented",
        partial(hinged, auglag(0.5, 0.1, NEAR) + friction(0.3)),
    ),
    "ball-on-springs": Drawn("a rigid ball on springs is brought onto a slab", sprung),
    "ball-on-springs-slab-first": Drawn(
        "a rigid ball on springs is brought onto a slab, which is the primary surface", partial(sprung, "slab")
    ),
    "roller-rolls": Drawn("a rigid roller under a force turns and rolls, friction 0.5", rolls),
    "hertz-hex27-gap": Drawn(
        "half a ball of hex27, augmented to a gap", Hertz("hex27", auglag(1.0, 0.0, NEAR + "<gaptol>1e-3</gaptol>"))
    ),
    "hertz-tet15": Drawn("half a ball of tet15", Hertz("tet15")),
    "hertz-penta15-two-pass": Drawn("half a ball of penta15, two passes", Hertz("penta15", auto(1.0, NEAR + TWO_PASS))),
    "hertz-hard": Drawn("half a ball 1000 times as stiff as the block", Hertz(material=neo(1000.0))),
    "hertz-symmetric-default-solver": Drawn(
        "half a ball, FEBio's default solver", Hertz(scheme=Scheme(updates=10, symmetric=None))
    ),
    "hertz-one-step": Drawn(
        "half a Mooney-Rivlin ball, the whole load in two steps", Hertz(material=mooney(), scheme=Scheme(2, 0.5))
    ),
    "skin-on-foam": Drawn("a shell on a soft block under a rigid ball", skin_on_foam),
    "skin-on-foam-tri3": Drawn(
        "a shell of triangles on a soft block under a rigid ball", partial(skin_on_foam, "tri3")
    ),
    "peeled-tension": Drawn("a strip in contact with `tension` is pulled up", peeled),
    "dropped": Drawn("a soft ball falls onto a slab", dropped),
    "dropped-friction": Drawn("a soft ball falls obliquely onto a slab, friction 0.3", partial(dropped, 0.3)),
    "cap-snaps-by-force": Drawn("a force causes snap-through of a cap of shells", capped),
    "cap-snaps": Drawn("a rigid ball dents a cap of shells", partial(capped, 0.0)),
    "node-on-facet-slides": Drawn(
        "a soft block on a stiff one, sliding-node-on-facet", partial(flat_pair, given(50.0), "sliding-node-on-facet")
    ),
    "facet-on-facet-slides": Drawn(
        "a soft block on a stiff one, sliding-facet-on-facet, augmented",
        partial(flat_pair, auglag(1.0), "sliding-facet-on-facet"),
    ),
    "biphasic-slides-stiff": Drawn(
        "a soft porous block on a stiffer one", partial(flat_pair, _FLUID, "sliding-biphasic", "biphasic")
    ),
    "biphasic-slides-ten-times-soft": Drawn(
        "a soft porous block on a stiffer one, AUGLAG with a small penalty",
        partial(flat_pair, auglag(0.1, 0.1, NEAR + fluid(0.1)), "sliding-biphasic", "biphasic"),
    ),
    "meniscus": Drawn("a porous ring between a rigid ball and a porous layer", meniscus),
    "ogden-hertz-deep": Drawn("half an Ogden ball, pressed deep", Hertz(material=ogden(), depth=0.35)),
}
