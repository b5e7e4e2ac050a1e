"""What becomes of each parameter of FEBio's sliding interfaces, and why: the table of docs/reference/from-febio.md."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum

from harness.preflight.contact_types import UNLIMITED_SEARCH, ContactType
from harness.preflight.xml_file import is_on


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


DROPPED = {
    "knmult": "the linearisation is always complete; it changes the iterations alone",
    "smooth_aug": "multipliers take the contact's own loads at nodes, which are smooth",
    "smooth_fls": "the part of the load that the fluid bears is always averaged around nodes",
    "penalty_sf": "acts between augmentations alone; penalties grow by themselves",
    "max_penalty_sf": "acts between augmentations alone; penalties grow by themselves",
    "dual_proj": "pairs of facets are always found from both surfaces",
    "dxtol": "a hidden parameter: the width within which FEBio softens the tangent at first touch",
    "fric_penalty": "friction that sticks has the penalty of the traction, so that its elastic slip is small",
    "ktmult": "the linearisation is always complete; it changes the iterations alone",
}
"""Parameters without a meaning in `sliding-mixture` that do not change the converged answer."""

KEPT = {
    "tolerance": "measures gaps and jumps over the drop across the adjoining elements, not the change of multipliers",
    "gaptol": "measured at nodes instead of integration points",
    "ptol": "measured at nodes instead of integration points",
    "ctol": "measured at nodes instead of integration points",
    "auto_penalty": "both sides count in series instead of one; the same where they are equal",
    "two_pass": "each pass has nodes and multipliers of its own",
    "search_radius": "always a length",
    "maxaug": "a warning where it ends a step",
    "fric_coeff": "its bound holds at nodes instead of integration points, and is linear in traction and fluid "
    "pressure instead of a coefficient with a quotient of both",
    "contact_frac": "counts with what the effective pressure exceeds the ambient one by",
}
"""What differs in parameters that stay."""
NO_DIFFERENCE = "same meaning"

ZERO = {
    "penalty": "0: the contact does nothing, in FEBio and here",
    "pressure_penalty": "0: no solvent passes, in FEBio and here",
    "concentration_penalty": "0: no solute passes, in FEBio and here",
    "search_radius": "FEBio sees nothing within a radius of 0, so its contact does nothing; here the radius follows "
    "the size of the surfaces and the contact works",
}
"""What 0 means, of parameters that may be 0."""
DEFAULT = "1"
"""FEBio's default of each of these, where `sliding-mixture` chooses by itself: written, so the penalties stay."""
_PENALTY = "FEBio's default, written out; without it the penalty is automatic and accurate, and the answer another"
WRITTEN = {
    "penalty": _PENALTY,
    "pressure_penalty": _PENALTY,
    "concentration_penalty": _PENALTY,
    "search_radius": "FEBio's default, written out; without it the radius follows the size of the surfaces",
}
IMPERMEABLE = {"effects": "traction", "free_draining": "0"}
IMPERMEABLE_WITH_FRICTION = {"effects": "traction,friction", "free_draining": "0", "contact_frac": "1"}
NO_FRICTION = {
    "sliding-facet-on-facet": "FEBio sets it to 0: sliding-facet-on-facet has no friction",
    "sliding-node-on-facet": "without a <fric_penalty> above 0 sliding-node-on-facet has no friction",
}
"""Why a friction coefficient does nothing in FEBio."""
TRACTION_ALONE = "written out: FEBio's type knows traction alone and leaves the surfaces of porous bodies to the model"
"""What keeps fluid and solutes of the bodies where FEBio's type does, and friction acting on all of the traction."""


def fate(kind: ContactType, name: str, value: str, *, rubs: bool = False) -> Callable[[int], Change]:
    """What becomes of a parameter with a value, for a contact of a type, as a function of its line.

    `rubs`: the contact has friction.
    """
    action, reason = _fate(kind, name, value) if rubs else _frictionless_fate(kind, name, value)
    return lambda line: Change(action, name, line, reason)


def _frictionless_fate(kind: ContactType, name: str, value: str) -> tuple[Action, str]:
    if name in ("contact_frac", "smooth_fls", "fric_penalty", "ktmult"):
        return Action.DROPPED, "acts with friction alone"
    if name == "fric_coeff" and not is_zero(value):
        return Action.DROPPED, NO_FRICTION[kind.name]
    return _fate(kind, name, value)


def _fate(kind: ContactType, name: str, value: str) -> tuple[Action, str]:
    if name in DROPPED:
        return Action.DROPPED, DROPPED[name]
    if name in ZERO and is_zero(value):
        return Action.KEPT, _zero(kind, name)
    if name == "symmetric_stiffness" and is_on(value):
        return Action.DROPPED, "a symmetric tangent costs iterations and changes nothing else; the default is complete"
    return Action.KEPT, KEPT.get(name, NO_DIFFERENCE)


def _zero(kind: ContactType, name: str) -> str:
    if name == "search_radius" and kind.name in UNLIMITED_SEARCH:
        return "0 has no limit in FEBio; here the radius follows the size of the surfaces"
    return ZERO[name]


def missing(kind: ContactType, given: set[str]) -> Iterator[str]:
    """Defaults of FEBio's that have to be written out for a contact of a type."""
    known = (name for name in WRITTEN if name in kind.parameters and name not in given)
    return (name for name in known if not (name == "search_radius" and kind.name in UNLIMITED_SEARCH))


def is_zero(value: str) -> bool:
    """Whether the text of a parameter is the number 0."""
    try:
        return float(value) == 0.0
    except ValueError:
        return False
