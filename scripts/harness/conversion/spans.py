"""Where the tags of an XML file stand, in bytes, and changes to it that leave all other bytes alone."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from harness.errors import ModelError

_VALUE = rb"""\s*=\s*(?P<quote>["'])(?P<value>.*?)(?P=quote)"""


@dataclass
class Span:
    """An element in the bytes of a file.

    Attributes
    ----------
    tag : str
    attributes : dict of str to str
    line : int
        From 1.
    start : int
        Of its ``<``.
    inner : tuple of int
        What stands between its tags; empty, at the end of the tag, where it is ``<tag/>``.
    end : int
        Behind its last ``>``.
    children : list of Span
    """

    tag: str
    attributes: dict[str, str]
    line: int
    start: int
    inner: tuple[int, int] = (0, 0)
    end: int = 0
    children: list[Span] = field(default_factory=list)

    def all(self, *names: str) -> Iterator[Span]:
        """Elements on a path of tags below this one."""
        found = [self]
        for name in names:
            found = [child for parent in found for child in parent.children if child.tag == name]
        return iter(found)

    @property
    def closed_in_itself(self) -> bool:
        """Whether it is written ``<tag/>``."""
        return self.inner[1] == self.end


@dataclass(frozen=True)
class Edit:
    """Bytes from `start` to `end` that are replaced."""

    start: int
    end: int
    text: bytes


def locate(data: bytes, name: str) -> Span:
    """The root element.

    Raises
    ------
    ModelError
        The file is no XML.
    """
    parser = expat.ParserCreate()
    root = Span("", {}, 0, 0)
    path = [root]

    def begin(tag: str, attributes: dict[str, str]) -> None:
        path.append(Span(tag, attributes, parser.CurrentLineNumber, parser.CurrentByteIndex))

    def finish(_: str) -> None:
        done = path.pop()
        at = parser.CurrentByteIndex  # behind <tag/>, where the end of another element may stand
        opened = _end_of_tag(data, done.start)
        closed = data[opened - 2 : opened] == b"/>"
        done.end = opened if closed else data.index(b">", at) + 1
        done.inner = (opened, opened) if closed else (opened, at)
        path[-1].children.append(done)

    parser.StartElementHandler, parser.EndElementHandler = begin, finish
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise ModelError(f"{name}: is not XML: {error}") from error
    return root.children[0]


def _end_of_tag(data: bytes, start: int) -> int:
    """Behind the ``>`` of the tag at `start`; quotes may hold one."""
    found = re.compile(rb"""<(?:[^"'>]|"[^"]*"|'[^']*')*>""").match(data, start)
    assert found is not None  # expat has read it
    return found.end()


def text(data: bytes, span: Span) -> str:
    """What stands between the tags of an element, without comments and white space around it."""
    found = re.sub(rb"<!--.*?-->", b"", data[slice(*span.inner)], flags=re.DOTALL)
    try:
        return found.decode("utf-8").strip()
    except UnicodeDecodeError:
        return found.decode("latin-1").strip()


def apply(data: bytes, edits: Iterable[Edit]) -> bytes:
    """The bytes with all edits made; they must not overlap."""
    for edit in sorted(edits, key=lambda one: (one.start, one.end), reverse=True):
        data = data[: edit.start] + edit.text + data[edit.end :]
    return data


def line_before(data: bytes, edits: Iterable[Edit], line: int) -> int:
    """The line, from 1, that a line of the edited bytes comes from; one that is new comes from where it was put."""
    new, old, at = 1, 1, 0
    for edit in sorted(edits, key=lambda one: (one.start, one.end)):
        kept = data.count(b"\n", at, edit.start)
        begins_line = edit.start == 0 or data[edit.start - 1 : edit.start] == b"\n"
        if new + kept > line or (new + kept == line and not begins_line):
            return old + line - new
        new, old = new + kept + edit.text.count(b"\n"), old + kept
        if new > line:
            return old
        old, at = old + data.count(b"\n", edit.start, edit.end), edit.end
    return old + line - new


def attribute(data: bytes, span: Span, name: str, value: str) -> Edit:
    """Gives an attribute another value; its quotes stay."""
    found = re.compile(rb"\s" + name.encode() + _VALUE, re.DOTALL).search(
        data, span.start, _end_of_tag(data, span.start)
    )
    assert found is not None  # the attribute is there
    return Edit(*found.span("value"), value.encode())


def removal(data: bytes, span: Span) -> Edit:
    """Takes an element out, with its line where nothing else stands there."""
    start = data.rfind(b"\n", 0, span.start) + 1
    stop = data.find(b"\n", span.end)
    stop = len(data) if stop < 0 else stop + 1
    alone = not data[start : span.start].strip() and not data[span.end : stop].strip()
    return Edit(start, stop, b"") if alone else Edit(span.start, span.end, b"")


def insertion(data: bytes, parent: Span, lines: Iterable[str]) -> list[Edit]:
    """Puts elements in as the first children, each on a line of its own, indented as the other ones."""
    newline = b"\r\n" if b"\r\n" in data else b"\n"
    outer = _indent(data, parent.start)
    below = [child for child in parent.children if child.line > parent.line]
    inner = _indent(data, below[0].start) if below else outer + _step(outer)
    made = b"".join(newline + inner + line.encode() for line in lines)
    if not made:
        return []
    if not parent.closed_in_itself:
        end = b"" if parent.children else newline + outer
        return [Edit(parent.inner[0], parent.inner[0], made + end)]
    opened = data[parent.start : parent.end]
    slash = parent.start + opened.rindex(b"/")
    return [Edit(slash, parent.end, b">" + made + newline + outer + f"</{parent.tag}>".encode())]


def _indent(data: bytes, at: int) -> bytes:
    """White space at the beginning of a line."""
    line = data[data.rfind(b"\n", 0, at) + 1 : at]
    return line[: len(line) - len(line.lstrip())]


def _step(outer: bytes) -> bytes:
    return b"\t" if outer.startswith(b"\t") else b"  "
