"""The page of the contact's parameters: docs/reference/parameters.md.

Names, order, headings, kinds, choices and defaults are those of `harness.preflight.plugin_types`. What code does not
say comes from `studies.pages.parameter_notes`.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence

from harness.errors import DataFileError
from harness.preflight.contact_types import MIXTURE
from harness.preflight.plugin_types import FILE, PLUGIN_TYPES, Parameter
from harness.run import standalone
from studies.pages.parameter_notes import ABOUT, AUTOMATIC, NOTES, OLD_MODELS, Note

PAGE = "reference/parameters.md"


def printed() -> str:
    """The types and parameters as the embedded engine prints them.

    Raises
    ------
    EngineNotFoundError
        Where the engine is not built.
    """
    command = [str(standalone.find()), "--contact-types"]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def page(parameters: Sequence[Parameter] = PLUGIN_TYPES[MIXTURE]) -> str:
    """The text of the page.

    Raises
    ------
    DataFileError
        Where the notes and the code do not name the same parameters, or the same headings.
    """
    titles = list(dict.fromkeys(_title(parameter) for parameter in parameters))
    odd = {parameter.name for parameter in parameters} ^ set(NOTES) | set(titles) ^ set(ABOUT)
    if odd:
        raise DataFileError(
            f"studies/pages/parameter_notes.py and {FILE.name} do not agree on {', '.join(sorted(odd))}"
        )
    sections = [
        f"## {title}\n\n{ABOUT[title]}\n\n{_table([each for each in parameters if _title(each) == title])}"
        for title in titles
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


def _title(parameter: Parameter) -> str:
    return parameter.group or OLD_MODELS


def _table(parameters: Sequence[Parameter]) -> str:
    lines = [
        "| parameter | unit | default | meaning and effect | cost | in FEBio's interfaces |",
        "|---|---|---|---|---|---|",
    ]
    return "\n".join([*lines, *(_row(parameter, NOTES[parameter.name]) for parameter in parameters)])


def _row(parameter: Parameter, note: Note) -> str:
    unit = note.unit or ("0, 1" if parameter.kind == "switch" else "-")
    default = "automatic" if parameter.name in AUTOMATIC else note.default or _default(parameter)
    return f"| `{parameter.name}` | {unit} | {default} | {note.effect} | {note.cost} | {note.febio} |"


def _default(parameter: Parameter) -> str:
    if parameter.choices:
        return f"`{parameter.choices[int(parameter.default)]}`"
    return f"`{parameter.default}`" if parameter.kind == "word" else parameter.default
