"""Layers of very different permeability, and charged layers with salt in them."""

from collections.abc import Mapping
from dataclasses import dataclass

from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported.pressed import dome
from studies.synthetic_scenes.reported.shapes import box, mapped
from studies.synthetic_scenes.reported.sketch import USUAL, Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import (
    TWO_PASS,
    auglag,
    auto,
    biphasic,
    drained,
    fluid,
    friction,
    press,
    radius,
)

NEAR = radius(0.5)
USUALLY = auto(1.0, NEAR + fluid(1.0))
"""Parameters of a contact between layers that a scene does not say otherwise."""
GAS = 8.314e-6 * 298.0
"""R T, mJ/nmol."""
SALT = 100.0
"""mM of either ion outside."""
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


_SALT = auto(1.0, NEAR + fluid(1.0, 1.0))
SCENES: Mapping[str, Drawn] = {
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
