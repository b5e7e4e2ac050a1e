"""The page of messages has every message of the plugin, and none that is gone. Needs neither FEBio nor a build."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PLUGIN = ROOT / "plugin"
PAGE = (ROOT / "docs" / "reference" / "messages.md").read_text(encoding="utf-8")
OF_FEBIO = "## FEBio's messages"
"""Section with messages that are not in these sources."""
WORDS = 5
"""Words in a piece of text that is a message, at least: names of parameters and variables are shorter."""
PIECE = re.compile(r'"((?:[^"\\\n]|\\.)*)"|//[^\n]*')
LONG_NAMES = "contact_parameters.h"
"""Where the long names of parameters are, which FEBio Studio shows."""


def statements(code: str) -> Iterator[list[str]]:
    """The texts in double quotes of each statement, without comments."""
    held: list[str] = []

    def keep(match: re.Match[str]) -> str:
        if match[1] is None:
            return ""
        held.append(match[1].replace('\\"', '"').replace("\\n", ""))
        return f'"{len(held) - 1}"'

    for statement in re.split(r"[;{}]", PIECE.sub(keep, code)):
        yield [held[int(number)] for number in re.findall(r'"(\d+)"', statement)]


def messages() -> dict[str, str]:
    """Where each message begins, by its text; numbers and names between its pieces are left out."""
    found: dict[str, str] = {}
    for path in sorted([*PLUGIN.rglob("*.cpp"), *PLUGIN.rglob("*.h")]):
        if "standalone" in path.parts or path.name == LONG_NAMES:
            continue
        for pieces in statements(path.read_text(encoding="utf-8")):
            if any(len(re.findall(r"[A-Za-z]{2,}", piece)) >= WORDS for piece in pieces):
                found["".join(pieces)] = path.relative_to(ROOT).as_posix()
    return found


def documented(text: str) -> list[list[str]]:
    """The parts of each message in the first columns of the tables; `...` is between two parts."""
    cells = re.findall(r"^\| `(.+?)`(?:,? .*?)? \|", text, re.MULTILINE)
    return [[part.strip(" ,") for part in cell.split("...")] for cell in cells]


def fits(parts: list[str], message: str) -> bool:
    """Whether all parts are in a message, one after the other."""
    place = 0
    for part in parts:
        place = message.find(part, place)
        if place < 0:
            return False
        place += len(part)
    return True


MESSAGES = messages()
OURS = documented(PAGE.split(OF_FEBIO)[0])


@pytest.mark.parametrize("message", MESSAGES, ids=lambda message: message.strip()[:50])
def test_a_message_of_the_plugin_is_on_the_page(message):
    """Where this fails: add a row to docs/reference/messages.md."""
    assert any(fits(parts, message) for parts in OURS), f"{MESSAGES[message]}: {message}"


@pytest.fixture(scope="module")
def texts() -> set[str]:
    """All texts of the plugin, statement by statement."""
    files = [*PLUGIN.rglob("*.cpp"), *PLUGIN.rglob("*.h")]
    return {"".join(pieces) for path in files for pieces in statements(path.read_text(encoding="utf-8"))}


@pytest.mark.parametrize("parts", OURS, ids=" ... ".join)
def test_a_message_on_the_page_is_in_the_code(parts, texts):
    assert parts == ["augmentation # 1"] or any(fits(parts, text) for text in texts)  # that line is FEBio's


def test_a_new_message_would_be_missed():
    code = 'f() { throw Error("the moon is in the wrong house of the " + name + " \\"sky\\"."); } // "no message"\n'
    assert list(statements(code))[1] == ["the moon is in the wrong house of the ", ' "sky".']
    assert not any(fits(parts, "the moon is in the wrong house of the sky.") for parts in OURS)
