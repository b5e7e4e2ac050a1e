"""A comment of the plugin can be read without the one before it: it names its subject."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

PLUGIN = Path(__file__).resolve().parents[2] / "plugin"
COMMENT = re.compile(r"^ *///? ?(?P<words>.*)$")
LEANS = re.compile(r"(?:Of|The same|Which|That|Those)\b")
"""Openings that need the comment or the declaration before."""


def openings(text: str) -> Iterator[str]:
    """First lines of the comments and of their paragraphs."""
    is_inside = False
    for line in text.splitlines():
        found = COMMENT.match(line)
        words = found["words"] if found else ""
        if words and not is_inside:
            yield words
        is_inside = words != ""


def leaning(text: str) -> list[str]:
    """First lines of the comments that lean on what is before them."""
    return [words for words in openings(text) if LEANS.match(words)]


@pytest.mark.parametrize(("suffix", "least"), [("h", 1000), ("cpp", 300)])
def test_comments_name_their_subject(suffix: str, least: int) -> None:
    paths = PLUGIN.rglob(f"*.{suffix}")
    texts = {path.relative_to(PLUGIN).as_posix(): path.read_text(encoding="utf-8") for path in paths}
    assert sum(len(list(openings(text))) for text in texts.values()) > least
    found = [f"{name}: {words}" for name, text in texts.items() for words in leaning(text)]
    assert sorted(found) == []


def test_a_comment_that_leans_is_found() -> None:
    """The test of this test."""
    text = """
    /// Which facets face each other.
    #pragma once
    /// The facets of a surface.
    /// That wording is a line of the comment before.
    ///
    /// Those of a shell are its back faces.
    int facets();  ///< of a surface
    // The same for nodes
    int nodes();
    /// Offset of a facet.
    int offset();
    """
    assert leaning(text) == [
        "Which facets face each other.",
        "Those of a shell are its back faces.",
        "The same for nodes",
    ]
