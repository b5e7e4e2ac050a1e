"""Materials of the knee.

Sources
-------
Elastic tissue: Haut Donahue, Hull, Rashid and Jacobs (2002), J Biomech Eng 124:273: cartilage 15 MPa and 0.475, menisci
150 MPa around and 20 MPa across. Porous cartilage: Soltz and Ateshian (2000), J Biomech Eng 122:576: aggregate modulus
0.64 MPa in compression and 13.2 MPa in tension; permeability as in Athanasiou et al. (1991), J Orthop Res 9:330. Porous
menisci: Joshi, Suh, Marui and Woo (1995), J Biomed Mater Res 29:823: 0.22 MPa and 2e-3 mm^4/(N s). Their fibres around
are those of the elastic ones, and a tenth of these go across. The solute is a small neutral molecule.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from harness.models.interface import InterfaceType
from harness.models.knee.whole_mesh import FEMORAL, FEMUR, MENISCAL, TIBIA, TIBIAL
from harness.models.parts import Elastic, Element, Material, Mixture, Rigid, Solid, Solute, child


class Bodies(str, Enum):
    """What cartilage and menisci are."""

    ELASTIC = "elastic"
    BIPHASIC = "biphasic"
    SOLUTE = "solute"

    @property
    def module(self) -> str:
        """FEBio's module."""
        return {Bodies.ELASTIC: "solid", Bodies.BIPHASIC: "biphasic", Bodies.SOLUTE: "multiphasic"}[self]

    @property
    def febio_interface(self) -> InterfaceType:
        """FEBio's interface for such bodies."""
        return {
            Bodies.ELASTIC: InterfaceType.ELASTIC,
            Bodies.BIPHASIC: InterfaceType.BIPHASIC,
            Bodies.SOLUTE: InterfaceType.MULTIPHASIC,
        }[self]


AROUND, ACROSS = (1, 2), (1, 4)
"""Nodes of an element: fibres go from the first to the second. Both directions lie in the articular surfaces."""
TOE = 1.01
"""Stretch at which all fibres are straight."""


@dataclass(frozen=True)
class Fibrous(Solid):
    """Neo-Hookean matrix with fibres along edges of the elements, which bear tension alone.

    Attributes
    ----------
    fibres : tuple of ((int, int), float)
        Nodes of an element between which fibres go, and Young's modulus that straight fibres add along themselves, MPa.
    """

    fibres: tuple[tuple[tuple[int, int], float], ...] = ()

    def write(self, parent: Element, tag: str = "solid") -> Element:
        """Append the solid to `parent` under the name `tag`."""
        made = child(parent, tag, type="solid mixture")
        super().write(made)
        for nodes, modulus in self.fibres:
            fibre = child(made, "solid", type="fiber-pow-linear")
            child(fibre, "E", modulus)
            child(fibre, "lam0", TOE)
            child(fibre, "beta", 2.0)
            child(fibre, "fiber", nodes, type="local")
        return made


CARTILAGE, MENISCUS = Solid(15.0, 0.475), Fibrous(20.0, 0.3, ((AROUND, 130.0),))
POROUS_CARTILAGE = Fibrous(0.64, 0.0, ((AROUND, 12.6), (ACROSS, 12.6)))
POROUS_MENISCUS = Fibrous(0.22, 0.0, ((AROUND, 130.0), (ACROSS, 13.0)))
CARTILAGE_PERMEABILITY, MENISCUS_PERMEABILITY = 1.2e-3, 2e-3
"""mm^4/(N s)."""
SOLUTE = Solute(diffusivity=3e-4, free_diffusivity=5e-4)


def materials(bodies: Bodies, centre: tuple[float, float, float]) -> Mapping[str, Material]:
    """Materials by name; forces on the femur act at `centre`, about which it turns, mm."""
    cartilage, meniscus = _soft(bodies)
    soft = {FEMORAL: cartilage, TIBIAL: cartilage, MENISCAL: meniscus}
    return {**soft, FEMUR: Rigid(centre), TIBIA: Rigid()}


def _soft(bodies: Bodies) -> tuple[Material, Material]:
    """Cartilage and menisci."""
    if bodies is Bodies.ELASTIC:
        return Elastic(CARTILAGE), Elastic(MENISCUS)
    solutes = (SOLUTE,) if bodies is Bodies.SOLUTE else ()
    return (
        Mixture(POROUS_CARTILAGE, CARTILAGE_PERMEABILITY, solutes=solutes),
        Mixture(POROUS_MENISCUS, MENISCUS_PERMEABILITY, solutes=solutes),
    )
