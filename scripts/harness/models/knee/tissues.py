"""Materials of cartilage and menisci, elastic or porous, and the synovial fluid around porous ones.

Sources
-------
Elastic: Haut Donahue, Hull, Rashid and Jacobs (2002), J Biomech Eng 124:273, cartilage 15 MPa and 0.475, menisci
150 MPa around and 20 MPa across.

Porous: Athanasiou et al. (1991), J Orthop Res 9:330, human femoral condyles, aggregate modulus 0.6 to 0.7 MPa,
Poisson's ratio 0.1, permeability 1.2e-3 mm^4/(N s); Soltz and Ateshian (2000), J Biomech Eng 122:576, cartilage under
tension in three orthogonal directions, 12.75 MPa; Danso, Julkunen and Korhonen (2018), J Biomech, menisci under
compression, 0.18 MPa and 0.32; Sweigart et al. (2004), Ann Biomed Eng 32:1569, permeability of human menisci, 1 to
2e-3 mm^4/(N s); tension of menisci as in elastic ones.

Solute: glucose. Torzilli et al. (1998), J Biomed Mater Res 40:132, 6.1e-4 mm^2/s in cartilage; 9e-4 mm^2/s in water.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

from harness.models import parts
from harness.models.interface import ContactSettings, InterfaceType, automatic
from harness.models.knee.whole_mesh import BATH, POROUS

TOE = 1.01  # stretch at which all fibres are straight
AROUND, ACROSS, UP = (1, 2), (1, 4), (1, 5)
"""Edges of an element along which fibres go, by their nodes: in menisci around, to the inner edge, and up."""


@dataclass(frozen=True)
class Fibrous(parts.Solid):
    """Neo-Hookean matrix with fibres along edges of the elements, which bear tension alone."""

    # Young's modulus that straight fibres add along an edge, MPa.
    fibres: Mapping[tuple[int, int], float] = field(default_factory=dict)

    def write(self, parent: parts.Element, tag: str = "solid") -> parts.Element:
        made = parts.child(parent, tag, type="solid mixture")
        super().write(made)
        for edge, modulus in self.fibres.items():
            fibres = parts.child(made, "solid", type="fiber-pow-linear")
            parts.fill(fibres, E=modulus, lam0=TOE, beta=2.0)
            parts.child(fibres, "fiber", edge, type="local")
        return made


@dataclass(frozen=True)
class Tissues:
    """What cartilage and menisci are, and what follows from it for a model."""

    module: str  # of FEBio
    cartilage: parts.Elastic | parts.Mixture
    meniscus: parts.Elastic | parts.Mixture
    theirs: InterfaceType  # FEBio's contact between them
    about: str  # the tissues in a sentence
    # At the start, and where synovial fluid wets them outside of contact surfaces.
    conditions: tuple[parts.Condition, ...] = ()
    ambient: tuple[parts.Param, ...] = ()  # the same fluid at open nodes of contacts

    @property
    def porous(self) -> bool:
        """Whether fluid flows in them."""
        return isinstance(self.cartilage, parts.Mixture)

    def automatic(self, factor: float) -> ContactSettings:
        """FEBio's automatic penalties times a factor, for what the tissues exchange."""
        scaled = automatic(factor)
        if not self.porous:
            scaled = replace(scaled, pressure_penalty=None)
        return scaled if self.cartilage.solutes else replace(scaled, concentration_penalty=None)


REST, BATH_LEVEL = 5.0, 7.0
"""Glucose in the tissues at the start, and in the synovial fluid, mM: that after a fast, and that after a meal.

Coarse elements undershoot at a front; with these levels they stay above zero, where FEBio's solver creates no solute.
"""
GLUCOSE = (parts.Solute(1, diffusivity=6e-4, free_diffusivity=9e-4),)


def _porous(solutes: tuple[parts.Solute, ...] = ()) -> tuple[parts.Mixture, parts.Mixture]:
    cartilage = Fibrous(0.65, 0.1, fibres={AROUND: 12.0, ACROSS: 12.0, UP: 12.0})
    meniscus = Fibrous(0.18, 0.3, fibres={AROUND: 150.0, ACROSS: 20.0, UP: 20.0})
    return parts.Mixture(cartilage, 1.2e-3, solutes=solutes), parts.Mixture(meniscus, 1.5e-3, solutes=solutes)


class Bodies(str, Enum):
    """Kinds of cartilage and menisci."""

    ELASTIC = "elastic"
    BIPHASIC = "biphasic"
    SOLUTE = "solute"


TISSUES: Mapping[Bodies, Tissues] = {
    Bodies.ELASTIC: Tissues(
        "solid",
        parts.Elastic(parts.Solid(15.0, 0.475)),
        parts.Elastic(Fibrous(20.0, 0.3, fibres={AROUND: 130.0})),
        InterfaceType.ELASTIC,
        "Elastic cartilage on rigid bone; elastic menisci\n"
        "with fibres along their arcs, whose horns springs hold to the tibia.",
    ),
    Bodies.BIPHASIC: Tissues(
        "biphasic",
        *_porous(),
        InterfaceType.BIPHASIC,
        "Biphasic cartilage on rigid bone; biphasic\n"
        "menisci, whose horns springs hold to the tibia. Fibres in three directions bear tension alone.",
        (parts.pressure(BATH, 0.0),),
    ),
    Bodies.SOLUTE: Tissues(
        "solute",
        *_porous(GLUCOSE),
        InterfaceType.SOLUTE,
        "Biphasic-solute cartilage on rigid bone;\n"
        "biphasic-solute menisci, whose horns springs hold to the tibia. Fibres in three directions bear tension.\n"
        "Glucose diffuses in from the synovial fluid.",
        (
            parts.pressure(BATH, parts.effective_pressure(BATH_LEVEL)),
            parts.concentration(BATH, BATH_LEVEL),
            parts.initial_pressure(POROUS, parts.effective_pressure(REST)),
            parts.initial_concentration(POROUS, REST),
        ),
        (
            parts.Param("ambient_pressure", parts.effective_pressure(BATH_LEVEL)),
            parts.Param("ambient_concentration", BATH_LEVEL),
        ),
    ),
}
