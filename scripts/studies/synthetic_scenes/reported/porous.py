"""Biphasic and charged bodies: undrained steps, punches, slides, layers, solutes and salt."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported.pressed import dome
from studies.synthetic_scenes.reported.shapes import arc, box, bulged, mapped, shifted, turned
from studies.synthetic_scenes.reported.sketch import USUAL, Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import (
    SOLUTE,
    TWO_PASS,
    auglag,
    auto,
    biphasic,
    concentration,
    drained,
    fluid,
    friction,
    hold,
    initial_concentration,
    press,
    push,
    radius,
    rigid,
    with_solute,
)

WET = "sliding-biphasic"
SALTY = "sliding-biphasic-solute"
NEAR = radius(0.5)
USUALLY = auto(1.0, NEAR + fluid(1.0))  # parameters of a contact that a scene does not say otherwise


@dataclass(frozen=True)
class Blocks:
    """A porous block with a curved lower face is pressed into a porous slab, by displacement or by a pressure."""

    params: str = USUALLY
    scheme: Scheme = USUAL
    element: str = "hex8"
    depth: float = 0.1
    way: float = 0.0
    solute: bool = False
    curve: int = 1
    load: float = 0.0
    permeability: float = 1e-2

    def __call__(self) -> Sketch:
        quadratic = self.element in ("hex20", "hex27", "tet10", "tet15")
        low, high = ((5, 3, 2), (4, 2, 2)) if quadratic else ((8, 4, 3), (6, 3, 3))
        above = bulged(box((-0.8, -0.4, -0.005 if self.load else 0.01), (0.8, 0.4, 0.8)), lambda x: 0.1 * x[:, 0] ** 2)
        make = with_solute if self.solute else biphasic
        ends = ("low-z0", "high-z1")
        held = [concentration(end, value) for end, value in zip(ends, (1.0, 0.5), strict=True)] if self.solute else []
        start = [initial_concentration(body, v) for body, v in (("low", 1.0), ("high", 0.5))] if self.solute else []
        across = moved("high-z1", "x", self.way, 2) if self.way else fixed("high-z1", "x")
        drive = [fixed("high-z1", "y"), moved("high-z1", "z", -self.depth, self.curve), across]
        return Sketch(
            {
                "low": mapped(low, box((-1.2, -0.6, -0.8), (1.4, 0.6, 0.0)), self.element),
                "high": mapped(high, above, self.element),
            },
            {"low": make(1.0, 0.1, self.permeability), "high": make(2.0, 0.1, self.permeability)},
            (Touch("high-z0", "low-z1", SALTY if self.solute else WET, self.params),),
            (
                fixed("low-z0"),
                *([fixed("high-z1", "x", "y")] if self.load else drive),
                *(drained(end) for end in ends),
                *held,
                *start,
                *([press("high-z1", self.load, self.curve)] if self.load else []),
            ),
            self.scheme,
            module="solute" if self.solute else "biphasic",
            globals=SOLUTE if self.solute else "",
        )


def punch(*, updates: int = 0, face: str = "x1", first: str = "layer") -> Sketch:
    """A rigid cylinder under a force, all of it applied within a tenth of a second, creeps into a porous layer."""
    disc = shifted(turned(arc(0.8, 1.5, 1.2, (230.0, 310.0)), "x", 90.0), (0.0, 0.0, 1.49))
    sides = ("layer-z1", f"punch-{face}") if first == "layer" else (f"punch-{face}", "layer-z1")
    return Sketch(
        {"punch": mapped((1, 16, 2), disc), "layer": mapped((14, 3, 3), box((-1.5, -0.5, -0.6), (1.5, 0.5, 0.0)))},
        {"punch": rigid((0, 0, 0.5)), "layer": biphasic(1.0, 0.0, 1e-3)},
        (Touch(*sides, WET, USUALLY),),
        (
            fixed("layer-z0"),
            *(fixed(f"layer-{side}", "y") for side in ("y0", "y1")),
            hold("punch", "xyuvw"),
            push("punch", "z", -0.1, 4),
        ),
        Scheme(20, updates=updates),
        module="biphasic",
    )


_SALT = auto(1.0, NEAR + fluid(1.0, 1.0))
SCENES: Mapping[str, Drawn] = {
    "undrained": Drawn("porous blocks, steps a thousandth of the time of drainage", Blocks(permeability=1e-5)),
    "undrained-augmented": Drawn(
        "porous blocks, steps a thousandth of the time of drainage, augmented",
        Blocks(auglag(1.0, 0.1, NEAR + fluid(1.0)), permeability=1e-5),
    ),
    "undrained-load": Drawn(
        "porous blocks with a very low permeability under a sudden pressure",
        Blocks(load=0.05, curve=4, permeability=1e-6),
    ),
    "biphasic-slides-friction-bfgs": Drawn(
        "porous blocks slide, friction 0.2, BFGS", Blocks(USUALLY + friction(0.2), Scheme(20, updates=10), way=0.4)
    ),
    "biphasic-slides-two-pass-tet4": Drawn(
        "porous tetrahedra slide, two passes", Blocks(USUALLY + TWO_PASS, Scheme(20), "tet4", way=0.4)
    ),
    "biphasic-tet10-broyden": Drawn(
        "porous tet10, Broyden", Blocks(scheme=Scheme(method="Broyden", updates=10), element="tet10")
    ),
    "biphasic-load-augmented": Drawn(
        "porous blocks under a pressure, AUGLAG with a small penalty",
        Blocks(auglag(0.1, 0.1, NEAR + fluid(0.1)), load=0.05),
    ),
    "biphasic-punch": Drawn("a rigid cylinder under a force creeps into a porous layer", punch),
    "biphasic-punch-bfgs": Drawn(
        "a rigid cylinder creeps into a porous layer, the cylinder as primary surface, BFGS",
        partial(punch, updates=10, first="punch"),
    ),
    "biphasic-punch-outside": Drawn(
        "a rigid cylinder creeps into a porous layer, whole outside", partial(punch, face="outside")
    ),
    "solute-two-pass": Drawn("a solute crosses, two passes", Blocks(_SALT + TWO_PASS, solute=True)),
    "solute-slides-tet10": Drawn(
        "a solute crosses between sliding tet10", Blocks(_SALT, Scheme(20), "tet10", way=0.3, solute=True)
    ),
    "solute-load-bfgs": Drawn(
        "a solute crosses under a pressure, BFGS", Blocks(_SALT, Scheme(updates=10), load=0.02, solute=True)
    ),
    "solute-augmented": Drawn(
        "a solute crosses, AUGLAG with a small penalty",
        Blocks(auglag(0.2, 0.1, NEAR + fluid(0.2, 0.2)), solute=True, way=0.3, scheme=Scheme(20)),
    ),
}


GAS = 8.314e-6 * 298.0  # R T, mJ/nmol
SALT = 100.0  # mM of either ion outside
IONS = "".join(
    f'<solute id="{n}" name="{name}"><charge_number>{charge}</charge_number><molar_mass>1</molar_mass>'
    "<density>1</density></solute>"
    for n, name, charge in ((1, "Na", 1), (2, "Cl", -1))
)


def charged(modulus: float, charge: float) -> tuple[str, str]:
    """A multiphasic layer with fixed charges (mM) and two ions."""
    ions = "".join(
        f'<solute sol="{n}"><diffusivity type="diff-const-iso"><free_diff>1e-2</free_diff><diff>5e-3</diff>'
        '</diffusivity><solubility type="solub-const"><solub>1</solub></solubility></solute>'
        for n in (1, 2)
    )
    return "multiphasic", (
        f"<phi0>0.2</phi0><fixed_charge_density>{charge:g}</fixed_charge_density>"
        f'<solid type="neo-Hookean"><density>1e-9</density><E>{modulus:g}</E><v>0.1</v></solid>'
        '<permeability type="perm-const-iso"><perm>1e-2</perm></permeability>'
        f'<osmotic_coefficient type="osm-coef-const"><osmcoef>1</osmcoef></osmotic_coefficient>{ions}'
    )


@dataclass(frozen=True)
class Layers:
    """A porous dome is pressed into a porous slab of another permeability, and slides."""

    permeability: tuple[float, float]
    params: str = USUALLY
    modulus: tuple[float, float] = (1.0, 1.0)
    way: float = 0.0
    load: float = 0.0
    element: str = "hex8"
    scheme: Scheme = USUAL

    def __call__(self) -> Sketch:
        (low, high), (soft, stiff) = self.permeability, self.modulus
        cells = ((4, 4, 2), (3, 3, 2)) if self.element in ("hex20", "tet10") else ((8, 8, 3), (5, 5, 3))
        across = moved("dome-z1", "x", self.way, 2) if self.way else fixed("dome-z1", "x")
        return Sketch(
            {
                "slab": mapped(cells[0], box((-1, -1, -0.8), (1, 1, 0)), self.element),
                "dome": mapped(cells[1], dome(gap=-0.01 if self.load else 0.01), self.element),
            },
            {"slab": biphasic(soft, 0.1, low), "dome": biphasic(stiff, 0.1, high)},
            (Touch("dome-z0", "slab-z1", "sliding-biphasic", self.params),),
            (
                fixed("slab-z0"),
                fixed("dome-z1", "y"),
                across,
                press("dome-z1", self.load) if self.load else moved("dome-z1", "z", -0.12),
                *(drained(end) for end in ("slab-z0", "dome-z1")),
            ),
            self.scheme,
            module="biphasic",
        )


def salty(params: str, charges: tuple[float, float], way: float = 0.0, scheme: Scheme = USUAL) -> Sketch:
    """A charged dome is pressed into a charged slab; salt and solvent cross."""
    outside = -GAS * 2.0 * SALT
    ends = ("slab-z0", "dome-z1")
    held = [
        f'<bc type="prescribed fluid pressure" node_set="{end}"><value>{outside:g}</value><relative>0</relative></bc>'
        for end in ends
    ]
    held += [
        f'<bc type="prescribed concentration" node_set="{end}"><dof>c{n}</dof><value>{SALT:g}</value>'
        "<relative>0</relative></bc>"
        for end in ends
        for n in (1, 2)
    ]
    held += [
        f'<ic type="initial concentration" node_set="{body}"><dof>c{n}</dof><value>{SALT:g}</value></ic>'
        for body in ("slab", "dome")
        for n in (1, 2)
    ]
    held += [
        f'<ic type="initial fluid pressure" node_set="{body}"><value>{outside:g}</value></ic>'
        for body in ("slab", "dome")
    ]
    ambient = f"<ambient_pressure>{outside:g}</ambient_pressure>" + "".join(
        f'<ambient_concentration sol="{n}">{SALT:g}</ambient_concentration>' for n in (1, 2)
    )
    across = moved("dome-z1", "x", way, 2) if way else fixed("dome-z1", "x")
    return Sketch(
        {"slab": mapped((6, 6, 3), box((-1, -1, -0.8), (1, 1, 0))), "dome": mapped((4, 4, 3), dome())},
        {"slab": charged(1.0, charges[0]), "dome": charged(2.0, charges[1])},
        (Touch("dome-z0", "slab-z1", "sliding-multiphasic", params + ambient),),
        (fixed("slab-z0"), fixed("dome-z1", "y"), across, moved("dome-z1", "z", -0.1), *held),
        scheme,
        module="multiphasic",
        globals=f"<Solutes>{IONS}</Solutes>",
    )


CHARGED: Mapping[str, Drawn] = {
    "layers-tight-on-open": Drawn(
        "a dome with a very low permeability on a slab with a million times this permeability", Layers((1.0, 1e-6))
    ),
    "layers-open-on-tight": Drawn(
        "a dome with a million times the slab's permeability, hex20", Layers((1e-6, 1.0), element="hex20")
    ),
    "layers-tight-slides": Drawn(
        "layers of very different permeability slide, friction 0.1, two passes",
        Layers((1e-1, 1e-5), USUALLY + friction(0.1) + TWO_PASS, way=0.3, scheme=Scheme(20)),
    ),
    "layers-stiff-on-soft-load": Drawn(
        "a stiff porous dome on a soft slab under a pressure", Layers((1e-3, 1e-3), modulus=(0.2, 20.0), load=0.03)
    ),
    "layers-augmented-bfgs": Drawn(
        "porous layers of a permeability ratio of 1e4, AUGLAG with a small penalty, BFGS",
        Layers((1e-4, 1.0), auglag(0.2, 0.1, NEAR + fluid(0.2)), scheme=Scheme(updates=10)),
    ),
    "salty": Drawn("layers with fixed charge, two ions cross", lambda: salty(_SALT, (-20.0, -20.0))),
    "salty-unlike": Drawn(
        "a charged layer on a layer without charge, two ions cross", lambda: salty(_SALT, (-20.0, 0.0))
    ),
    "salty-slides-two-pass": Drawn(
        "charged layers slide, two passes", lambda: salty(_SALT + TWO_PASS, (-20.0, -10.0), 0.3, Scheme(20))
    ),
}
