"""The command `convert`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from harness.conversion import convert as conversion
from harness.conversion.fates import Change
from harness.errors import HarnessError
from harness.paths import command_name

console = Console(highlight=False, width=None if sys.stdout.isatty() else 132)


def convert(
    model: Annotated[Path, typer.Argument(help="A .feb file of FEBio 4 with one of FEBio's sliding interfaces.")],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The new file; by default <model>-mixture.feb beside the old one."),
    ] = None,
    in_place: Annotated[bool, typer.Option("--in-place", help="Change the model file itself.")] = False,
) -> None:
    """Switch a model to sliding-mixture, keep all else byte for byte, and say what became of each parameter.

    Refuses where the physics would change. Exit code 0: written; 2: not converted.
    """
    if in_place and output is not None:
        raise typer.BadParameter("--output and --in-place exclude each other")
    beside = model.with_name(f"{model.stem}-mixture.feb")
    target = model if in_place else output or beside
    if target == beside and target.exists():
        raise HarnessError(f"{target} is there already; name a file by --output")
    converted = conversion.convert(model)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(converted.data)
    except OSError as error:
        raise HarnessError(f"{target}: cannot be written ({error.strerror or error})") from error
    for part, changes in converted.changes.items():
        console.print(_changes(part, changes))
    console.print(f"Written: {escape(str(target))}. Check it: {command_name()} check {escape(str(target))}")


def _changes(part: str, changes: list[Change]) -> Table:
    table = Table(title=escape(part), title_justify="left")
    for column in ("line", "parameter", "", "reason"):
        table.add_column(column, overflow="fold")
    for change in changes:
        table.add_row(str(change.line), escape(change.name), change.action.value, escape(change.reason))
    return table
