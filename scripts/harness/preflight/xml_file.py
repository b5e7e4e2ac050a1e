"""A model file with the files that it includes, as FEBio reads them; numbers in it; places in it."""

import codecs
import itertools
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TypeAlias, cast

import numpy as np
from lxml import etree

from harness.arrays import Array
from harness.errors import ModelError
from harness.preflight import byte_spans
from harness.preflight.byte_spans import Place

Element = etree._Element
Contents: TypeAlias = Mapping[Path, bytes]  # what is read in place of files, by their paths
AS_THEY_ARE: Contents = MappingProxyType({})
VERSIONS = ("2.5", "3.0", "4.0")  # formats of model files, the newest last
WITHOUT_CONTENT = "without_content"  # attribute of a contact that is written with two tags and has nothing between them
WRITTEN_AS = "written_as"  # attribute with line and tag of what an element is made from, where the file has another one
DEEPEST_INCLUDE = 8
LONGEST_RANGE = 50_000_000
LONGEST_NAME, MOST_NAMES = 80, 20
_WHOLE = re.compile(r"[+-]?\d+")
_TELLING = ("name", "id", "sol", "type", "bc")


def parse(path: Path, instead: Contents = AS_THEY_ARE) -> Element:
    """Root of a model file, where contacts of two tags without content are marked. Raises ModelError: as `root_of`."""
    data = content(path, instead)
    root = root_of(path, data)
    _mark_empty_contacts(root, data)
    return root


