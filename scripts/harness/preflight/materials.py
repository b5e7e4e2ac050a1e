"""Material properties of a model file in the undeformed state, as far as they are numbers there."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from harness.errors import ModelError
from harness.preflight.xml_file import Document, Element, attribute, children, optional_number, place

POROUS = ("biphasic", "biphasic-solute", "triphasic", "multiphasic", "multiphasic-multigeneration")
RIGID = "rigid body"
_MIXTURES_OF_SOLIDS = ("solid mixture", "uncoupled solid mixture", "multigeneration")
_FIBRE = re.compile("fiber|fibre|fib-|CFD|continuous|ellipsoidal|spherical", re.IGNORECASE)
"""Parts of names of solids that have no stiffness in the undeformed state or little."""


@dataclass(frozen=True)
class Solute:
    """Transport of a solute; NaN where the file does not have a number."""

    # d and d0, mm^2/s.
    diffusivity: float
    free_diffusivity: float
    solubility: float


@dataclass(frozen=True)
class Material:
    """A material; properties are NaN where the file does not have them as numbers."""

    name: str
    kind: str
    modulus: float  # Young's modulus of the solid matrix, MPa; infinite for rigid bodies
    permeability: float  # mm^4/(N s); 0 for solids without pores
    porosity: float
    osmotic: float  # osmotic coefficient Phi
    solutes: Mapping[int, Solute]  # by the number of the solute in the model
    tag: Element

    @property
    def porous(self) -> bool:
        """Whether it holds a fluid."""
        return self.kind in POROUS

    @property
    def rigid(self) -> bool:
        """Whether it is a rigid body."""
        return self.kind == RIGID

    def solute_conductivity(self, solute: int) -> float:
        """phi_w kappa~ d, mm^2/s; 0 where it does not have the solute."""
        own = self.solutes.get(solute)
        return self.porosity * own.solubility * own.diffusivity if own else 0.0


def read(document: Document, solutes: Mapping[str, int]) -> dict[str, Material]:
    """The materials, by their names; `solutes` are numbers of solutes, by number and name as in the file."""
    return {attribute(tag, "name"): _material(tag, solutes) for tag in document.all("Material", "material")}


def _material(tag: Element, solutes: Mapping[str, int]) -> Material:
    kind = attribute(tag, "type")
    porous = kind in POROUS
    solid = tag.find("solid") if porous or kind.endswith("-FSI") else tag
    own: dict[int, Solute] = {}
    for child in children(tag, "solute") if porous else ():
        number = solutes.get(str(child.get("sol")))
        if number is None:
            known = ", ".join(solutes) or "none: <Globals> has no <Solutes>"
            raise ModelError(f"{place(child)}: is a solute that the model does not have; there is {known}")
        own[number] = _solute(child)
    return Material(
        name=str(tag.get("name")),
        kind=kind,
        modulus=math.inf if kind == RIGID else _modulus(solid),
        permeability=_permeability(tag.find("permeability")) if porous else 0.0,
        porosity=1.0 - optional_number(tag, "phi0", 0.0) if porous else 0.0,
        osmotic=_property(tag.find("osmotic_coefficient"), "osmcoef"),
        solutes=MappingProxyType(own),
        tag=tag,
    )


def _modulus(solid: Element | None) -> float:
    """Young's modulus at no strain: E, or 6 (c1 + c2) of a nearly incompressible Mooney-Rivlin solid."""
    if solid is None:
        return math.nan
    kind = str(solid.get("type"))
    if kind in _MIXTURES_OF_SOLIDS:
        parts = [part for tag in ("solid", "generation") for part in children(solid, tag)]
        inner = [part.find("solid") if part.tag == "generation" else part for part in parts]
        known = [_modulus(part) for part in inner if part is not None and not _FIBRE.search(str(part.get("type")))]
        return sum(known) if known else math.nan
    if solid.find("E") is not None:
        return optional_number(solid, "E")
    if "Mooney-Rivlin" in kind:
        return 6.0 * (optional_number(solid, "c1") + optional_number(solid, "c2", 0.0))
    return math.nan


def _permeability(law: Element | None) -> float:
    """Of the undeformed material: perm, or perm0 + perm1 + perm2 of the laws that refer to the initial state."""
    if law is None:
        return math.nan
    if law.find("perm") is not None:
        return optional_number(law, "perm")
    if law.get("type") == "perm-ref-iso":
        return sum(optional_number(law, f"perm{k}", 0.0) for k in range(3))
    return math.nan


def _solute(tag: Element) -> Solute:
    law = tag.find("diffusivity")
    free = _property(law, "free_diff")
    diffusivity = _property(law, "diff")
    if law is not None and law.get("type") == "diff-ref-iso":
        diffusivity = sum(optional_number(law, f"diff{k}", 0.0) for k in range(3))
    return Solute(diffusivity, free, _property(tag.find("solubility"), "solub"))


def _property(law: Element | None, tag: str) -> float:
    return math.nan if law is None else optional_number(law, tag)
