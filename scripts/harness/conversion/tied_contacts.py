"""What becomes of FEBio's tied contacts: `tied-mixture`."""

from collections.abc import Iterator

import numpy as np

from harness.conversion import spans
from harness.conversion.fates import NO_DIFFERENCE, Action, Change, Changes, rewritten
from harness.preflight.byte_spans import Span
from harness.preflight.contact_types import ANY_DISTANCE, STICKY
from harness.preflight.sides import SIDES, Joint
from harness.preflight.xml_file import as_number

TOUCHING = 1e-6  # gap over the width of the facets below which surfaces touch

DROPPED = {
    "two_pass": "each condition occurs once; two passes would hold each node twice",
    "knmult": "the linearisation is always complete; the parameter changes iterations, not the solution",
    "symmetric_stiffness": "the tangent is symmetric, and FEBio's solver decides on the matrix",
    "search_tolerance": "the tie includes nodes at the edge of the other surface if it covers their facets",
    "special": "the search along normals needs no special cases",
    "gap_offset": "the tie always keeps an initial gap",
    "snap_tol": "the surfaces touch within this distance at the start, when the tie finds its nodes",
    "offset_shells": "the tie always keeps an initial gap, for example half the thickness of a shell",
}
"""Parameters without a meaning in `tied-mixture` that do not change the answer."""
KEPT = {
    "tolerance": "limits gaps and jumps relative to the drop across the adjoining elements, not the change of "
    "multipliers",
    "auto_penalty": "uses the stiffness of both sides in series instead of one side; both agree for equal sides",
    "gaptol": "limits the value at nodes instead of integration points",
    "ptol": "limits the value at nodes instead of integration points",
    "ctol": "limits the value at nodes instead of integration points",
    "search_radius": "always a length",
    "node_reloc": "nodes move along their normals instead of to the closest point",
}
"""What differs in parameters that stay."""
BREAKS = "broken nodes are in sliding contact, whereas sticky ties them again"
NEVER = 1e6  # times the strength in tension: a strength in shear that no load reaches
_PENALTY = "convert writes FEBio's default; an automatic penalty would leave far smaller gaps"
_LIMITLESS = (
    "convert writes a radius, because FEBio's type has no limit; the default ties no nodes farther than a quarter of "
    "a facet"
)


def stays(joint: Joint) -> str:
    """Why a tie cannot become `tied-mixture`; empty where it can."""
    contact = joint.contact
    if contact.kind.name != STICKY:
        return ""
    if contact.step > 1:
        return "sticky in a later analysis step ties the nodes that touch at that time, which convert cannot predict"
    gaps = joint.facing().gaps - contact.value("gap_offset", 0.0)
    apart = float(np.nanmax(gaps)) if np.isfinite(gaps).any() else np.inf
    if apart > max(contact.value("snap_tol", 0.0), _touching(joint)):
        return (
            "sticky ties nodes when they come to touch in the run, and its surfaces are "
            f"{'apart' if np.isinf(apart) else f'up to {apart:.3g} apart'}; "
            "tied-mixture ties the nodes that touch at the start"
        )
    return ""


def _touching(joint: Joint) -> float:
    return TOUCHING * float(np.sqrt(np.median(joint.primary.area)))


def parameters(data: bytes, contact: Span, joint: Joint) -> Changes:
    """Edits of the parameters of a tie, and what each does."""
    if joint.contact.kind.name in ANY_DISTANCE:
        joint = joint.facing()
    yield from (([], change) for change in _kept_gap(contact, joint))
    written = list(_written(data, contact, joint))
    yield from rewritten(data, contact, lambda name, value: _fate(joint, name, value), written)


def _kept_gap(contact: Span, joint: Joint) -> Iterator[Change]:
    """What becomes of a gap that FEBio's type would close under stress."""
    kind, tie = joint.contact.kind, joint.contact
    keeps_gap = kind.name not in ANY_DISTANCE or (kind.name == "tied-facet-on-facet" and tie.on("gap_offset"))
    if keeps_gap or tie.on("node_reloc"):
        return
    apart = joint.largest_gap
    if apart > _touching(joint):
        yield Change(
            Action.KEPT,
            "gap",
            contact.line,
            f"{kind.name} pulls surfaces together, under stress, that are up to {apart:.3g} apart or overlap; "
            "tied-mixture keeps the gap. <node_reloc> 1 closes it without stress",
        )


def _fate(joint: Joint, name: str, value: str) -> tuple[Action, str]:
    if joint.contact.kind.name == STICKY and name == "flip_secondary":
        return Action.DROPPED, "convert writes it again if the surface must be flipped"
    if joint.contact.kind.name == STICKY and name == "max_traction":
        breaks = joint.contact.value(name, 0.0) > 0.0
        return (Action.KEPT, BREAKS) if breaks else (Action.DROPPED, "the tie cannot break, as in FEBio")
    if name in DROPPED:
        return Action.DROPPED, DROPPED[name]
    if name in ("gaptol", "ptol", "ctol") and value.startswith("-"):
        return Action.DROPPED, "a negative tolerance has no effect in FEBio"
    if name == "max_distance":
        return Action.MAPPED, "becomes <search_radius>, which acts along normals"
    return Action.KEPT, KEPT.get(name, NO_DIFFERENCE)


def _written(data: bytes, contact: Span, joint: Joint) -> Iterator[tuple[str, str, str]]:
    """Parameters that the new contact needs: name, value, reason."""
    kind = joint.contact.kind
    given = {child.tag: spans.text(data, child) for child in contact.children}
    for name in ("penalty", "pressure_penalty", "concentration_penalty"):
        if name in kind.parameters and name not in given:
            yield name, "1", _PENALTY
    if "search_radius" in kind.parameters and "search_radius" not in given:
        yield "search_radius", "1", "convert writes FEBio's default"
    if kind.name in ANY_DISTANCE:
        yield from _of_any_distance(joint, given.get("max_distance", "0"))
    effects = _effects(joint)
    if effects:
        yield "effects", effects, f"written out: {kind.name} exchanges no other effect"


def _of_any_distance(joint: Joint, limit: str) -> Iterator[tuple[str, str, str]]:
    """What types need that look for the closest point: on shells on either side, and without a limit."""
    is_sticky = joint.contact.kind.name == STICKY
    for which in SIDES:
        if (which in joint.turned) != (is_sticky and joint.contact.on(f"flip_{which}")):
            yield f"flip_{which}", "1", "its facets face away from the other surface, which FEBio's type ignores"
    if as_number(limit) != 0.0:
        yield "search_radius", limit, "was <max_distance>"
    elif joint.largest_gap > 0:
        yield "search_radius", f"{1.1 * joint.largest_gap:.6g}", _LIMITLESS
    strength = joint.contact.value("max_traction", 0.0)
    if strength > 0.0:
        why = "an unreachable value, because FEBio's type does not break in shear"
        yield "max_shear", f"{NEVER * strength:.6g}", why


def _effects(joint: Joint) -> str:
    """What a type of FEBio's exchanges where the bodies could exchange more; empty where they cannot."""
    kind = joint.contact.kind
    if not kind.solvent:
        return "traction" if all(side.porous for side in joint.sides) else ""
    shares_solutes = bool(joint.primary.solutes & joint.secondary.solutes)
    return "traction,solvent" if not kind.solutes and shares_solutes else ""
