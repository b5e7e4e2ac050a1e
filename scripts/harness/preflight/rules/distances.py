"""Rules on gaps and overlaps at the start."""

import math
from collections.abc import Iterator

import numpy as np

from harness.preflight.finding import Finding, note, short, warning
from harness.preflight.sides import Joint

DEEP = 0.25
"""Overlap over the thickness of the elements beyond which the first iteration is in danger; a press fit has less."""
COARSER = 3.0  # how much larger the facets of the primary surface may be


def search_radius(joint: Joint) -> Iterator[Finding]:
    """Surfaces farther apart, or overlapping by more, than contact is looked for."""
    known = joint.gaps[np.isfinite(joint.gaps)]
    radius = joint.search_radius
    if not len(known) or (np.abs(known) <= radius).any():
        return
    given = joint.contact.given("search_radius")
    tag = joint.contact.tag if given is None else given
    nearest = float(known[np.argmin(np.abs(known))])
    where = "set" if given is not None else "the default"
    if nearest < 0.0:
        yield warning(
            "search-radius",
            tag,
            f"the surfaces overlap by {short(-nearest)} at the start, more than <search_radius> {short(radius)} "
            f"({where}): the contact does not find this overlap. The bodies pass through each other, unless the "
            "overlap is that of the far side of a body",
            f"Move the bodies apart, or set <search_radius> to {short(-1.5 * nearest)}.",
        )
    else:
        yield warning(
            "search-radius",
            tag,
            f"the surfaces are {short(nearest)} apart at the start, more than <search_radius> {short(radius)} "
            f"({where}): a body that moves farther in one step passes through the other",
            f"Start with the bodies just touching, or set <search_radius> to {short(1.5 * nearest)}.",
        )


def initial_overlap(joint: Joint) -> Iterator[Finding]:
    """Overlap at the start that is large for the elements."""
    overlap = -joint.smallest_gap
    if not overlap > DEEP * joint.thickness or joint.contact.on("node_reloc"):
        return
    yield warning(
        "initial-overlap",
        joint.contact.tag,
        f"the surfaces overlap by {short(overlap)} at the start, {short(overlap / joint.thickness)} of the thickness "
        "of the elements there. The first step separates them at once, which may invert elements",
        "Move one body, or set <node_reloc> to 1, which moves the nodes of the primary surface onto the other.",
    )


def finer_primary(joint: Joint) -> Iterator[Finding]:
    """A primary surface that is much coarser than the other one."""
    if any(not len(side.area) or not side.area.any() for side in joint.sides) or joint.contact.on("two_pass"):
        return
    one, two = (math.sqrt(float(np.median(side.area))) for side in joint.sides)
    if two > 0.0 and one > COARSER * two and not joint.primary.rigid:
        seen = (
            f"facets of the primary surface are {short(one / two)} times as wide as those of the secondary one: "
            "the contact resolves its edge to one facet of the primary surface"
        )
        yield note("finer-primary", joint.contact.pair.tag, seen, "Exchange <primary> and <secondary>.")


RULES = (search_radius, initial_overlap, finer_primary)
