"""Boundary and initial conditions that name unknowns, as conditions of one field each."""

import re
from collections.abc import Iterator

from harness.errors import ModelError
from harness.preflight.formats.rewriting import add, rename
from harness.preflight.xml_file import Element, place, shortened

_FIELDS = {
    **dict.fromkeys(("x", "y", "z"), "displacement"),
    **dict.fromkeys(("u", "v", "w"), "rotation"),
    **dict.fromkeys(("sx", "sy", "sz"), "shell displacement"),
    "p": "fluid pressure",
    "q": "shell fluid pressure",
    "T": "temperature",
}
_CONCENTRATION = re.compile(r"c\d+")
_NAME = re.compile(r"[A-Za-z]\w{0,79}", re.ASCII)


def field(unknown: str) -> str:
    """What the types of format 4.0 call the field of an unknown; fields that contacts do not touch are a fluid's."""
    return "concentration" if _CONCENTRATION.fullmatch(unknown) else _FIELDS.get(unknown, f"fluid {unknown}")


def fixed(section: Element, tag: Element, unknowns: list[str]) -> Iterator[Element]:
    """A condition of zero for each field of a list of unknowns."""
    for kind in dict.fromkeys(field(unknown) for unknown in unknowns):
        own = [unknown for unknown in unknowns if field(unknown) == kind]
        made = add(section, "bc", tag, None, type=f"zero {kind}", node_set=str(tag.get("node_set") or ""))
        if kind == "concentration":
            add(made, "c_dof", tag, ",".join(own))
        else:
            for unknown in own:
                add(made, f"{unknown}_dof", tag, "1")
        yield made


def prescribed(tag: Element, unknown: str) -> Element:
    """A condition with a value: its <scale>, or the <value> that takes its place."""
    rename(tag, "bc", type=f"prescribed {field(unknown)}")
    scale, value = tag.find("scale"), tag.find("value")
    if scale is not None and value is not None:
        scale.text = value.text
        tag.remove(value)
    if scale is not None:
        rename(scale, "value")
    return _of(tag, unknown)


def initial(tag: Element, unknown: str) -> Element:
    """An initial condition."""
    return _of(rename(tag, "ic", type=f"initial {field(unknown)}"), unknown)


def _of(tag: Element, unknown: str) -> Element:
    if tag.find("dof") is None:
        add(tag, "dof", tag, unknown)
    return tag


def names(tag: Element, listed: str) -> list[str]:
    """Unknowns in a list that a tag has. Raises ModelError where one of them is no name."""
    found = [name.strip() for name in listed.split(",") if name.strip()]
    wrong = next((name for name in found if not _NAME.fullmatch(name)), None)
    if wrong is not None:
        raise ModelError(
            f"{place(tag)}: names the unknown '{shortened(wrong)}'; there is {', '.join(_FIELDS)}, c1, c2 ..."
        )
    return found
