"""The command `check`."""

import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape

from harness.preflight import check as preflight
from harness.preflight.finding import Finding, Severity

FOUND = 1  # exit code: `check` has found something
_COLOURS = {Severity.ERROR: "bold red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}
console = Console(highlight=False, width=None if sys.stdout.isatty() else 132)


def check(
    model: Annotated[Path, typer.Argument(help="A .feb file of format 2.5, 3.0 or 4.0.")],
    json: Annotated[bool, typer.Option("--json", help="Write the findings as JSON.")] = False,
) -> None:
    """Predict trouble with the contacts of a model before a run.

    The exit code is 0 without findings or with notes alone, 1 with errors or warnings, and 2 if the command cannot read
    the file.
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
