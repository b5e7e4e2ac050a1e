"""Counts the words of the documentation without its reference, which is looked up and not read.

    python scripts/prose/count.py

A word is what stands between spaces and has a letter in it, in text, tables, code and formulas alike.
"""

import re
from collections import Counter
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "docs"
REFERENCE = "reference"
MOST = 20_000  # words that the documentation may have


def words(text: str) -> int:
    """The number of words in a text."""
    return sum(bool(re.search(r"[A-Za-z]", word)) for word in text.split())


def counts() -> Counter[str]:
    """Words by folder of the documentation, or by page where it is in none."""
    found: Counter[str] = Counter()
    for page in sorted(DOCS.rglob("*.md")):
        place = page.relative_to(DOCS).parts[0]
        if place != REFERENCE:
            found[place] += words(page.read_text(encoding="utf-8"))
    return found


if __name__ == "__main__":
    for place, number in counts().most_common():
        print(f"{number:6} {place}")
    print(f"{counts().total():6} of at most {MOST}")
