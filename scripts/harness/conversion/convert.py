"""What a switch of contacts would change in the physics, so that it is not made, and the edits that make it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from harness.conversion import sources, spans, tied_contacts
from harness.conversion.fates import (
    DEFAULT,
    IMPERMEABLE,
    IMPERMEABLE_WITH_FRICTION,
    TRACTION_ALONE,
    WRITTEN,
    Action,
    Change,
    Changes,
    fate,
    missing,
    rewritten,
)
from harness.conversion.sources import Located, Sources
from harness.conversion.spans import Edit
from harness.errors import ModelError
from harness.preflight import model as models
from harness.preflight import xml_file as documents
from harness.preflight.byte_spans import Place, Span
from harness.preflight.check import check
from harness.preflight.contact_types import CONVERTIBLE, CONVERTIBLE_TIES, MIXTURE, TIED, TIED_TYPES, TYPES
from harness.preflight.finding import Severity
from harness.preflight.formats.rewriting import OLD_NAMES
from harness.preflight.levels import prescribed_nodes
from harness.preflight.model import Model
from harness.preflight.sides import Joint

NOT_OURS = {"concentration gap": "contact solute jump", "contact status": "contact coverage", "contact penalty": ""}
"""Plot variables that know FEBio's own contact classes only, and what takes their place."""
KNOWN_TO_SOLUTE = ("biphasic", "biphasic-solute")  # porous materials that sliding-biphasic-solute takes for porous


@dataclass(frozen=True)
class Converted:
    """A converted model."""

    data: bytes  # the new model file
    included: Mapping[Path, bytes]  # new files beside included ones, with the contacts of these
    changes: Mapping[str, list[Change]]  # by contact, or by another part of the model
    reads: tuple[str, ...]  # other files that the model names
    files: tuple[Path, ...]  # all files of the old model


def convert(path: Path) -> Converted:
    """Switch contacts of FEBio's sliding types to `sliding-mixture`, and those of its tied types to `tied-mixture`.

    Raises ModelError, with all reasons, where the file cannot be read, has nothing to convert, or converting would
    change the physics or make a model that does not run.
    """
    model = models.read(path)
    joints = [Joint(model, contact) for contact in (*model.contacts, *model.ties)]
    if all(joint.contact.kind.is_mixture or tied_contacts.stays(joint) for joint in joints):
        found = ", ".join(sorted({joint.contact.kind.name for joint in joints}))
        known = ", ".join((*CONVERTIBLE, *CONVERTIBLE_TIES))
        stay = "".join(f"; {reason}" for reason in dict.fromkeys(filter(None, map(tied_contacts.stays, joints))))
        raise ModelError(f"{path}: has nothing to convert: its contacts are {found}; {known} can be{stay}")
    _refuse(path, list(_refusals(model)))
    files = sources.read(path)
    edits, changes = _edits(files, model)
    sources.redirect(files, edits)
    new = {file: spans.apply(files.data[file], dict.fromkeys(edits[file])) for file in edits}
    data = new.pop(path)
    included = {sources.converted_name(file): made for file, made in new.items()}
    wrong = [finding for finding in check(path, {path: data, **included}) if finding.severity is Severity.ERROR]
    _refuse(path, [f"{_place_before(files, edits, finding.place)}: {finding.message}" for finding in wrong])
    reads = tuple(reference.name for reference in files.references)
    return Converted(data, included, changes, reads, tuple(files.data))


def _place_before(files: Sources, edits: Mapping[Path, list[Edit]], place: Place) -> Place:
    """Where in the user's file a place of the new one comes from: nobody sees what is not written."""
    for file, made in edits.items():
        if place.file in (file if file == files.document.path else None, sources.converted_name(file)):
            return replace(place, file=file, line=spans.line_before(files.data[file], dict.fromkeys(made), place.line))
    return place


def _refuse(path: Path, reasons: list[str]) -> None:
    if reasons:
        listed = "\n".join(f"  - {reason}" for reason in dict.fromkeys(reasons))
        raise ModelError(f"{path} is not converted:\n{listed}")


def _refusals(model: Model) -> Iterator[str]:
    """Reasons not to convert, one sentence each; none where the physics stays."""
    theirs = [contact for contact in model.contacts if not contact.kind.is_mixture]
    for contact in theirs:
        yield from _of_materials(Joint(model, contact))
    for contact in theirs:
        if contact.given("fric_coeff") is not None and "fric_coeff" not in contact.kind.parameters:
            yield f"{documents.place(contact.tag)}: {contact.kind.name} has no parameter <fric_coeff>; FEBio stops"


