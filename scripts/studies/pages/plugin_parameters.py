"""The page of the contact's parameters: docs/reference/parameters.md.

Names, order, headings, kinds, choices and defaults are those of `harness.preflight.plugin_types`. What code does not
say comes from texts/parameter_notes.json.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass

from harness.errors import DataFileError
from harness.preflight.contact_types import MIXTURE
from harness.preflight.plugin_types import FILE, PLUGIN_TYPES, Parameter
from studies import tables
from studies.pages.texts import FOLDER, page_text

PAGE = "reference/parameters.md"
AUTOMATIC = {"penalty", "pressure_penalty", "concentration_penalty", "search_radius"}
"""Parameters that are chosen by the contact where the model does not give them."""
OLD_MODELS = "Accepted for the sake of old models"  # the heading of parameters that FEBio Studio does not offer


@dataclass(frozen=True)
class Note:
    """Of one parameter."""

    effect: str  # what it means and does
    cost: str = "none"  # what it costs, in time or robustness
    febio: str = "same"  # what it is in FEBio's own interfaces
    unit: str = ""  # empty: 0 or 1 for truth values, else none
    default: str = ""  # empty: that of the code


_SAID = json.loads((FOLDER / "parameter_notes.json").read_text(encoding="utf-8"))
ABOUT: dict[str, str] = _SAID["groups"]  # a sentence on each group of parameters, by its heading
NOTES = {name: Note(**note) for name, note in _SAID["notes"].items()}  # by the names of the parameters


def page(parameters: Sequence[Parameter] = PLUGIN_TYPES[MIXTURE]) -> str:
    """The text of the page.

    Raises DataFileError where the notes and the code do not name the same parameters, or the same headings.
    """
    titles = list(dict.fromkeys(_title(parameter) for parameter in parameters))
    odd = {parameter.name for parameter in parameters} ^ set(NOTES) | set(titles) ^ set(ABOUT)
    if odd:
        raise DataFileError(
            f"studies/pages/texts/parameter_notes.json and {FILE.name} do not agree on {', '.join(sorted(odd))}"
        )
    sections = [
        f"## {title}\n\n{ABOUT[title]}\n\n{_table([each for each in parameters if _title(each) == title])}"
        for title in titles
    ]
    return "\n\n".join([_INTRODUCTION, *sections]) + "\n"


_INTRODUCTION = page_text("parameters").rstrip()


def _title(parameter: Parameter) -> str:
    return parameter.group or OLD_MODELS


def _table(parameters: Sequence[Parameter]) -> str:
    heads = ("parameter", "unit", "default", "meaning", "drawback", "in FEBio's interfaces")
    return tables.markdown(heads, (_row(parameter, NOTES[parameter.name]) for parameter in parameters))


def _row(parameter: Parameter, note: Note) -> tuple[str, ...]:
    unit = note.unit or ("0, 1" if parameter.kind == "switch" else "-")
    default = "automatic" if parameter.name in AUTOMATIC else note.default or _default(parameter)
    return f"`{parameter.name}`", unit, default, note.effect, note.cost, note.febio


def _default(parameter: Parameter) -> str:
    if parameter.choices:
        return f"`{parameter.choices[int(parameter.default)]}`"
    return f"`{parameter.default}`" if parameter.kind == "word" else parameter.default
