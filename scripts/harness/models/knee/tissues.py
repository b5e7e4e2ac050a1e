"""Materials of the knee.

Sources
-------
Haut Donahue, Hull, Rashid and Jacobs (2002), J Biomech Eng 124:273: cartilage 15 MPa and 0.475, menisci 150 MPa around
and 20 MPa across.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from harness.models.knee.whole_mesh import FEMORAL, FEMUR, MENISCAL, TIBIA, TIBIAL
from harness.models.parts import Elastic, Element, Material, Rigid, Solid, child

TOE = 1.01
"""Stretch at which all fibres are straight."""


@dataclass(frozen=True)
class Fibrous(Solid):
    """Neo-Hookean matrix with fibres along the first edges of the elements, which bear tension alone.

    Attributes
    ----------
    fibres : float
        Young's modulus that straight fibres add along themselves, MPa.
    """

    fibres: float = 0.0

    def write(self, parent: Element, tag: str = "solid") -> Element:
        """Append the solid to `parent` under the name `tag`."""
        made = child(parent, tag, type="solid mixture")
        super().write(made)
        fibres = child(made, "solid", type="fiber-pow-linear")
        child(fibres, "E", self.fibres)
        child(fibres, "lam0", TOE)
        child(fibres, "beta", 2.0)
        child(fibres, "fiber", (1, 2), type="local")
        return made


CARTILAGE, MENISCUS = Elastic(Solid(15.0, 0.475)), Elastic(Fibrous(20.0, 0.3, fibres=130.0))


def materials(centre: tuple[float, float, float]) -> Mapping[str, Material]:
    """Materials by name; forces on the femur act at `centre`, about which it turns, mm."""
    return {FEMORAL: CARTILAGE, TIBIAL: CARTILAGE, MENISCAL: MENISCUS, FEMUR: Rigid(centre), TIBIA: Rigid()}
