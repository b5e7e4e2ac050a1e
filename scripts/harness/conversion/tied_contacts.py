"""What becomes of FEBio's tied contacts: `tied-mixture`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from harness.conversion import spans
from harness.conversion.fates import NO_DIFFERENCE, Action, Change, is_zero
from harness.conversion.spans import Edit
from harness.preflight.byte_spans import Span
from harness.preflight.contact_types import STICKY
from harness.preflight.sides import SIDES, Joint
from harness.preflight.tied_types import ANY_DISTANCE, keeps_gaps

TOUCHING = 1e-6
"""Gap over the width of the facets below which surfaces touch."""

DROPPED = {
    "two_pass": "a condition stands once: in two passes each node is held twice",
    "knmult": "the linearisation is always complete; it changes the iterations alone",
    "symmetric_stiffness": "the tangent is symmetric, and the matrix is what FEBio's solver asks for",
    "search_tolerance": "nodes at the edge of the other surface are tied as far as it covers the facets around them",
    "special": "the search is along normals, which needs no special cases",
    "gap_offset": "an initial gap is always kept",
    "snap_tol": "the surfaces touch within it at the start, and what is tied is found then",
    "offset_shells": "an initial gap, such as half the thickness of a shell, is always kept",
}
"""Parameters without a meaning in `tied-mixture` that do not change the answer."""
KEPT = {
    "tolerance": "measures gaps and jumps over the drop across the adjoining elements, not the change of multipliers",
    "auto_penalty": "both sides count in series instead of one; the same where they are equal",
    "gaptol": "measured at nodes instead of integration points",
    "ptol": "measured at nodes instead of integration points",
    "ctol": "measured at nodes instead of integration points",
    "search_radius": "always a length",
    "node_reloc": "nodes move along their normals instead of to the closest point",
}
"""What differs in parameters that stay."""
NEVER = 1e6
"""Times the strength in tension: a strength in shear that no load reaches."""
_PENALTY = "FEBio's default, written out; without it the penalty is automatic, and gaps far smaller"
_LIMITLESS = "written out: FEBio's type has no limit; without it nodes farther than a quarter of a facet are not tied"


def stays(joint: Joint) -> str:
    """Why a tie cannot become `tied-mixture`; empty where it can."""
    contact = joint.contact
    if contact.kind.name != STICKY:
        return ""
    if contact.step > 1:
        return "sticky of a later analysis step ties what touches by then; where that is, is not known before the run"
    gaps = joint.facing().gaps - contact.value("gap_offset", 0.0)
    apart = float(np.nanmax(gaps)) if np.isfinite(gaps).any() else np.inf
    if apart > max(contact.value("snap_tol", 0.0), _touching(joint)):
        return (
            "sticky ties nodes when they come to touch in the run, and its surfaces are "
            f"{'apart' if np.isinf(apart) else f'up to {apart:.3g} apart'}; tied-mixture ties what touches at the start"
        )
    return ""


def _touching(joint: Joint) -> float:
    """The gap below which surfaces touch."""
    return TOUCHING * float(np.sqrt(np.median(joint.primary.area)))


def parameters(data: bytes, contact: Span, joint: Joint) -> Iterator[tuple[list[Edit], Change]]:
    """Edits of the parameters of a tie, and what each does."""
    if joint.contact.kind.name in ANY_DISTANCE:
        joint = joint.facing()
    yield from (([], change) for change in _kept_gap(contact, joint))
    for child in contact.children:
        change = _fate(joint, child, spans.text(data, child))
        gone = change.action is not Action.KEPT
        yield [spans.removal(data, child)] if gone else [], change
    written = list(_written(data, contact, joint))
    lines = [f"<{name}>{value}</{name}>" for name, value, _ in written]
    for number, (name, value, reason) in enumerate(written):
        change = Change(Action.MAPPED, name, contact.line, f"{value}: {reason}")
        yield spans.insertion(data, contact, lines) if number == 0 else [], change


def _kept_gap(contact: Span, joint: Joint) -> Iterator[Change]:
    """What becomes of a gap that FEBio's type would close under stress."""
    kind, tie = joint.contact.kind, joint.contact
    if keeps_gaps(kind, has_offset=tie.on("gap_offset")) or tie.on("node_reloc"):
        return
    apart = joint.largest_gap
    if apart > _touching(joint):
        yield Change(
            Action.KEPT,
            "gap",
            contact.line,
            f"{kind.name} draws surfaces together, under stress, that are up to {apart:.3g} apart or overlap; "
            "tied-mixture keeps the gap. <node_reloc> 1 closes it without stress",
        )


