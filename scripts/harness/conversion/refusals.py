"""What a switch to `sliding-mixture` would change in the physics, so that it is not made."""

from collections.abc import Iterator

from harness.preflight.contact_types import CONVERTIBLE
from harness.preflight.model import Model
from harness.preflight.sides import Joint
from harness.preflight.xml_file import place


def refusals(model: Model) -> Iterator[str]:
    """Reasons not to convert, one sentence each; none where the physics stays."""
    for contact in model.contacts:
        if contact.kind.name in CONVERTIBLE:
            yield from _of_materials(Joint(model, contact))
    for contact in (c for c in model.contacts if c.kind.name in CONVERTIBLE):
        if contact.given("fric_coeff") is not None and "fric_coeff" not in contact.kind.parameters:
            yield f"{place(contact.tag)}: {contact.kind.name} has no parameter <fric_coeff>; FEBio stops"


def _of_materials(joint: Joint) -> Iterator[str]:
    """To FEBio's types a surface is impermeable to what they do not know; `sliding-mixture` would exchange it."""
    kind, where = joint.contact.kind, place(joint.contact.tag)
    for side in joint.sides:
        name = side.surface.name
        for material in side.kinds:
            seen = f"surface '{name}' has material '{material.name}' ({material.kind})"
            if material.solutes and kind.solvent and not kind.solutes:
                yield (
                    f"{where}: {seen}: {kind.name} leaves its surfaces impermeable to solutes, but sliding-mixture "
                    "would exchange them and prescribe the ambient concentration at open nodes"
                )
            elif kind.name == "sliding-biphasic-solute" and material.porous and _unknown_to_solute(material.kind):
                yield f"{where}: {seen}: {kind.name} treats it as a solid without fluid, and sliding-mixture does not"


def _unknown_to_solute(kind: str) -> bool:
    return kind not in ("biphasic", "biphasic-solute")
