"""The command `convert`."""

import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from harness.conversion import convert as conversion
from harness.conversion.fates import Change
from harness.conversion.sources import converted_name
from harness.errors import HarnessError
from harness.paths import command_name

console = Console(highlight=False, width=None if sys.stdout.isatty() else 132)


def convert(
    model: Annotated[
        Path, typer.Argument(help="A .feb file of format 2.5, 3.0 or 4.0 with FEBio's sliding or tied interfaces.")
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            help="Write the new model to this file; the default is <model>-mixture.feb next to the old one.",
        ),
    ] = None,
    in_place: Annotated[bool, typer.Option("--in-place", help="Change the model file itself.")] = False,
) -> None:
    """Convert a model to sliding-mixture and tied-mixture, and report each parameter as kept, mapped or dropped.

    The command leaves all other bytes of the file unchanged. It writes contacts of included files to new files next to
    the included ones, and the new model reads these. It refuses a model whose physics would change. The exit code is 0
    if it has written the new model, and 2 if it has not.
    """
    if in_place and output is not None:
        raise typer.BadParameter("--output and --in-place exclude each other")
    beside = converted_name(model)
    target = model if in_place else output or beside
    if target == beside and target.exists():
        raise HarnessError(f"{target} exists already; name another file by --output")
    converted = conversion.convert(model)
    _check_folder(model, target, converted.reads)
    _check_target(model, target, converted.files)
    files = {**converted.included, target: converted.data}
    for path, data in converted.included.items():  # what is there is not written over, unless it is the same
        if path.exists() and path.read_bytes() != data:
            raise HarnessError(f"{path}, for the contacts of an included file, exists already; move or delete it first")
    for path, data in files.items():
        _write(path, data)
    for part, changes in converted.changes.items():
        console.print(_changes(part, changes))
    written = ", ".join(escape(str(path)) for path in files)
    console.print(f"Written: {written}. Check it: {command_name()} check {escape(str(target))}")


def _check_folder(model: Path, target: Path, reads: Sequence[str]) -> None:
    """FEBio looks for files beside the model that names them."""
    near = [name for name in reads if not Path(name).is_absolute()]
    if near and target.resolve().parent != model.resolve().parent:
        raise HarnessError(
            f"{model} reads {', '.join(near)} from its folder, so the new model has to be there too: "
            f"name an --output in {model.parent}"
        )


def _check_target(model: Path, target: Path, read: Iterable[Path]) -> None:
    """No folder is made for the new model, and no other file of the old one is written over."""
    if not target.parent.is_dir():
        raise HarnessError(
            f"{target}: there is no folder {target.parent}; make this folder first, or name another --output"
        )
    if target.is_dir():
        raise HarnessError(f"{target} is a folder; name a file by --output")
    if target.suffix != ".feb":
        raise HarnessError(f"{target}: a model file ends in .feb; name another --output")
    others = (file for file in read if file.resolve() != model.resolve())
    if any(file.resolve() == target.resolve() for file in others):
        raise HarnessError(f"{model} reads {target}; name another --output")


def _write(path: Path, data: bytes) -> None:
    try:
        path.write_bytes(data)
    except OSError as error:
        raise HarnessError(f"{path}: cannot be written ({error.strerror or error})") from error


def _changes(part: str, changes: list[Change]) -> Table:
    table = Table(title=escape(part), title_justify="left")
    for column in ("line", "parameter", "", "reason"):
        table.add_column(column, overflow="fold")
    for change in changes:
        table.add_row(str(change.line), escape(change.name), change.action.value, escape(change.reason))
    return table