def _of_materials(joint: Joint) -> Iterator[str]:
    """To FEBio's types a surface is impermeable to what they do not know; `sliding-mixture` would exchange it."""
    kind, where = joint.contact.kind, documents.place(joint.contact.tag)
    for side in joint.sides:
        name = side.surface.name
        for material in side.kinds:
            seen = f"surface '{name}' has material '{material.name}' ({material.kind})"
            if material.solutes and kind.solvent and not kind.solutes:
                yield (
                    f"{where}: {seen}: {kind.name} leaves its surfaces impermeable to solutes, but sliding-mixture "
                    "would exchange them and prescribe the ambient concentration at open nodes"
                )
            elif kind.name == "sliding-biphasic-solute" and material.porous and material.kind not in KNOWN_TO_SOLUTE:
                yield f"{where}: {seen}: {kind.name} treats it as a solid without fluid, and sliding-mixture does not"


def _edits(files: Sources, model: Model) -> tuple[dict[Path, list[Edit]], dict[str, list[Change]]]:
    edits: dict[Path, list[Edit]] = {}
    changes: dict[str, list[Change]] = {}
    for number, (contact, joint) in enumerate(_joints(files, model), 1):
        if joint is None or joint.contact.kind.is_mixture:
            continue
        if reason := tied_contacts.stays(joint):
            stays = Change(Action.KEPT, "type", contact.span.line, f"stays: {reason}")
            changes[_title(contact, number, model.path)] = [stays]
            continue
        data, is_tie = files.data[contact.file], joint.contact.kind.is_tie
        new = TIED if is_tie else MIXTURE
        old = contact.span.attributes.get("type", "")
        own = [Change(Action.MAPPED, "type", contact.span.line, f"{old} becomes {new}")]
        found = edits.setdefault(contact.file, [])
        found.append(spans.attribute(data, contact.span, "type", new))
        for edit, change in (tied_contacts.parameters if is_tie else _parameters)(data, contact.span, joint):
            own.append(change)
            found += edit
        changes[_title(contact, number, model.path)] = own
    for change in _prescribed(model):
        changes.setdefault("boundary conditions", []).append(change)
    for change in _output(files):
        changes.setdefault("output", []).append(change)
    return edits, changes


def _title(contact: Located, number: int, model: Path) -> str:
    name = contact.span.attributes.get("name") or f"number {number}"
    return f'contact "{name}"' + (f" in {contact.file}" if contact.file != model else "")


def _joints(files: Sources, model: Model) -> Iterator[tuple[Located, Joint | None]]:
    """The contacts of the files with what the model knows of them: both are in FEBio's order of reading."""
    sliding, tied = iter(model.contacts), iter(model.ties)
    for contact in files.contacts:
        kind = contact.span.attributes.get("type", "")
        known = sliding if kind in (*TYPES, *OLD_NAMES) else tied if kind in TIED_TYPES else None
        yield contact, Joint(model, next(known)) if known is not None else None


def _parameters(data: bytes, contact: Span, joint: Joint) -> Changes:
    kind, rubs = joint.contact.kind, joint.contact.has_friction
    impermeable = not kind.solvent and any(side.porous for side in joint.sides)
    names = missing(kind, {child.tag for child in contact.children})
    written = [(name, DEFAULT, WRITTEN[name]) for name in names]
    parameters = IMPERMEABLE_WITH_FRICTION if rubs else IMPERMEABLE
    written += [(name, value, TRACTION_ALONE) for name, value in parameters.items() if impermeable]
    return rewritten(data, contact, lambda name, value: fate(kind, name, value, rubs=rubs), written)


def _prescribed(model: Model) -> Iterator[Change]:
    """Nodes that a boundary condition holds: they stay so in contact and outside."""
    for contact in (contact for contact in model.contacts if not contact.kind.is_mixture):
        for prescribed in prescribed_nodes(Joint(model, contact)):
            where = f"{prescribed.nodes} nodes of the contact have this condition; sliding-mixture keeps it"
            why = f"{contact.kind.name} does so in contact, and sets the ambient value where they are open"
            if prescribed.as_ambient:
                why = "it is the ambient value"
            yield Change(Action.KEPT, prescribed.field, documents.place(prescribed.tag).line, f"{where}: {why}")


def _output(files: Sources) -> Iterator[Change]:
    for located in files.all("Output", "plotfile", "var"):
        variable = located.span
        name = variable.attributes.get("type", "")
        if name in NOT_OURS:
            better = f"; '{NOT_OURS[name]}' takes its place" if NOT_OURS[name] else ""
            yield Change(
                Action.KEPT, name, variable.line, f"stays in the file but supports FEBio's contact types alone{better}"
            )
