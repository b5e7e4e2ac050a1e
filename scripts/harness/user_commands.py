"""What everybody can do who has the harness, with or without the repository; and what is said where a command fails."""

from __future__ import annotations

import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from pathlib import Path

import typer
from rich.console import Console
from rich.markup import escape

from harness.errors import HarnessError

BAD_INPUT, OUR_FAULT = 2, 4
"""Exit codes: the input cannot be used; a fault in here."""

_ABOUT = "Make, run and check models of contact between mixtures."
FOR_EVERYBODY = {
    "convert": "harness.conversion.command",
    "check": "harness.preflight.command",
    "run": "harness.run.command",
    "report": "harness.report.command",
    "validate": "harness.validate.command",
    "plot": "harness.validate.command",
    "models": "harness.collection.command",
}
"""Commands and the modules that hold their functions, which have the commands' names."""


def function(name: str, known: Mapping[str, str]) -> Callable[..., None]:
    """The function behind a command."""
    found: Callable[..., None] = getattr(import_module(known[name]), name.replace("-", "_"))
    return found


def commands(known: Mapping[str, str], arguments: Sequence[str] = ()) -> typer.Typer:
    """The commands, or that alone which the arguments begin with: what the others need takes a second to import."""
    app = typer.Typer(add_completion=False, no_args_is_help=True)
    app.callback(help=_ABOUT)(lambda: None)
    for name in [*arguments[:1]] if set(arguments[:1]) & set(known) else known:
        app.command(name)(function(name, known))
    return app


def start(app: typer.Typer, program: str) -> None:
    """Run the command line of a program; an error that concerns the user is one paragraph, not a traceback."""
    try:
        app(prog_name=program)
    except HarnessError as error:
        _complain(str(error))
        sys.exit(BAD_INPUT)
    except Exception as fault:  # the last resort: whatever it is, a user gets a sentence
        _complain(
            f"this is a fault of mixcontact ({type(fault).__name__}: {str(fault)[:200]}); please report it with "
            f"{_written_down(fault)} and the input."
        )
        sys.exit(OUR_FAULT)


def _complain(message: str) -> None:
    Console(stderr=True, highlight=False).print(f"[bold red]error:[/] {escape(message)}", soft_wrap=True)


def _written_down(fault: Exception) -> Path:
    """The file with the traceback and the command."""
    handle, name = tempfile.mkstemp(prefix="mixcontact-fault-", suffix=".txt")
    with open(handle, "w", encoding="utf-8") as out:  # noqa: PTH123 - of a handle
        out.write(f"{sys.argv}\n\n{''.join(traceback.format_exception(fault))}")
    return Path(name)


def main() -> None:
    """Run the command line of an installed harness."""
    start(commands(FOR_EVERYBODY, sys.argv[1:]), "mixcontact")
