"""A model file as XML, and the few things in it that studies change."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from lxml import etree

from harness.errors import ModelError
from harness.models.document import Model
from harness.preflight import xml_file

Element = etree._Element
NODE_FILE = "robustness-nodes.txt"  # into which all runs that are compared write


@dataclass(frozen=True)
class Feb:
    """A model file; each change gives another one."""

    name: str
    root: Element

    @property
    def module(self) -> str:
        """FEBio's module."""
        module = self.root.find("Module")
        return "" if module is None else str(module.get("type"))

    @property
    def columns(self) -> tuple[str, ...]:
        """The node data that are compared."""
        solutes = tuple(f"c{n}" for n in range(1, 1 + len(self.root.findall("Globals/Solutes/solute"))))
        pressure = () if self.module == "solid" else ("p",)
        return ("ux", "uy", "uz", *pressure, *solutes)

    @property
    def controls(self) -> list[Element]:
        """The control section of each analysis step."""
        return list(self.root.iter("Control"))

    @property
    def contacts(self) -> list[Element]:
        """The contacts of all analysis steps."""
        return list(self.root.iter("contact"))

    @property
    def has_own_stepper(self) -> bool:
        """Whether its time steps adapt themselves."""
        return any(control.find("time_stepper") is not None for control in self.controls)

    def copy(self) -> Feb:
        """One that may be changed."""
        return Feb(self.name, copy.deepcopy(self.root))

    def changed(self, tag: str, change: Callable[[Element], object]) -> Feb:
        """The same model with a change of each element of this tag, such as ``Control`` or ``contact``."""
        made = self.copy()
        for element in list(made.root.iter(tag)):
            change(element)
        return made

    def write(self, folder: Path) -> Path:
        """Write it into an empty folder."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{self.name}.feb"
        etree.ElementTree(self.root).write(str(path), xml_declaration=True, encoding="ISO-8859-1")
        return path


def read(path: Path) -> Feb:
    """Read a model file. Raises ModelError where it is missing or no XML, or no model with a <Control> section."""
    root = xml_file.root_of(path, xml_file.content(path))
    if next(root.iter("Control"), None) is None:
        raise ModelError(f"{path}: no model with a <Control> section")
    return Feb(path.stem, root)


def made(model: Model) -> Feb:
    """The file of a model."""
    return parsed(model.name, model.text())


def parsed(name: str, text: str) -> Feb:
    """The file of the text of a model."""
    return Feb(name, etree.fromstring(text.encode("iso-8859-1")))


def put(parent: Element, tag: str, text: object, **attributes: str) -> Element:
    """Set the child `tag`, which is made where there is none."""
    found = parent.find(tag)
    made = etree.SubElement(parent, tag) if found is None else found
    made.text = str(text)
    made.attrib.clear()
    for name, value in attributes.items():
        made.set(name, value)
    return made


def number(parent: Element, tag: str, default: float) -> float:
    """The number that stands in the child `tag`."""
    text = parent.findtext(tag)
    return default if text is None else float(text)


def only(parent: Element, tag: str) -> Element:
    """The child `tag`, or the element at a path from `parent`. Raises ModelError where there is none."""
    found = parent.find(tag)
    if found is None:
        raise ModelError(f"line {parent.sourceline}: <{parent.tag}> without <{tag}>")
    return found


def add_curve(feb: Feb, points: Sequence[tuple[float, float]], interpolate: str = "LINEAR") -> str:
    """Append a load curve, and return its number."""
    section = feb.root.find("LoadData")
    if section is None:
        section = etree.SubElement(feb.root, "LoadData")
        output = feb.root.find("Output")
        if output is not None:
            output.addprevious(section)
    taken = [int(each.get("id", "0")) for each in section.findall("load_controller")]
    made = etree.SubElement(section, "load_controller", id=str(max(taken, default=0) + 1), type="loadcurve")
    put(made, "interpolate", interpolate)
    put(made, "extend", "CONSTANT")
    listed = etree.SubElement(made, "points")
    for time, value in points:
        etree.SubElement(listed, "pt").text = f"{time:.17g},{value:.17g}"
    return str(made.get("id"))
