"""The commands `check` and `convert`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from harness.conversion import convert as conversion
from harness.conversion.parameters import Change
from harness.errors import HarnessError
from harness.preflight import check as preflight
from harness.preflight.finding import Finding, Severity

FOUND = 1
"""Exit code: `check` has found something."""
_COLOURS = {Severity.ERROR: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}
console = Console(highlight=False, width=None if sys.stdout.isatty() else 132)


def check(
    model: Annotated[Path, typer.Argument(help="A .feb file of FEBio 4.")],
    json: Annotated[bool, typer.Option("--json", help="Write the findings as JSON.")] = False,
) -> None:
    """Predict trouble with the sliding contacts of a model before it is run.

    Exit code 0: nothing found, or notes alone; 1: errors or warnings; 2: the file cannot be read.
    """
    found = preflight.check(model)
    if json:
        typer.echo(preflight.as_json(model, found))
    else:
        for finding in found:
            _print(finding)
        console.print(f"{escape(str(model))}: {preflight.summary(found)}")
    if preflight.matter(found):
        raise typer.Exit(FOUND)


def _print(finding: Finding) -> None:
    colour = _COLOURS[finding.severity]
    console.print(
        f"[{colour}]{finding.severity.value}[/] ({finding.rule}) {escape(str(finding.place))}", soft_wrap=True
    )
    console.print(f"    {escape(finding.message)}.")
    console.print(f"    [bold]->[/] {escape(finding.suggestion)}\n")


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
    console.print(f"Written: {escape(str(target))}. Check it: scripts/mixcontact check {escape(str(target))}")


def _changes(part: str, changes: list[Change]) -> Table:
    table = Table(title=escape(part), title_justify="left")
    for column in ("line", "parameter", "", "reason"):
        table.add_column(column, overflow="fold")
    for change in changes:
        table.add_row(str(change.line), escape(change.name), change.action.value, escape(change.reason))
    return table
