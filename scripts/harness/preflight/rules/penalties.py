"""Rules on penalties: what they let through, and whether they are too stiff."""

import math
from collections.abc import Iterator

from harness.preflight.finding import Finding, error, note, percent, short, warning
from harness.preflight.penalty import Penalty, leak, penalty
from harness.preflight.sides import TRACTION, Field, Joint

LARGEST_LEAK = 0.01  # jump over the difference across both bodies that passes without a word
GOOD_LEAK = 1e-3  # what a suggested penalty leaves
STIFFEST_TRACTION, STIFFEST_FLUX = 1e5, 1e12
"""Penalty over local stiffness or conductance from which Newton's method, or rounding, suffers."""


def leaks(joint: Joint) -> Iterator[Finding]:
    """Penalties that leave a jump or an overlap that one would see in the answer."""
    for field in joint.fields:
        own = penalty(joint, field)
        left = after_augmentation(joint, leak(joint, field, own.value))
        if left > LARGEST_LEAK:
            yield warning("leak", own.tag, _leak_in_words(joint, field, own, left), _stiffer(joint, field, own))


def after_augmentation(joint: Joint, jump: float) -> float:
    """What is left of a jump: none of it with this plugin's AUGLAG; with FEBio's, each of at most `maxaug`
    augmentations (Uzawa) multiplies it by itself.
    """
    if not joint.contact.augmented:
        return jump
    if joint.contact.kind.is_mixture:
        return 0.0
    return float(jump ** (1.0 + max(0.0, joint.contact.value("maxaug", 10.0))))


def _leak_in_words(joint: Joint, field: Field, own: Penalty, left: float) -> str:
    how = "as given" if own.given else "not given, and FEBio uses 1"
    if own.factor and own.local > 0.0:
        how = f"{short(own.value / own.local)} times the local {_local(field)}"
    augmented = " even after all augmentations" if joint.contact.augmented else ""
    begin = f"<{field.penalty}> is {short(own.value)} ({how}): at this penalty"
    if field == TRACTION:
        return f"{begin} the bodies will overlap by about {percent(left)} of their compression{augmented}"
    return (
        f"{begin} the {field.name} will jump by about {percent(left)} of the difference across the two "
        f"bodies{augmented}: the contact acts as a membrane"
    )


def _local(field: Field) -> str:
    return "stiffness" if field == TRACTION else "conductance"


def _stiffer(joint: Joint, field: Field, own: Penalty) -> str:
    enough = (1.0 / GOOD_LEAK - 1.0) / sum(side.resistance(field) for side in joint.sides)
    relative = own.factor and own.local > 0.0
    value = f"{short(enough / own.local)}, times the local {_local(field)}" if relative else short(enough)
    if joint.contact.kind.is_mixture:
        return f"Delete <{field.penalty}> for an automatic value, or set at least {value}."
    return f"Set <{field.penalty}> to {value}; this leaves {percent(GOOD_LEAK)}."


def too_stiff(joint: Joint) -> Iterator[Finding]:
    """Penalties far above what the elements can follow."""
    for field in joint.fields:
        own = penalty(joint, field)
        limit = STIFFEST_TRACTION if field == TRACTION else STIFFEST_FLUX
        if own.given and own.value > limit * own.local > 0.0:
            yield warning(
                "stiff-penalty",
                own.tag,
                f"<{field.penalty}> {short(own.value)} is {short(own.value / own.local)} times the local "
                f"{_local(field)}: points at the edge of contact open and close "
                "in turn, and Newton's method may not converge",
                f"Set it to {short(1e3 if own.factor else 1e3 * own.local)}"
                + (f", or delete <{field.penalty}>." if joint.contact.kind.is_mixture else "."),
            )


def rigid_sides(joint: Joint) -> Iterator[Finding]:
    """Rigid bodies from which no automatic penalty follows."""
    contact = joint.contact
    automatic = contact.on("auto_penalty") or (contact.kind.is_mixture and contact.given("penalty") is None)
    if not automatic:
        return
    has_modulus = any(material.tag.find("E") is not None for material in joint.primary.kinds)
    if contact.kind.is_mixture and all(side.rigid for side in joint.sides):
        yield note(
            "rigid-penalty",
            contact.tag,
            "both surfaces are rigid: the penalty follows from the largest modulus in the model, that is "
            "<E>/(1 - <v>^2) of rigid materials",
            "None if this modulus is about right. Otherwise set <penalty> to a value (force per volume).",
        )
    elif not contact.kind.is_mixture and joint.primary.rigid and not has_modulus:
        yield error(
            "rigid-penalty",
            contact.tag,
            "the primary surface is rigid and its material has no <E>: FEBio's automatic penalty is 0 and nothing "
            "keeps the bodies apart",
            "Exchange <primary> and <secondary>, or give the rigid material an <E> like that of the other body.",
        )


def unknown_properties(joint: Joint) -> Iterator[Finding]:
    """Properties that are no numbers in the file, so that penalties are not compared with them."""
    for side in joint.sides:
        for material in side.kinds:
            names = [field.name for field in joint.fields if math.isnan(field.property_of(material))]
            if names:
                yield note(
                    "not-compared",
                    material.tag,
                    f"material '{material.name}' ({material.kind}): its stiffness or transport is not a plain number, "
                    f"so penalties were not checked for {', '.join(names)}",
                    "None: an automatic penalty reads the properties when the run begins.",
                )


RULES = (leaks, too_stiff, rigid_sides, unknown_properties)
