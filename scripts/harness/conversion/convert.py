"""Puts refusals, changes and edits together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.conversion import spans
from harness.conversion.fates import (
    DEFAULT,
    IMPERMEABLE,
    IMPERMEABLE_WITH_FRICTION,
    TRACTION_ALONE,
    WRITTEN,
    Action,
    Change,
    fate,
    missing,
)
from harness.conversion.refusals import refusals
from harness.conversion.spans import Edit, Span
from harness.errors import ModelError
from harness.preflight import model as models
from harness.preflight import xml_file as documents
from harness.preflight.check import check
from harness.preflight.contact_types import CONVERTIBLE, MIXTURE, TYPES
from harness.preflight.finding import Severity
from harness.preflight.model import Model
from harness.preflight.prescribed_nodes import prescribed_nodes
from harness.preflight.sides import Joint

NOT_OURS = {
    "concentration gap": "contact solute jump",
    "contact status": "contact coverage",
    "contact penalty": "",
}
"""Plot variables that know FEBio's own contact classes only, and what takes their place."""


@dataclass(frozen=True)
class Converted:
    """A converted model.

    Attributes
    ----------
    data : bytes
        The new file.
    changes : dict of str to list of Change
        By contact, or by another part of the file.
    """

    data: bytes
    changes: dict[str, list[Change]]


def convert(path: Path) -> Converted:
    """Switch every contact of FEBio's sliding types to `sliding-mixture`.

    Raises
    ------
    ModelError
        The file cannot be read, has nothing to convert, or converting would change the physics or make a model that
        does not run; says all the reasons.
    """
    data = documents.content(path)
    model = models.read(path, data)
    if not any(contact.kind.name in CONVERTIBLE for contact in model.contacts):
        found = ", ".join(sorted({contact.kind.name for contact in model.contacts}))
        raise ModelError(f"{path}: has nothing to convert: its contacts are {found}; {', '.join(CONVERTIBLE)} can be")
    _refuse(path, list(refusals(model)))
    edits, changes = _edits(data, model)
    made = spans.apply(data, edits)
    wrong = [finding for finding in check(path, made) if finding.severity is Severity.ERROR]
    _refuse(path, [f"{finding.place}: {finding.message}" for finding in wrong])
    return Converted(made, changes)


def _refuse(path: Path, reasons: list[str]) -> None:
    if reasons:
        listed = "\n".join(f"  - {reason}" for reason in dict.fromkeys(reasons))
        raise ModelError(f"{path} is not converted:\n{listed}")


def _edits(data: bytes, model: Model) -> tuple[list[Edit], dict[str, list[Change]]]:
    root = spans.locate(data, str(model.path))
    edits: list[Edit] = []
    changes: dict[str, list[Change]] = {}
    sections = [*root.all("Contact"), *root.all("Step", "step", "Contact")]
    contacts = [contact for section in sections for contact in section.all("contact")]
    joints = _joints(model, contacts)
    for number, contact in enumerate(contacts, 1):
        kind = contact.attributes.get("type", "")
        if kind not in CONVERTIBLE:
            continue
        name = contact.attributes.get("name") or f"number {number}"
        edits.append(spans.attribute(data, contact, "type", MIXTURE))
        own = [Change(Action.MAPPED, "type", contact.line, f"{kind} becomes {MIXTURE}")]
        for edit, change in _parameters(data, contact, joints[contact.start]):
            own.append(change)
            edits += edit
        changes[f'contact "{name}"'] = own
    for change in _prescribed(model):
        changes.setdefault("boundary conditions", []).append(change)
    for change in _output(root):
        changes.setdefault("output", []).append(change)
    return edits, changes


def _joints(model: Model, contacts: Sequence[Span]) -> dict[int, Joint]:
    """The sliding contacts of the model by where they start in its file: both are in FEBio's order of reading."""
    sliding = [contact for contact in contacts if contact.attributes.get("type", "") in TYPES]
    of_file = [known for known in model.contacts if documents.place(known.tag).file == model.path]
    return {contact.start: Joint(model, known) for contact, known in zip(sliding, of_file, strict=True)}


def _impermeable(joint: Joint) -> bool:
    """Whether a contact of FEBio's that knows traction alone stands between bodies one of which has fluid."""
    return not joint.contact.kind.solvent and any(side.porous for side in joint.sides)


def _parameters(data: bytes, contact: Span, joint: Joint) -> Iterator[tuple[list[Edit], Change]]:
    kind, impermeable, rubs = TYPES[contact.attributes["type"]], _impermeable(joint), joint.contact.has_friction
    for child in contact.children:
        value = spans.text(data, child)
        change = fate(kind, child.tag, value, rubs=rubs)(child.line)
        yield [spans.removal(data, child)] if change.action is Action.DROPPED else [], change
    names = missing(kind, {child.tag for child in contact.children})
    written = [(name, DEFAULT, WRITTEN[name]) for name in names]
    parameters = IMPERMEABLE_WITH_FRICTION if rubs else IMPERMEABLE
    written += [(name, value, TRACTION_ALONE) for name, value in parameters.items() if impermeable]
    lines = [f"<{name}>{value}</{name}>" for name, value, _ in written]
    for place, (name, value, reason) in enumerate(written):
        change = Change(Action.MAPPED, name, contact.line, f"{value}: {reason}")
        yield spans.insertion(data, contact, lines) if place == 0 else [], change


def _prescribed(model: Model) -> Iterator[Change]:
    """Nodes that a boundary condition holds: they stay so in contact and outside."""
    for contact in (c for c in model.contacts if c.kind.name in CONVERTIBLE):
        for prescribed in prescribed_nodes(Joint(model, contact)):
            where = f"{prescribed.nodes} nodes of the contact have this condition; sliding-mixture keeps it"
            why = f"{contact.kind.name} does so in contact, and sets the ambient value where they are open"
            if prescribed.as_ambient:
                why = "it is the ambient value"
            yield Change(Action.KEPT, prescribed.field, documents.place(prescribed.tag).line, f"{where}: {why}")


def _output(root: Span) -> Iterator[Change]:
    for variable in root.all("Output", "plotfile", "var"):
        name = variable.attributes.get("type", "")
        if name in NOT_OURS:
            better = f"; '{NOT_OURS[name]}' takes its place" if NOT_OURS[name] else ""
            yield Change(
                Action.KEPT, name, variable.line, f"stays in the file but knows FEBio's contact types alone{better}"
            )
