"""The page of the contact's parameters, from the code that registers them: docs/reference/parameters.md.

Names, groups, order, names of choices, kinds and defaults come from plugin/host/contact_parameters.h, the names of
values that hosts read in their own ways, the ambient ones and those of a membrane per solute, from
plugin/febio/mixture_contact.cpp, and what code does not say from `studies.pages.parameter_notes`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.paths import REPOSITORY
from studies.pages.parameter_notes import ABOUT, AUTOMATIC, NOTES, OLD_MODELS, Note

REGISTRATION = REPOSITORY / "plugin" / "febio" / "mixture_contact.cpp"
DECLARATION = REPOSITORY / "plugin" / "host" / "contact_parameters.h"
PAGE = "reference/parameters.md"

OWN_GROUPS = {"ambient_pressure": "ambient", "ambient_concentration": "ambient"}
"""The groups of those that hosts read in their own ways; that of the others is the membrane's."""

_TABLE = re.compile(
    r'take(?:_given)?\(\{"(?P<name>\w+)",\s+"[^"]+",\s+Group::(?P<group>\w+)(?P<rest>[^}]*)\},'
    r"\s+p\.(?P<member>[\w.]+?)(?:\[Side::\w+\])?(?P<further>\.\w+)?\);"
)
_REGISTERED = re.compile(r'ADD_(?:PARAMETER|PROPERTY)\((?:\w+\.)?(?P<member>[\w.]+), "(?P<name>\w+)"(?P<rest>[^;]*)')
_STRUCT = re.compile(r"^struct (?P<name>\w+) \{\n(?P<body>.*?)^\};", re.MULTILINE | re.DOTALL)
_DECLARED = re.compile(
    r"^  (?:(?P<kind>bool|int|double|std::string)|Given<(?P<given>[\w:]+)>|(?P<varying>Varying)"
    r"|(?:mixture_contact::PerSide<)?(?P<struct>\w+Parameters)>?) "
    r"(?P<member>\w+)(?: = (?P<value>[^;]+)|\{+(?P<braced>[^{}]+)\}+)?;",
    re.MULTILINE,
)
_CHOICES = re.compile(r'"([^"]+\\0)"')
_HEADING = re.compile(r'case ParameterGroup::(\w+):\s+return (?:"([^"]+)"|nullptr);')


@dataclass(frozen=True)
class Parameter:
    """A parameter as the code registers it.

    Attributes
    ----------
    name : str
    group : str
        Name of its group in the code.
    kind : str
        ``bool``, ``int``, ``double`` or ``std::string``; ``property`` for what has values of its own.
    default : str
    choices : tuple of str
        Names of the values, if they have names.
    """

    name: str
    group: str
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
    declared = _declared(DECLARATION.read_text(encoding="utf-8"), "ContactParameters")
    shared = _matches(_TABLE, r"\n  take(?:_given)?\(", DECLARATION)
    own = _matches(_REGISTERED, r"ADD_(?:PARAMETER|PROPERTY)\(", REGISTRATION)
    return [_parameter(match, declared) for match in (*shared, *own)]


def headings() -> dict[str, str]:
    """The heading of each group of parameters, by its name in the code.

    Raises
    ------
    DataFileError
        Where the code does not say them.
    """
    found = _HEADING.findall(DECLARATION.read_text(encoding="utf-8"))
    if not found:
        raise DataFileError(f"{DECLARATION}: the groups of parameters and their headings are not found")
    return {group: title or OLD_MODELS for group, title in found}


def _declared(text: str, struct: str) -> dict[str, tuple[str, str]]:
    """Kind and default of each member of a struct, and of those of its members, with dots between names."""
    bodies = {match["name"]: match["body"] for match in _STRUCT.finditer(text)}
    members: dict[str, tuple[str, str]] = {}
    for match in _DECLARED.finditer(bodies[struct]):
        name, inner = match["member"], match["struct"]
        if inner is not None:
            members |= {f"{name}.{member}": found for member, found in _declared(text, inner).items()}
            continue
        kind = match["kind"] or match["given"] or "double"
        members[name] = kind, match["value"] or match["braced"] or {"bool": "false"}.get(kind, "0")
    return members


def _matches(pattern: re.Pattern[str], begin: str, path: Path) -> list[re.Match[str]]:
    """What matches in a file, where nothing may begin like it and go on in another way."""
    text = path.read_text(encoding="utf-8")
    found = list(pattern.finditer(text))
    if len(found) != len(re.findall(begin, text)):
        raise DataFileError(f"{path}: a registration is not of the form {pattern.pattern}")
    return found


def _parameter(match: re.Match[str], declared: dict[str, tuple[str, str]]) -> Parameter:
    found = match.groupdict()
    name, group = match["name"], found.get("group") or OWN_GROUPS.get(match["name"], "membrane")
    if match[0].startswith("ADD_PROPERTY"):
        return Parameter(name, group, "property", "0")
    member = (match["member"] + (found.get("further") or "")).removesuffix(".value")
    if member not in declared:
        raise DataFileError(f"{DECLARATION}: '{member}', which is registered as '{name}', is not declared there")
    kind, value = declared[member]
    choices = _CHOICES.search(match["rest"])
    names = tuple(choices.group(1).strip("\\0").split("\\0")) if choices else ()
    return Parameter(name, group, kind, _shown(kind, value, names), names)


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
    parameters, titles = registered(), headings()
    names = {parameter.name for parameter in parameters}
    odd = names ^ set(NOTES) | set(titles) ^ set(ABOUT)
    if odd:
        raise DataFileError(
            f"studies/pages/parameter_notes.py and {DECLARATION.name} do not agree on {', '.join(sorted(odd))}"
        )
    sections = [
        f"## {title}\n\n{ABOUT[group]}\n\n{_table([each for each in parameters if each.group == group])}"
        for group, title in titles.items()
    ]
    return "\n\n".join([_INTRODUCTION, *sections]) + "\n"


_INTRODUCTION = """\
# Parameters

<!-- Written by `scripts/mixcontact pages` from the code that registers them and studies/pages/parameter_notes.py. -->

These are the parameters of `<contact type="sliding-mixture">`. Units are those of the models here: mm, N, s, nmol,
hence MPa and mM; FEBio has none, and any consistent set works. A parameter that is not on this page is an error, and a
value without meaning is as well; the message names the parameter. "Same" means the same name, meaning and default as
in those of FEBio's interfaces (`sliding-elastic`, `sliding-biphasic`, `sliding-biphasic-solute`, `sliding-multiphasic`)
that have it.

The [how-to](../how-to/parameters.md#which-parameter-first) says which one to change first."""


def _table(parameters: list[Parameter]) -> str:
    lines = [
        "| parameter | unit | default | meaning and effect | cost | in FEBio's interfaces |",
        "|---|---|---|---|---|---|",
    ]
    return "\n".join([*lines, *(_row(parameter, NOTES[parameter.name]) for parameter in parameters)])


def _row(parameter: Parameter, note: Note) -> str:
    unit = note.unit or ("0, 1" if parameter.kind == "bool" else "-")
    default = "automatic" if parameter.name in AUTOMATIC else note.default or parameter.default
    return f"| `{parameter.name}` | {unit} | {default} | {note.effect} | {note.cost} | {note.febio} |"
