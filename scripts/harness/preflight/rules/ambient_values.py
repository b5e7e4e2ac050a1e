"""Rules on ambient values: effective pressures against effective concentrations."""

from collections.abc import Iterator, Sequence

import numpy as np

from harness.arrays import Array
from harness.preflight import levels
from harness.preflight.finding import Finding, note, short, warning
from harness.preflight.levels import prescribed_nodes
from harness.preflight.sides import Joint
from harness.preflight.xml_file import Element

CLOSE = 0.01  # relative agreement with R T Phi c
FAR = 1e4  # pressure over R T Phi c from which the units are in doubt


def without_effect(joint: Joint) -> Iterator[Finding]:
    """Ambient values where open nodes are left to the model."""
    for name in ("ambient_pressure", "ambient_concentration"):
        tag = joint.contact.given(name)
        if tag is not None and not joint.contact.drains:
            seen = f"<{name}> has no effect: <free_draining> is 0"
            yield note("not-drained", tag, seen, f"Delete <{name}>, or set <free_draining> to 1.")


def ambient(joint: Joint) -> Iterator[Finding]:
    """Ambient pressure of a contact that does not go with its ambient concentrations."""
    model, contact = joint.model, joint.contact
    if not contact.drains:
        return
    concentrations = levels.ambient_concentrations(model, contact)
    if not concentrations or not contact.kind.solutes:
        return
    pressure, histories = contact.given("ambient_pressure"), [model.history(tag) for tag in concentrations.values()]
    own = histories[0] * (1.0, 0.0) if pressure is None else model.history(pressure)
    where = contact.tag if pressure is None else pressure
    yield from _judge(where, *_over_time(joint, own, histories), "<ambient_pressure>", pressure is not None)


def prescribed(joint: Joint) -> Iterator[Finding]:
    """Nodes with a prescribed effective pressure that does not go with their prescribed concentrations."""
    for pressure, there in levels.pressures_with_concentrations(joint.model):
        if there:
            both = _over_time(joint, pressure.history, there)
            yield from _judge(pressure.tag, *both, "the prescribed effective pressure", True)


def initial(joint: Joint) -> Iterator[Finding]:
    """Bodies that begin with a concentration but without the effective pressure of an unpressurised gel."""
    model = joint.model
    pressures = list(levels.initial(model))
    known = {number: list(levels.initial(model, number)) for number in model.solute_numbers}
    for number, concentration in ((number, level) for number, group in known.items() for level in group):
        there = {k: match for k, group in known.items() if (match := levels.covering(concentration, group))}
        if number == min(there):
            osmotic = levels.osmotic_scale(joint) * sum(level.first for level in there.values())
            own = levels.covering(concentration, pressures)
            value, tag = (0.0, concentration.tag) if own is None else (own.first, own.tag)
            both = np.array([value]), np.array([osmotic])
            yield from _judge(tag, *both, "the initial effective pressure", own is not None)


def _over_time(joint: Joint, own: Array, concentrations: Sequence[Array]) -> tuple[Array, Array]:
    """A pressure, and R T Phi sum c, at all times of their histories."""
    when = levels.times([own, *concentrations])
    return levels.at(own, when), levels.osmotic(joint, concentrations, when)


def _judge(tag: Element, own: Array, osmotic: Array, what: str, given: bool) -> Iterator[Finding]:
    """At the time of the largest R T Phi c: p~ is to be -R T Phi c, plus the ambient fluid pressure if there is one.

    p~ = 0 and p~ = +R T Phi c are the usual slips, and a pressure far beyond R T Phi c is one of units.
    """
    if not np.isfinite(osmotic).all() or not np.isfinite(own).all() or not osmotic.any():
        return
    at = int(np.argmax(np.abs(osmotic)))
    expected, value = -float(osmotic[at]), float(own[at])
    fluid = value - expected
    slip = min(abs(fluid - k * abs(expected)) for k in (1.0, 2.0)) <= CLOSE * abs(expected)
    if not slip and abs(fluid) <= FAR * abs(expected):
        return
    have = f"is {short(value)}" if given else "is not set, so it is 0"
    yield warning(
        "ambient-pressure",
        tag,
        f"{what} {have}, but with these concentrations R T Phi c is {short(-expected)}: this is an ambient fluid "
        f"pressure of {short(fluid)}, and the body swells or shrinks at once at every node with this pressure",
        f"For an ambient fluid without pressure, set it to {expected:.5g}, which is -R T Phi c"
        + (", with the load curve of the concentration." if tag.get("lc") or len(own) > 1 else "."),
    )


def overwritten(joint: Joint) -> Iterator[Finding]:
    """Prescribed values at nodes of the contact, which FEBio's interfaces replace by the ambient ones."""
    if joint.contact.kind.is_mixture:
        return
    for prescribed in prescribed_nodes(joint):
        if not prescribed.as_ambient:
            yield warning(
                "prescribed-nodes",
                prescribed.tag,
                f"this condition holds the {prescribed.field} of {prescribed.nodes} nodes of the contact, but "
                f"{joint.contact.kind.name} replaces the condition by the ambient value at open nodes",
                "Remove these nodes from the condition, or use sliding-mixture, which keeps the condition.",
            )


RULES = (without_effect, ambient, prescribed, initial, overwritten)
