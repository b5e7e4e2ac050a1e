"""What becomes of each parameter of FEBio's sliding interfaces, and why: the table of docs/reference/from-febio.md."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum

from harness.conversion import spans
from harness.conversion.spans import Edit
from harness.preflight.byte_spans import Span
from harness.preflight.contact_types import UNLIMITED_SEARCH, ContactType
from harness.preflight.xml_file import as_number, is_on


class Action(str, Enum):
    """What happens to a parameter."""

    KEPT = "kept"
    MAPPED = "mapped"
    DROPPED = "dropped"


@dataclass(frozen=True)
class Change:
    """What happened to one parameter, and why."""

    action: Action
    name: str
    line: int
    reason: str


Changes = Iterator[tuple[list[Edit], Change]]  # edits of a file, and what each of them does


DROPPED = {
    "knmult": "the linearisation is always complete; the parameter changes iterations, not the solution",
    "smooth_aug": "multipliers come from the nodal loads of the contact, which are smooth",
    "smooth_fls": "the contact always averages the fluid load support around nodes",
    "penalty_sf": "the parameter raises penalties between augmentations; sliding-mixture raises them automatically",
    "max_penalty_sf": "the parameter raises penalties between augmentations; sliding-mixture raises them automatically",
    "dual_proj": "the search always uses both surfaces",
    "dxtol": "this hidden parameter is the distance within which FEBio softens the tangent at first touch",
    "fric_penalty": "sticking friction has the penalty of the traction, and its elastic slip is small",
    "ktmult": "the linearisation is always complete; the parameter changes iterations, not the solution",
}
"""Parameters without a meaning in `sliding-mixture` that do not change the converged answer."""

KEPT = {
    "tolerance": "limits gaps and jumps relative to the drop across the adjoining elements, not the change of "
    "multipliers",
    "gaptol": "limits the value at nodes instead of integration points",
    "ptol": "limits the value at nodes instead of integration points",
    "ctol": "limits the value at nodes instead of integration points",
    "auto_penalty": "uses the stiffness of both sides in series instead of one side; both agree for equal sides",
    "two_pass": "each pass has its own nodes and multipliers",
    "search_radius": "is always a length",
    "maxaug": "gives a warning if it ends the augmentations of a step",
    "fric_coeff": "its bound holds at nodes instead of integration points, and is linear in traction and fluid "
    "pressure instead of a coefficient with a quotient of both",
    "contact_frac": "applies to the effective pressure in excess of the ambient one",
}
"""What differs in parameters that stay."""
NO_DIFFERENCE = "same meaning"

ZERO = {
    "penalty": "the contact has no effect with 0, as in FEBio",
    "pressure_penalty": "no solvent crosses with 0, as in FEBio",
    "concentration_penalty": "no solute crosses with 0, as in FEBio",
    "search_radius": "FEBio finds no facets within a radius of 0, and its contact has no effect; the radius of "
    "sliding-mixture is then automatic, and the contact acts",
}
"""What 0 means, of parameters that may be 0."""
WITHOUT_LIMIT = "FEBio has no limit with 0; the radius of sliding-mixture is then automatic"
SYMMETRIC = "a symmetric tangent needs more iterations for the same solution; the default tangent is complete"
DEFAULT = "1"
"""FEBio's default of each of these, where `sliding-mixture` chooses by itself: written, so the penalties stay."""
_PENALTY = "convert writes FEBio's default; an automatic penalty would be more accurate and give a different answer"
WRITTEN = {
    "penalty": _PENALTY,
    "pressure_penalty": _PENALTY,
    "concentration_penalty": _PENALTY,
    "search_radius": "convert writes FEBio's default; with tension, it also limits the gaps that bear load",
}
IMPERMEABLE = {"effects": "traction", "free_draining": "0"}
IMPERMEABLE_WITH_FRICTION = {"effects": "traction,friction", "free_draining": "0", "contact_frac": "1"}
NO_FRICTION = {
    "sliding-facet-on-facet": "FEBio sets it to 0: sliding-facet-on-facet has no friction",
    "sliding-node-on-facet": "without a <fric_penalty> above 0 sliding-node-on-facet has no friction",
}
"""Why a friction coefficient does nothing in FEBio."""
TRACTION_ALONE = (
    "convert writes this value: FEBio's type transmits traction alone, and the model decides on the surfaces of "
    "porous bodies"
)
"""What keeps fluid and solutes of the bodies where FEBio's type does, and friction acting on all of the traction."""


def fate(kind: ContactType, name: str, value: str, *, rubs: bool) -> tuple[Action, str]:
    """What becomes of a parameter with a value, for a contact of a type, and why; `rubs`: the contact has friction."""
    if not rubs and name in ("contact_frac", "smooth_fls", "fric_penalty", "ktmult"):
        return Action.DROPPED, "has an effect with friction alone"
    if not rubs and name == "fric_coeff" and as_number(value) != 0.0:
        return Action.DROPPED, NO_FRICTION[kind.name]
    if name in DROPPED:
        return Action.DROPPED, DROPPED[name]
    if name in ZERO and as_number(value) == 0.0:
        return Action.KEPT, WITHOUT_LIMIT if name == "search_radius" and kind.name in UNLIMITED_SEARCH else ZERO[name]
    if name == "symmetric_stiffness" and is_on(value):
        return Action.DROPPED, SYMMETRIC
    return Action.KEPT, KEPT.get(name, NO_DIFFERENCE)


def missing(kind: ContactType, given: set[str]) -> Iterator[str]:
    """Defaults of FEBio's that have to be written out for a contact of a type."""
    known = (name for name in WRITTEN if name in kind.parameters and name not in given)
    return (name for name in known if name != "search_radius" or "tension" in given)


def rewritten(
    data: bytes,
    contact: Span,
    fate_of: Callable[[str, str], tuple[Action, str]],
    written: Sequence[tuple[str, str, str]],
) -> Changes:
    """Edits of the parameters of a contact, and what each does.

    fate_of: what becomes of a parameter of a name and a value, and why.
    written: name, value and reason of each parameter that is added.
    """
    for child in contact.children:
        action, reason = fate_of(child.tag, spans.text(data, child))
        gone = [] if action is Action.KEPT else [spans.removal(data, child)]
        yield gone, Change(action, child.tag, child.line, reason)
    lines = [f"<{name}>{value}</{name}>" for name, value, _ in written]
    for place, (name, value, reason) in enumerate(written):
        change = Change(Action.MAPPED, name, contact.line, f"{value}: {reason}")
        yield spans.insertion(data, contact, lines) if place == 0 else [], change
