"""The page of the commands, from the commands themselves: docs/reference/commands.md."""

import ast
import re
from collections.abc import Container

import typer
from typer.cli import get_docs_for_click
from typer.core import TyperGroup

from harness.paths import REPOSITORY
from studies.pages.texts import page_text

PAGE = "reference/commands.md"
_USAGE = re.compile(r"\*\*Usage\*\*:\n\n```console\n.*?\n```\n\n", re.DOTALL)
_HELP = re.compile(r"(?:\*\*Options\*\*:\n\n)?\* `--help`: Show this message and exit\.\n")
_DEFAULT = re.compile(r"\[default: ([^;\]]+)")


def page(app: typer.Typer, installed: Container[str]) -> str:
    """The text of the page.

    app: all commands; those that need no repository come first.
    installed: names of commands that need no repository.
    """
    group = typer.main.get_group(app)
    names = sorted(group.commands, key=lambda name: (name not in installed, name if name not in installed else ""))
    sections = [_section(group, name, name in installed) for name in names]
    return page_text("commands").format(summary=_summary()) + "\n\n".join(sections) + "\n"


def _summary() -> str:
    script = (REPOSITORY / "scripts" / "mixcontact").read_text(encoding="utf-8")
    return ast.get_docstring(ast.parse(script)) or ""


def _section(group: TyperGroup, name: str, star: bool) -> str:
    """What typer says of a command, defaults as code and paths without the repository; a star where all have it."""
    said = get_docs_for_click(obj=group.commands[name], ctx=typer.Context(group), indent=1, name=name)
    for needless in (_USAGE, _HELP):
        said = needless.sub("", said)
    said = _DEFAULT.sub(r"[default: `\1`", said)
    title, rest = said.replace(f"{REPOSITORY}/", "").split("\n", 1)
    return f"{title}{' *' if star else ''}\n{rest}".strip()
