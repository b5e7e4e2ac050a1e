"""The plugin's contact types and their parameters, as the plugin's own code says them: plugin_types.json.

`mixture-contact --contact-types` prints that file.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

FILE = Path(__file__).with_name("plugin_types.json")


@dataclass(frozen=True)
class Parameter:
    """A parameter of one of the plugin's contact types."""

    # In a model file, and in FEBio Studio.
    name: str
    long_name: str
    group: str | None  # its heading in FEBio Studio; none for what FEBio Studio does not offer
    unit: str  # `length`, `pressure`, `concentration`, or empty
    kind: str  # `switch`, `integer`, `number`, `word` or `values per solute`
    default: str  # as it would stand in a model file
    choices: tuple[str, ...]  # names of the values 0, 1 and so on, if they have names
    curve: bool  # whether a load curve may change it


def read(text: str) -> Mapping[str, tuple[Parameter, ...]]:
    """The types that a text of this kind has, with their parameters."""
    return {
        name: tuple(Parameter(**{**each, "choices": tuple(each["choices"])}) for each in parameters)
        for name, parameters in json.loads(text).items()
    }


PLUGIN_TYPES = read(FILE.read_text(encoding="utf-8"))
"""Parameters of each of the plugin's types, in the order of the documentation."""
