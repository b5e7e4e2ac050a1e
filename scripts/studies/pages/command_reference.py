"""The page of the commands, from the commands themselves: docs/reference/commands.md."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import inspect
import typing
from collections.abc import Callable, Sequence
from enum import Enum

from typer.models import ArgumentInfo, OptionInfo

from harness.paths import REPOSITORY
from studies.pages.texts import page_text

PAGE = "reference/commands.md"

HEAD = page_text("commands")


def page(functions: Sequence[Callable[..., None]], installed: Sequence[Callable[..., None]]) -> str:
    """The text of the page.

    Parameters
    ----------
    functions : sequence of callable
        All commands.
    installed : sequence of callable
        Commands that need no repository, in the order of the page, which has them first.
    """
    others = [function for function in functions if function not in installed]
    ordered = [*installed, *sorted(others, key=lambda function: function.__name__)]
    sections = [_section(function, function in installed) for function in ordered]
    return HEAD.format(summary=_summary()) + "\n\n".join(sections) + "\n"


def _summary() -> str:
    """What the script says of itself."""
    path = str(REPOSITORY / "scripts" / "mixcontact")
    loader = importlib.machinery.SourceFileLoader("mixcontact_script", path)
    spec = importlib.util.spec_from_loader(loader.name, loader)
    assert spec
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return (module.__doc__ or "").strip()


def _section(function: Callable[..., None], star: bool) -> str:
    about = inspect.cleandoc(function.__doc__ or "").replace("\n", " ").replace("  ", "\n\n")
    hints = typing.get_type_hints(function, include_extras=True)
    rows = [_row(parameter, hints[name]) for name, parameter in inspect.signature(function).parameters.items()]
    table = ["| option | default | meaning |", "|---|---|---|", *rows] if rows else []
    title = f"## `{function.__name__.replace('_', '-')}`{' *' if star else ''}"
    return "\n\n".join(filter(None, [title, about, "\n".join(table)]))


def _row(parameter: inspect.Parameter, hint: object) -> str:
    kind, *notes = typing.get_args(hint) if typing.get_origin(hint) is typing.Annotated else (hint,)
    told = next((note for note in notes if isinstance(note, OptionInfo | ArgumentInfo)), None)
    text = [(told.help or "").replace("|", "/")] if told else []
    choices = _choices(kind)
    if choices:
        text.append(f"One of {', '.join(f'`{choice}`' for choice in choices)}.")
    name = parameter.name.replace("_", "-")
    shown = name if told is None or isinstance(told, ArgumentInfo) else _option(told, name, kind)
    return f"| `{shown}` | {_default(parameter.default)} | {' '.join(text)} |"


def _option(told: OptionInfo, name: str, kind: object) -> str:
    """An option as one types it, with what turns it off."""
    named = told.default if isinstance(told.default, str) else f"--{name}"
    return f"{named}`, `--no-{name}" if kind is bool and not isinstance(told.default, str) else named


def _choices(kind: object) -> list[str]:
    """The values of an enumeration, also of a list of its members."""
    kinds = [kind, *typing.get_args(kind), *(each for one in typing.get_args(kind) for each in typing.get_args(one))]
    found = [each for each in kinds if isinstance(each, type) and issubclass(each, Enum)]
    return [str(choice.value) for choice in found[0]] if found else []


def _default(value: object) -> str:
    """The default as one would type it; paths below the repository without it, enumerations by their values."""
    if value is inspect.Parameter.empty:
        return "required"
    if value in (None, False, ()):
        return ""
    if value is True:
        return "on"
    text = str(getattr(value, "value", value))
    return f"`{text.removeprefix(f'{REPOSITORY}/')}`"
