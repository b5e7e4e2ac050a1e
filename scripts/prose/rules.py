"""The rules of `house`, in a part of Vale's format, and one that the format cannot express: fragments."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import yaml
from lemminflect import getAllInflections, getAllLemmas

from prose.text import Sentence

HOUSE = Path(__file__).parent / "house"
Rule = Callable[[Sentence], Iterator[str]]


def substitution(rule: dict[str, Any]) -> Rule:
    """Words with others in their place, anywhere."""
    swaps = [(re.compile(word, re.IGNORECASE), other) for word, other in rule["swap"].items()]

    def found(sentence: Sentence) -> Iterator[str]:
        for word, other in swaps:
            for match in word.finditer(sentence.text):
                yield rule["message"].replace("%s", match[0], 1).replace("%s", other, 1)

    return found


def existence(rule: dict[str, Any]) -> Rule:
    """Patterns that a whole sentence must not have."""
    patterns = [re.compile(raw) for raw in rule["raw"]]

    def found(sentence: Sentence) -> Iterator[str]:
        if sentence.whole:
            matches = (pattern.search(sentence.text) for pattern in patterns)
            yield from (rule["message"].replace("%s", match[0][:60]) for match in matches if match)

    return found


def occurrence(rule: dict[str, Any]) -> Rule:
    """A pattern that a whole sentence may have so many times."""
    token = re.compile(rule["token"])

    def found(sentence: Sentence) -> Iterator[str]:
        count = len(token.findall(sentence.text))
        if sentence.whole and count > rule["max"]:
            yield rule["message"].replace("%s", str(count))

    return found


KINDS = {"substitution": substitution, "existence": existence, "occurrence": occurrence}

ARTICLES = {"a", "an", "the", "its", "their", "our", "your", "no", "each", "every"}
PREPOSITIONS = {"of", "in", "on", "at", "by", "from", "with", "for", "between"}
NO_VERB_AFTER = ARTICLES | PREPOSITIONS
"""Words that a finite verb does not follow."""
FINITE = ("VB", "VBP", "VBZ", "VBD", "MD")


def is_finite_verb(word: str) -> bool:
    """True where the lexicon has the word as a finite form of a verb."""
    for kind in ("AUX", "VERB"):
        for lemma in getAllLemmas(word, upos=kind).get(kind, ()):
            forms = getAllInflections(lemma, upos=kind)
            if any(word in forms.get(tag, ()) for tag in FINITE):
                return True
    return False


def fragment(sentence: Sentence) -> Iterator[str]:
    """A sentence that ends with a full stop and in which no word can be its verb."""
    words = re.findall(r"[A-Za-z0-9']+", sentence.text)
    begun_before = sentence.text[:1].islower()  # a sentence that goes on after a displayed formula
    if not sentence.whole or begun_before or not sentence.text.endswith(".") or len(words) < 2:
        return
    pairs = zip(["", *words], words, strict=False)
    if not any(is_finite_verb(word.lower()) for before, word in pairs if before.lower() not in NO_VERB_AFTER):
        yield "a sentence without a verb"


def rule(name: str) -> Rule:
    """The rule of a file in `house`."""
    text = yaml.safe_load((HOUSE / f"{name}.yml").read_text(encoding="utf-8"))
    return KINDS[text["extends"]](text)


def house() -> list[Rule]:
    """All rules."""
    return [*(rule(path.stem) for path in sorted(HOUSE.glob("*.yml"))), fragment]


@cache
def of_comments() -> list[Rule]:
    """The rules of comments in C++, which may be noun phrases, and long with their formulas."""
    return [rule(name) for name in ("fronted", "noun_what", "openings", "words")]
