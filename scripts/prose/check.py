"""Holds README, CONTRIBUTING, all pages and the help of the commands to the style.

    python scripts/prose/check.py [file ...]

The help of each command is on the page of commands. Exit code 1: something was found on a page that is not pending.
"""

from __future__ import annotations

import ast
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from prose.rules import Rule, house  # noqa: E402
from prose.text import Sentence, sentences  # noqa: E402

PENDING = Path(__file__).parent / "pending.txt"
ENTRY = "scripts/mixcontact"


def pages() -> list[str]:
    """All that is checked, from the root of the repository."""
    found = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "plugin").rglob("*.md")]
    return [*sorted(path.relative_to(ROOT).as_posix() for path in found), ENTRY]


def pending() -> tuple[str, ...]:
    """Pages that are not held to the style yet; a name that ends with a slash is a folder of them."""
    lines = PENDING.read_text(encoding="utf-8").splitlines()
    return tuple(line for line in lines if line and not line.startswith("#"))


def read(name: str) -> list[Sentence]:
    """Sentences of a page. Each line of the entry's help counts as a cell of a table: it is a list of commands."""
    text = (ROOT / name).read_text(encoding="utf-8")
    if name != ENTRY:
        return list(sentences(text))
    lines = enumerate((ast.get_docstring(ast.parse(text)) or "").splitlines(), start=2)
    return [Sentence(number, line.strip(), whole=False) for number, line in lines]


def findings(name: str, rules: list[Rule]) -> list[str]:
    """What the rules object to on a page, with its place and the sentence."""
    return [
        f"{name}:{sentence.line}: {complaint}: {sentence.text[:100]}"
        for sentence in read(name)
        for rule in rules
        for complaint in rule(sentence)
    ]


def main(names: list[str]) -> int:
    rules, failed, later = house(), 0, () if names else pending()
    for name in names or pages():
        found = findings(name, rules)
        if name.startswith(later):
            print(f"{name}: {len(found)} findings, pending")
            continue
        failed += len(found)
        print("".join(f"{line}\n" for line in found), end="")
    print(f"prose: {failed} findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
