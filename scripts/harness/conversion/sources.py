"""The files of a model in bytes, with its sections in the order in which FEBio reads them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from harness.conversion import spans
from harness.conversion.spans import Edit
from harness.errors import ModelError
from harness.preflight import byte_spans, xml_file
from harness.preflight.byte_spans import Place, Span
from harness.preflight.xml_file import Document, Element

_ADDED = "-mixture"


@dataclass(frozen=True)
class Located:
    """An element, and the file that it stands in."""

    file: Path
    span: Span


@dataclass(frozen=True)
class Reference:
    """A tag that names another file, the name as it stands there, and that file."""

    tag: Located
    name: str
    target: Path


@dataclass(frozen=True)
class Sources:
    """All files of a model."""

    document: Document  # what they say, in the format in which they are written
    data: Mapping[Path, bytes]
    located: Mapping[Element, Located]  # all elements of the files
    references: tuple[Reference, ...]  # one before those in the file that it names

    def all(self, *names: str) -> Iterator[Located]:
        """Elements on a path of tags below <febio_spec>."""
        return (self.located[element] for element in self.document.all(*names))

    @property
    def contacts(self) -> list[Located]:
        """Contacts at top level, then those of the steps, which format 2.5 has at top level."""
        paths = (("Contact", "contact"), ("Step", "step", "Contact", "contact"), ("Step", "Contact", "contact"))
        return [contact for path in paths for contact in self.all(*path)]


def read(model: Path) -> Sources:
    """The files of a model that can be read. Raises ModelError."""
    document = xml_file.read(model)
    roots = [(model, document.root), *((reference.file, reference.root) for reference in document.references)]
    data = {file: xml_file.content(file) for file, _ in roots}
    located = {
        element: Located(file, span)
        for file, root in roots
        for element, span in zip(root.iter("*"), byte_spans.locate(data[file]).walk(), strict=True)
    }
    found = [Reference(located[each.tag], each.name, each.file) for each in document.references]
    parts = [part for section in document.sections for part in xml_file.children(section, "Part") if part.get("from")]
    for part in parts:
        name = str(part.get("from"))
        found.append(Reference(located[part], name, xml_file.included(model, xml_file.place(part), name)))
    return Sources(document, data, located, tuple(found))


def converted_name(path: Path) -> Path:
    """What the new file beside an old one is called."""
    return path.with_name(f"{path.stem}{_ADDED}{path.suffix}")


def redirect(sources: Sources, edits: dict[Path, list[Edit]]) -> None:
    """Has files with edits read by their new names, and so on up to the model.

    Raises ModelError where a name is written with entities.
    """
    for reference in reversed(sources.references):
        if reference.target in edits:
            file = reference.tag.file
            edits.setdefault(file, []).append(_edit(sources.data[file], reference))


def _edit(data: bytes, reference: Reference) -> Edit:
    tag, name = reference.tag.span, reference.name
    value = None if tag.tag == "Include" else spans.attribute(data, tag, "from", name)
    start, end = tag.inner if value is None else (value.start, value.end)
    for encoding in ("utf-8", "latin-1"):
        at = data.find(name.encode(encoding), start, end)
        if at >= 0:
            place = at + len(name.removesuffix(Path(name).suffix).encode(encoding))
            return Edit(place, place, _ADDED.encode())
    where = Place(reference.tag.file, tag.line, f"<{tag.tag}>")
    raise ModelError(f"{where}: writes the name '{name}' with entities; give the file a name of letters and digits")