def _fate(joint: Joint, child: Span, value: str) -> Change:
    name = child.tag
    if joint.contact.kind.name == STICKY and name in ("flip_secondary", "max_traction"):
        return _sticky_fate(joint, child)
    if name in DROPPED:
        return Change(Action.DROPPED, name, child.line, DROPPED[name])
    if name in ("gaptol", "ptol", "ctol") and value.startswith("-"):
        return Change(Action.DROPPED, name, child.line, "a negative tolerance is none")
    if name == "max_distance":
        return Change(Action.MAPPED, name, child.line, "becomes <search_radius>, along normals")
    return Change(Action.KEPT, name, child.line, KEPT.get(name, NO_DIFFERENCE))


def _sticky_fate(joint: Joint, child: Span) -> Change:
    if child.tag == "flip_secondary":
        return Change(Action.DROPPED, child.tag, child.line, "written again where the surface has to be turned round")
    if not joint.contact.value(child.tag, 0.0) > 0.0:
        return Change(Action.DROPPED, child.tag, child.line, "the tie lasts, as it does in FEBio")
    return Change(
        Action.KEPT,
        child.tag,
        child.line,
        "judged at solutions instead of in iterations; nodes that have broken press and slide where they touch again, "
        "while sticky ties them again",
    )


def _written(data: bytes, contact: Span, joint: Joint) -> Iterator[tuple[str, str, str]]:
    """Parameters that the new contact needs: name, value, reason."""
    kind = joint.contact.kind
    given = {child.tag: spans.text(data, child) for child in contact.children}
    for name in ("penalty", "pressure_penalty", "concentration_penalty"):
        if name in kind.parameters and name not in given:
            yield name, "1", _PENALTY
    if "search_radius" in kind.parameters and "search_radius" not in given:
        yield "search_radius", "1", "FEBio's default, written out"
    if kind.name in ANY_DISTANCE:
        yield from _of_any_distance(joint, given.get("max_distance", "0"))
    effects = _effects(joint)
    if effects:
        yield "effects", effects, f"written out: {kind.name} exchanges nothing else"


def _of_any_distance(joint: Joint, limit: str) -> Iterator[tuple[str, str, str]]:
    """What types need that look for the closest point: on shells on either side, and without a limit."""
    is_sticky = joint.contact.kind.name == STICKY
    for which in SIDES:
        if (which in joint.turned) != (is_sticky and joint.contact.on(f"flip_{which}")):
            yield f"flip_{which}", "1", "its facets face away from the other surface, which FEBio's type does not ask"
    if not is_zero(limit):
        yield "search_radius", limit, "was <max_distance>"
    elif joint.largest_gap > 0:
        yield "search_radius", f"{1.1 * joint.largest_gap:.6g}", _LIMITLESS
    strength = joint.contact.value("max_traction", 0.0)
    if strength > 0.0:
        yield "max_shear", f"{NEVER * strength:.6g}", "out of reach: shear breaks nothing in FEBio's type"


def _effects(joint: Joint) -> str:
    """What a type of FEBio's exchanges where the bodies could exchange more; empty where they cannot."""
    kind = joint.contact.kind
    if not kind.solvent:
        return "traction" if all(side.porous for side in joint.sides) else ""
    shares_solutes = bool(joint.primary.solutes & joint.secondary.solutes)
    return "traction,solvent" if not kind.solutes and shares_solutes else ""
