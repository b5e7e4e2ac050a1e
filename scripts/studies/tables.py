"""Tables of Markdown."""

from collections.abc import Iterable, Sequence


def markdown(heads: Sequence[str], rows: Iterable[Iterable[object]]) -> str:
    """A table with these heads; each row has a cell for each, whose bars become slashes."""
    lines = [heads, *([str(cell).replace("|", "/").replace("\n", " ") for cell in row] for row in rows)]
    first, *others = (f"| {' | '.join(cells)} |" for cells in lines)
    return "\n".join([first, "|---" * len(heads) + "|", *others])