def root_of(path: Path, data: bytes) -> Element:
    """Root of the content of a model file. Raises ModelError where it is no FEBio model of one of `VERSIONS`."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=True)
    try:
        root = etree.fromstring(data, parser, base_url=str(path))
    except (etree.XMLSyntaxError, ValueError) as error:
        raise ModelError(f"{path}: is not XML: {getattr(error, 'msg', None) or error}") from error
    if not data.lstrip(codecs.BOM_UTF8).startswith(b"<?xml"):
        raise ModelError(f'{path}: does not begin with <?xml version="1.0"?>, without which FEBio opens no file')
    if root.tag != "febio_spec":
        raise ModelError(f"{place(root)}: a model begins with <febio_spec>")
    if root.get("version") not in VERSIONS:
        found = f"version '{shortened(str(root.get('version')))}'" if root.get("version") else "no version"
        raise ModelError(
            f"{place(root)}: has {found}; {', '.join(VERSIONS)} can be read (FEBio Studio converts older files)"
        )
    return root


def _mark_empty_contacts(root: Element, data: bytes) -> None:
    contacts = list(root.iter("contact"))
    if all(any(True for _ in children(contact)) for contact in contacts):
        return
    written = (span for span in byte_spans.locate(data).walk() if span.tag == "contact")
    for contact, span in zip(contacts, written, strict=True):
        if not span.closed_in_itself and not any(True for _ in children(contact)):
            contact.set(WITHOUT_CONTENT, "1")


def content(path: Path, instead: Contents = AS_THEY_ARE) -> bytes:
    """The bytes of a file. Raises ModelError."""
    if path in instead:
        return instead[path]
    try:
        return path.read_bytes()
    except OSError as error:
        raise ModelError(f"{path}: cannot be read ({error.strerror or error})") from error


def place(element: Element) -> Place:
    """Where an element is, for a message: line and tag as the file has them."""
    file = Path(element.getroottree().docinfo.URL or "")
    written_as = element.get(WRITTEN_AS)
    if written_as:
        line, _, tag = written_as.partition(" ")
        return Place(file, int(line), tag)
    told = next((f' {key}="{shortened(str(element.get(key)))}"' for key in _TELLING if element.get(key)), "")
    return Place(file, cast("int", element.sourceline), f"<{element.tag}{told}>")


def shortened(value: str) -> str:
    """A name that a file has, for a message."""
    return value if len(value) <= LONGEST_NAME else value[:LONGEST_NAME] + "..."


def unknown_name(element: Element, what: str, name: str, known: Iterable[str], none: str = "none") -> ModelError:
    """That an element names what does not exist, and what does."""
    there = [shortened(each) for each in itertools.islice(known, MOST_NAMES)]
    return ModelError(
        f"{place(element)}: names {what} '{shortened(name)}', which does not exist; there is {', '.join(there) or none}"
    )


def children(element: Element, tag: str | None = None) -> Iterator[Element]:
    """Child elements, without comments; of one tag where given."""
    return (child for child in element if isinstance(child.tag, str) and tag in (None, child.tag))


@dataclass(frozen=True)
class Reference:
    """An ``<Include>``, or a section that is read ``from`` another file: its tag, and that file."""

    tag: Element
    name: str
    file: Path
    root: Element


@dataclass(frozen=True)
class Document:
    """The sections of a model, from all of its files, in the order in which FEBio reads them."""

    path: Path
    root: Element  # of the model file itself
    sections: tuple[Element, ...]
    references: tuple[Reference, ...] = ()  # one before those in the file that it names

    @property
    def version(self) -> str:
        """Format of the files."""
        return str(self.root.get("version"))

    def all(self, *names: str) -> Iterator[Element]:
        """Elements on a path of tags below <febio_spec>, such as ("Contact", "contact")."""
        found = [section for section in self.sections if section.tag == names[0]]
        for name in names[1:]:
            found = [child for parent in found for child in children(parent, name)]
        return iter(found)

    def everywhere(self, section: str, tag: str | None = None) -> Iterator[tuple[int, Element]]:
        """Children of a section, at top level (step 0) and in each analysis step (from 1)."""
        for step, parent in self._by_step(section):
            yield from ((step, child) for child in children(parent, tag))

    def each(self, section: str) -> tuple[Element, ...]:
        """Sections of a name, at top level and in each analysis step."""
        return tuple(found for _, found in self._by_step(section))

    def _by_step(self, section: str) -> Iterator[tuple[int, Element]]:
        yield from ((0, found) for found in self.all(section))
        for number, step in enumerate(self.all("Step", "step"), 1):
            yield from ((number, found) for found in children(step, section))


def read(path: Path, instead: Contents = AS_THEY_ARE) -> Document:
    """Read a model file and what it includes, in the format in which it is written.

    Raises ModelError: as `parse`; an included file that is missing, includes itself, or is of another format.
    """
    root = parse(path, instead)
    references: list[Reference] = []
    return Document(path, root, tuple(_sections(path, root, references, instead)), tuple(references))


def _sections(
    model: Path, root: Element, references: list[Reference], instead: Contents, depth: int = 0
) -> Iterator[Element]:
    """The sections of a file and of those that it names; what it names is added to `references`."""
    if depth > DEEPEST_INCLUDE:
        file = place(root).file
        raise ModelError(f"{file}: is included more than {DEEPEST_INCLUDE} files deep; does a file include itself?")
    for section in children(root):
        name = text(section) if section.tag == "Include" else section.get("from")
        if name is None or (not name and section.tag != "Include"):
            yield section
            continue
        file = included(model, place(section), str(name), instead)
        inner = parse(file, instead)
        references.append(Reference(section, str(name), file, inner))
        if section.tag != "Include":
            yield _section_from(section, file, inner)
            continue
        if inner.get("version") != root.get("version"):
            raise ModelError(
                f"{place(inner)}: has version '{inner.get('version')}'; {place(section)} includes it, and "
                f"that file has '{root.get('version')}': files of one model have one version"
            )
        yield from _sections(model, inner, references, instead, depth + 1)


def _section_from(section: Element, file: Path, root: Element) -> Element:
    found = next(children(root, str(section.tag)), None)
    if found is None:
        raise ModelError(f"{place(section)}: refers to {file}, which has no <{section.tag}>")
    return found


def included(model: Path, where: Place, name: str, instead: Contents = AS_THEY_ARE) -> Path:
    """The file that a section names; FEBio looks beside the model file, or from where it is started.

    Raises ModelError where there is none.
    """
    beside = model.parent / name
    if name and (beside in instead or beside.is_file()):
        return beside
    if name and Path(name).is_file():
        return Path(name)
    raise ModelError(f"{where}: includes '{name}', and there is no file {beside}")


def text(element: Element) -> str:
    """The text of an element without comments in it and white space around it."""
    behind_comments = (child.tail for child in element if not isinstance(child.tag, str))
    return "".join(part or "" for part in (element.text, *behind_comments)).strip()


def number(element: Element) -> float:
    """The finite number in an element. Raises ModelError where there is none."""
    value = as_number(text(element))
    if not math.isfinite(value):
        raise ModelError(f"{place(element)}: is '{text(element)[:40]}'; a number is needed")
    return value


def optional_number(parent: Element, tag: str, default: float = math.nan) -> float:
    """The number in the child `tag`; `default` without it, NaN where it is a map or a formula."""
    found = parent.find(tag)
    return default if found is None else as_number(text(found))


def as_number(value: str) -> float:
    """The number that a text is; NaN where it is a map or a formula."""
    try:
        return float(value)
    except ValueError:
        return math.nan


def flag(parent: Element, tag: str) -> bool:
    """Whether the child `tag` is there and is on."""
    found = parent.find(tag)
    return found is not None and is_on(text(found))


def is_on(value: str) -> bool:
    """Whether FEBio takes a switch for on: where it begins with a whole number that is not 0; ``true`` is off."""
    found = _WHOLE.match(value)
    return found is not None and int(found.group()) != 0


def chosen(value: str, words: Sequence[str]) -> int | None:
    """The place of a word among these, which FEBio compares without case, or the number that stands for it."""
    lowered = [word.lower() for word in words]
    if value.lower() in lowered:
        return lowered.index(value.lower())
    return int(value) if value.isdecimal() and int(value) < len(words) else None


def floats(element: Element, size: int) -> Array:
    """So many finite numbers, separated by commas. Raises ModelError."""
    values = np.array([as_number(part) for part in text(element).split(",")])
    if len(values) != size or not np.isfinite(values).all():
        raise ModelError(f"{place(element)}: is '{text(element)[:60]}'; {size} numbers separated by commas are needed")
    return values


def integers(element: Element) -> list[int]:
    """Node or element numbers separated by commas; FEBio's ranges ``1:9`` or ``1:9:2`` count out. Raises ModelError."""
    found: list[int] = []
    for part in text(element).replace("\n", ",").split(","):
        if not part.strip():
            continue
        try:
            found += _range([int(end) for end in part.split(":")])
        except (ValueError, TypeError) as error:
            raise ModelError(f"{place(element)}: has '{part.strip()[:40]}' where a number is needed") from error
    return found


def _range(ends: list[int]) -> list[int]:
    """One number, or first:last:step."""
    if len(ends) == 1:
        return ends
    numbers = range(ends[0], ends[1] + 1, *ends[2:])
    if len(numbers) > LONGEST_RANGE:
        raise ValueError("the range is too long")
    return list(numbers)


def attribute(element: Element, name: str) -> str:
    """An attribute that must be there. Raises ModelError."""
    value = element.get(name)
    if not value:
        raise ModelError(f"{place(element)}: has no attribute '{name}', which FEBio needs")
    return str(value)


def identifier(element: Element) -> int:
    """The number in the attribute `id`. Raises ModelError."""
    try:
        return int(attribute(element, "id"))
    except ValueError as error:
        raise ModelError(f"{place(element)}: its id is not a number") from error
