"""The page of the contact's parameters, from the code that registers them: docs/reference/parameters.md.

Names, order, names of choices, kinds and defaults come from plugin/host/contact_parameters.h, the names of the two that
hosts read in their own ways from plugin/febio/mixture_contact.cpp, and what code does not say from
`harness.pages.parameter_notes`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.pages.parameter_notes import AUTOMATIC, GROUPS, NOTES, Note
from harness.paths import REPOSITORY

REGISTRATION = REPOSITORY / "plugin" / "febio" / "mixture_contact.cpp"
DECLARATION = REPOSITORY / "plugin" / "host" / "contact_parameters.h"
PAGE = "reference/parameters.md"

_TABLE = re.compile(r'take\(\{"(?P<name>\w+)",\s+"[^"]+"(?P<rest>[^}]*)\},\s+p\.(?P<member>\w+)\);')
_REGISTERED = re.compile(r'ADD_(?P<what>PARAMETER|PROPERTY)\(\w+(?:\.(?P<member>\w+))?, "(?P<name>\w+)"(?P<rest>[^;]*)')
_DECLARED = re.compile(r"^  (?P<kind>bool|int|double|std::string) (?P<member>\w+) = (?P<value>[^;]+);", re.MULTILINE)
_CHOICES = re.compile(r'"([^"]+\\0)"')


@dataclass(frozen=True)
class Parameter:
    """A parameter as the code registers it.

    Attributes
    ----------
    name : str
    kind : str
        ``bool``, ``int``, ``double`` or ``std::string``; ``property`` for what has values of its own.
    default : str
    choices : tuple of str
        Names of the values, if they have names.
    """

    name: str
    kind: str
    default: str
    choices: tuple[str, ...] = ()


def registered() -> list[Parameter]:
    """All parameters, in the order of their registration.

    Raises
    ------
    DataFileError
        Where a registration is not understood, or a registered member is not declared.
    """
    table = DECLARATION.read_text(encoding="utf-8")
    declared = {match["member"]: match for match in _DECLARED.finditer(table)}
    shared = _matches(_TABLE, r"  take\(", DECLARATION)
    own = _matches(_REGISTERED, r"ADD_(?:PARAMETER|PROPERTY)\(", REGISTRATION)
    return [_parameter(match, declared) for match in (*shared, *own)]


def _matches(pattern: re.Pattern[str], begin: str, path: Path) -> list[re.Match[str]]:
    """What matches in a file, where nothing may begin like it and go on in another way."""
    text = path.read_text(encoding="utf-8")
    found = list(pattern.finditer(text))
    if len(found) != len(re.findall(begin, text)):
        raise DataFileError(f"{path}: a registration is not of the form {pattern.pattern}")
    return found


def _parameter(match: re.Match[str], declared: dict[str, re.Match[str]]) -> Parameter:
    name, member = match["name"], match["member"]
    if member is None:
        return Parameter(name, "property", "0")
    if member not in declared:
        raise DataFileError(f"{DECLARATION}: '{member}', which is registered as '{name}', is not declared there")
    kind, value = declared[member]["kind"], declared[member]["value"]
    choices = _CHOICES.search(match["rest"])
    names = tuple(choices.group(1).strip("\\0").split("\\0")) if choices else ()
    return Parameter(name, kind, _shown(kind, value, names), names)


def _shown(kind: str, value: str, choices: tuple[str, ...]) -> str:
    if choices:
        return f"`{choices[int(value)]}`"
    if kind == "std::string":
        return f"`{value.strip(chr(34))}`"
    return {"false": "0", "true": "1"}[value] if kind == "bool" else value


def page() -> str:
    """The text of the page.

    Raises
    ------
    DataFileError
        Where the notes and the registration do not name the same parameters.
    """
    parameters = {parameter.name: parameter for parameter in registered()}
    noted = [name for group in GROUPS for name in group.names]
    if set(parameters) != set(NOTES) or sorted(noted) != sorted(NOTES):
        odd = set(parameters) ^ set(NOTES) | set(noted) ^ set(NOTES)
        raise DataFileError(
            f"harness/pages/parameter_notes.py and {REGISTRATION.name} do not agree on {', '.join(sorted(odd))}"
        )
    sections = [f"## {group.title}\n\n{group.about}\n\n{_table(parameters, group.names)}" for group in GROUPS]
    return "\n\n".join([_INTRODUCTION, *sections]) + "\n"


_INTRODUCTION = """\
# Parameters

<!-- Written by `scripts/mixcontact pages` from the code that registers them and harness/pages/parameter_notes.py. -->

Parameters of `<contact type="sliding-mixture">`. Units are those of the models here: mm, N, s, nmol, so MPa and mM;
FEBio has none of its own, and any consistent set will do. A parameter that is not on this page is an error. So is a
value without meaning; the message names the parameter. "Same" means the same name, meaning and default as in those of
FEBio's interfaces (`sliding-elastic`, `sliding-biphasic`, `sliding-biphasic-solute`, `sliding-multiphasic`) that have
it.

Which one to change first stands in the [how-to](../how-to/parameters.md#which-parameter-first)."""


def _table(parameters: dict[str, Parameter], names: tuple[str, ...]) -> str:
    lines = [
        "| parameter | unit | default | meaning and effect | price | in FEBio's interfaces |",
        "|---|---|---|---|---|---|",
    ]
    return "\n".join([*lines, *(_row(parameters[name], NOTES[name]) for name in names)])


def _row(parameter: Parameter, note: Note) -> str:
    unit = note.unit or ("0, 1" if parameter.kind == "bool" else "-")
    default = "automatic" if parameter.name in AUTOMATIC else note.default or parameter.default
    return f"| `{parameter.name}` | {unit} | {default} | {note.effect} | {note.price} | {note.febio} |"
