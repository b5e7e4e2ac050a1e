"""Tables of Markdown, and rows in groups."""

from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import TypeVar

Row = TypeVar("Row")
Key = TypeVar("Key", bound=Hashable)


def markdown(heads: Sequence[str], rows: Iterable[Iterable[object]]) -> str:
    """A table with these heads; each row has a cell for each, whose bars become slashes."""
    lines = [heads, *([str(cell).replace("|", "/").replace("\n", " ") for cell in row] for row in rows)]
    first, *others = (f"| {' | '.join(cells)} |" for cells in lines)
    return "\n".join([first, "|---" * len(heads) + "|", *others])


def grouped(rows: Iterable[Row], key: Callable[[Row], Key]) -> dict[Key, list[Row]]:
    """Rows by a key, in the order in which they come."""
    found: dict[Key, list[Row]] = {}
    for row in rows:
        found.setdefault(key(row), []).append(row)
    return found
