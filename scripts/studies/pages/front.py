"""What README quotes of the pages of evidence: in the row of a page, what that page says first, in bold."""

import re

from harness.errors import DataFileError
from harness.paths import REPOSITORY

PAGE = "../README.md"  # from docs/
# A row that quotes a page: how it begins, and the page.
QUOTED = re.compile(r"^(\| \[[^\]]+\]\((docs/evidence/[\w-]+\.md)\) \|) .* \|$", re.MULTILINE)
_SAID = re.compile(r"^\*\*(.+)\*\*$", re.MULTILINE)


def page() -> str:
    """README with what the pages say now."""
    text = (REPOSITORY / "README.md").read_text(encoding="utf-8")
    return QUOTED.sub(lambda line: f"{line[1]} {said_first(line[2])} |", text)


def said_first(name: str) -> str:
    """What a page of evidence says first. Raises DataFileError for a page that says nothing in bold."""
    found = _SAID.search((REPOSITORY / name).read_text(encoding="utf-8"))
    if not found:
        raise DataFileError(f"{name} has no line in bold that says what it found")
    return found[1]
