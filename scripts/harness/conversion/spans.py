"""Changes to the bytes of an XML file that leave all others alone."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

from harness.preflight.byte_spans import Span, end_of_tag

_VALUE = rb"""\s*=\s*(?P<quote>["'])(?P<value>.*?)(?P=quote)"""


@dataclass(frozen=True)
class Edit:
    """Bytes from `start` to `end` that are replaced."""

    start: int
    end: int
    text: bytes


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
        data, span.start, end_of_tag(data, span.start)
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
    inner = _indent(data, below[0].start) if below else outer + (b"\t" if outer.startswith(b"\t") else b"  ")
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
    line = data[data.rfind(b"\n", 0, at) + 1 : at]
    return line[: len(line) - len(line.lstrip())]
