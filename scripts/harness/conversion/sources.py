"""The files of a model in bytes, with its sections in the order in which FEBio reads them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from harness.conversion import spans
from harness.conversion.spans import Edit, Span
from harness.errors import ModelError
from harness.preflight import xml_file
from harness.preflight.finding import Place

_ADDED = "-mixture"


@dataclass(frozen=True)
class Located:
    """An element, and the file that it stands in."""

    file: Path
    span: Span


@dataclass(frozen=True)
class Reference:
    """An ``<Include>``, or a section or part that is read ``from`` another file."""

    file: Path
    span: Span
    name: str
    target: Path


@dataclass
class Sources:
    """All files of a model.

    Attributes
    ----------
    model : Path
    data : dict of Path to bytes
    sections : list of Located
    references : list of Reference
        One before those in the file that it names.
    """

    model: Path
    data: dict[Path, bytes] = field(default_factory=dict)
    sections: list[Located] = field(default_factory=list)
    references: list[Reference] = field(default_factory=list)

    def all(self, *names: str) -> Iterator[Located]:
        """Elements on a path of tags below <febio_spec>."""
        for section in self.sections:
            if section.span.tag == names[0]:
                yield from (Located(section.file, span) for span in section.span.all(*names[1:]))

    @property
    def contacts(self) -> list[Located]:
        """Contacts at top level, then those of the steps, which format 2.5 has at top level."""
        paths = (("Contact", "contact"), ("Step", "step", "Contact", "contact"), ("Step", "Contact", "contact"))
        return [contact for path in paths for contact in self.all(*path)]


def read(model: Path) -> Sources:
    """The files of a model that can be read.

    Raises
    ------
    ModelError
    """
    found = Sources(model)
    for section in _root(found, model).children:
        _read(found, model, section)
    return found


def _root(found: Sources, file: Path) -> Span:
    found.data[file] = xml_file.content(file)
    return spans.locate(found.data[file], str(file))


def _read(found: Sources, file: Path, section: Span) -> None:
    name = spans.text(found.data[file], section) if section.tag == "Include" else section.attributes.get("from", "")
    if not name:
        found.sections.append(Located(file, section))
        found.references += [_reference(found, file, part) for part in section.all("Part") if "from" in part.attributes]
        return
    reference = _reference(found, file, section, name)
    found.references.append(reference)
    target = reference.target
    inner = _root(found, target).children
    if section.tag == "Include":
        for each in inner:
            _read(found, target, each)
    else:
        found.sections += [Located(target, each) for each in inner if each.tag == section.tag][:1]


def _reference(found: Sources, file: Path, tag: Span, name: str = "") -> Reference:
    name = name or tag.attributes["from"]
    return Reference(file, tag, name, xml_file.included(found.model, Place(file, tag.line, f"<{tag.tag}>"), name))


def converted_name(path: Path) -> Path:
    """What the new file beside an old one is called."""
    return path.with_name(f"{path.stem}{_ADDED}{path.suffix}")


def redirect(sources: Sources, edits: dict[Path, list[Edit]]) -> None:
    """Has files with edits read by their new names, and so on up to the model.

    Raises
    ------
    ModelError
        A name is written with entities.
    """
    for reference in reversed(sources.references):
        if reference.target in edits:
            edits.setdefault(reference.file, []).append(_edit(sources.data[reference.file], reference))


def _edit(data: bytes, reference: Reference) -> Edit:
    tag, name = reference.span, reference.name
    value = None if tag.tag == "Include" else spans.attribute(data, tag, "from", name)
    start, end = tag.inner if value is None else (value.start, value.end)
    for encoding in ("utf-8", "latin-1"):
        at = data.find(name.encode(encoding), start, end)
        if at >= 0:
            place = at + len(name.removesuffix(Path(name).suffix).encode(encoding))
            return Edit(place, place, _ADDED.encode())
    where = Place(reference.file, tag.line, f"<{tag.tag}>")
    raise ModelError(f"{where}: writes the name '{name}' with entities; give the file a name of letters and digits")
