"""Names that a command is given, of those that it knows."""

from collections.abc import Collection, Sequence

import typer


def chosen(names: Sequence[str] | None, known: Collection[str], option: str = "--only") -> list[str]:
    """The names that are given with an option; all that are known where none is.

    Raises typer.BadParameter where a name is not known.
    """
    for name in names or ():
        if name not in known:
            raise typer.BadParameter(f"'{name}' is not one of {', '.join(known)}", param_hint=option)
    return list(names or known)
