"""What everybody can do who has the harness, with or without the repository; and what is said where a command fails."""

import ast
import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import typer
from rich.console import Console
from rich.markup import escape

from harness.errors import HarnessError

BAD_INPUT, OUR_FAULT = 2, 4  # exit codes: the input cannot be used; a fault in here

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


def described(name: str, known: Mapping[str, str]) -> Callable[[], None]:
    """A stand-in for a command that has its help, read from its module's text: importing all takes seconds."""
    spec = find_spec(known[name])
    text = Path(spec.origin).read_text(encoding="utf-8") if spec and spec.origin else ""
    defined = (node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef))
    found = {node.name: ast.get_docstring(node) for node in defined}

    def stand_in() -> None:
        raise HarnessError(f"the command has to be the first word: {name}")

    stand_in.__doc__ = found[name.replace("-", "_")]
    return stand_in


def commands(known: Mapping[str, str], arguments: Sequence[str] | None = None) -> typer.Typer:
    """The commands; that alone which the arguments begin with, or a list of all where they begin with none."""
    app = typer.Typer(add_completion=False, no_args_is_help=True)
    app.callback(help=_ABOUT)(lambda: None)
    called = known if arguments is None else [name for name in arguments[:1] if name in known]
    for name in called or known:
        found = function(name, known) if called else described(name, known)
        paragraphs = (found.__doc__ or "").split("\n\n")  # one line each, which a terminal of any width breaks
        app.command(name, help="\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs))(found)
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
    handle, name = tempfile.mkstemp(prefix="mixcontact-fault-", suffix=".txt")
    with open(handle, "w", encoding="utf-8") as out:  # noqa: PTH123 - of a handle
        out.write(f"{sys.argv}\n\n{''.join(traceback.format_exception(fault))}")
    return Path(name)


def main() -> None:
    """Run the command line of an installed harness."""
    start(commands(FOR_EVERYBODY, sys.argv[1:]), "mixcontact")
