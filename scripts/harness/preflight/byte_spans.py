"""Where the tags of an XML file stand: in lines, for messages, and in bytes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat


@dataclass(frozen=True)
class Place:
    """A tag in a file."""

    file: Path
    line: int  # from 1; where the tag begins
    tag: str  # as in the file, with the attribute that tells it from its like: ``<contact name="joint">``

    def __str__(self) -> str:
        return f"{self.file}, line {self.line}: {self.tag}"


@dataclass
class Span:
    """An element in the bytes of a file."""

    tag: str
    attributes: dict[str, str]
    line: int  # from 1
    start: int  # of its ``<``
    # What stands between its tags; empty, at the end of the tag, where it is ``<tag/>``.
    inner: tuple[int, int] = (0, 0)
    end: int = 0  # behind its last ``>``
    children: list[Span] = field(default_factory=list)

    def walk(self) -> Iterator[Span]:
        """The element and all within it, in the order in which they begin."""
        yield self
        for child in self.children:
            yield from child.walk()

    @property
    def closed_in_itself(self) -> bool:
        """Whether it is written ``<tag/>``."""
        return self.inner[1] == self.end


def locate(data: bytes) -> Span:
    """The root element of a file that is XML."""
    parser = expat.ParserCreate()
    root = Span("", {}, 0, 0)
    path = [root]

    def begin(tag: str, attributes: dict[str, str]) -> None:
        path.append(Span(tag, attributes, parser.CurrentLineNumber, parser.CurrentByteIndex))

    def finish(_: str) -> None:
        done = path.pop()
        at = parser.CurrentByteIndex  # behind <tag/>, where the end of another element may stand
        opened = end_of_tag(data, done.start)
        closed = data[opened - 2 : opened] == b"/>"
        done.end = opened if closed else data.index(b">", at) + 1
        done.inner = (opened, opened) if closed else (opened, at)
        path[-1].children.append(done)

    parser.StartElementHandler, parser.EndElementHandler = begin, finish
    parser.Parse(data, True)
    return root.children[0]


def end_of_tag(data: bytes, start: int) -> int:
    """Behind the ``>`` of the tag at `start`; quotes may hold one."""
    found = re.compile(rb"""<(?:[^"'>]|"[^"]*"|'[^']*')*>""").match(data, start)
    assert found is not None  # expat has read it
    return found.end()
