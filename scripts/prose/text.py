"""Sentences of a page of Markdown, without code, formulas and raw HTML."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin

PARSER = MarkdownIt("commonmark").enable("table").use(dollarmath_plugin, double_inline=True)
ABBREVIATIONS = re.compile(r"\b(e\.g|i\.e|cf|vs|Fig|Eng|Mech|al|Commun|Numer|Anal|Comput|Methods|Appl|Meth)\. ")
END = re.compile(r"(?<=[.?!])\s+(?=[A-Z`\"(\u00c0-\u00dd])")
CODE, FORMULA, RELATION = "Code", "X", "X is"  # words for a name in code, a formula, and a formula that says something
TERM = re.compile(rf"^{CODE}(, {CODE})*: ")  # names that a line of a list explains


@dataclass(frozen=True)
class Sentence:
    """
    A sentence, or the text of a heading or of a cell of a table.

    Attributes
    ----------
    line
        Line of the page on which its paragraph begins.
    text
        Words with one space between them.
    whole
        False for a heading or a cell, which need no verb.
    """

    line: int
    text: str
    whole: bool


def without_title(children: list[Token]) -> list[Token]:
    """A paragraph without a title in bold: words that end with a colon, or with another mark before further words."""
    if children and children[0].content == "":
        children = children[1:]
    if not children or children[0].type != "strong_open":
        return children
    close = [child.type for child in children].index("strong_close")
    rest = children[close + 1 :]
    title = children[close - 1].content
    more = any(child.content.strip() for child in rest)
    return rest if title.endswith(":") or (more and title.endswith((".", "?"))) else children


def word(token: Token) -> str:
    """The words of a part of a paragraph."""
    if token.type.startswith("math_inline"):
        return RELATION if re.search(r"[=<>]|\\[lg]e\b", token.content) else FORMULA
    return {"code_inline": CODE, "softbreak": " ", "image": ""}.get(token.type, token.content)


def plain(token: Token) -> str:
    """The words of a paragraph."""
    parts = (word(child) for child in without_title(token.children or []) if child.type != "html_inline")
    return re.sub(r"\s+", " ", "".join(parts)).strip()


def split(text: str) -> list[str]:
    """The sentences of a paragraph."""
    kept = ABBREVIATIONS.sub(lambda match: f"{match[1]}.\u00a0", text)
    return [sentence.replace("\u00a0", " ") for sentence in END.split(kept)]


def sentences(markdown: str) -> Iterator[Sentence]:
    """All sentences of a page, in order."""
    inside, line = "", 0
    for token in PARSER.parse(markdown):
        if token.type in ("heading_open", "th_open", "td_open", "paragraph_open"):
            inside = token.type
        line = token.map[0] + 1 if token.map else line
        if token.type == "inline":
            for text in split(TERM.sub("", plain(token))):
                if text:
                    yield Sentence(line, text, inside == "paragraph_open")
