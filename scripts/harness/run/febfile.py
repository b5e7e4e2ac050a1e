"""Looks into a .feb file that somebody wants to run, and says clearly what is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from lxml import etree

from harness.errors import ModelError

VERSION = "4.0"
Element = etree._Element


@dataclass(frozen=True)
class FebFile:
    """What the harness needs to know of a model file.

    Attributes
    ----------
    path : Path
    module : str
        FEBio's module.
    contacts : tuple of str
        Types of the contact interfaces.
    end : float
        Time at which the last analysis step ends, s; 0 where the file does not say.
    """

    path: Path
    module: str
    contacts: tuple[str, ...]
    end: float


def inspect(path: Path) -> FebFile:
    """Read a model file.

    Raises
    ------
    ModelError
        No such file, no XML, no FEBio 4 model, or a contact without a type or with a surface pair that does not exist;
        names the file, the line, the tag and what is allowed.
    """
    root = _root(path)
    pairs = [pair.get("name", "") for pair in root.iterfind("Mesh/SurfacePair")]
    contacts = list(root.iter("contact"))
    for contact in contacts:
        _check_contact(path, contact, pairs)
    module = root.find("Module")
    if module is None or not module.get("type"):
        raise ModelError(f'{path}: <febio_spec> has no <Module type="...">, which FEBio needs first')
    return FebFile(path, str(module.get("type")), tuple(str(c.get("type")) for c in contacts), _end(path, root))


def _root(path: Path) -> Element:
    if path.suffix != ".feb":
        raise ModelError(f"{path}: a model file ends in .feb")
    try:
        root = etree.parse(str(path), etree.XMLParser(resolve_entities=False)).getroot()
    except OSError as error:
        raise ModelError(f"{path}: cannot be read ({error})") from error
    except etree.XMLSyntaxError as error:
        raise ModelError(f"{path}: is not XML: {error.msg}") from error
    if root.tag != "febio_spec":
        raise ModelError(f"{path}, line {root.sourceline}: the root is <{root.tag}>; a model has <febio_spec>")
    if root.get("version") != VERSION:
        raise ModelError(
            f"{path}, line {root.sourceline}: <febio_spec version='{root.get('version')}'>; "
            f"the plugin is for version {VERSION}"
        )
    return root


def _check_contact(path: Path, contact: Element, pairs: list[str]) -> None:
    where = f"{path}, line {contact.sourceline}: <contact>"
    if not contact.get("type"):
        raise ModelError(f"{where} has no type; for this plugin it is type='sliding-mixture'")
    pair = contact.get("surface_pair")
    if pair not in pairs:
        known = ", ".join(pairs) or "none: add a <SurfacePair> to <Mesh>"
        raise ModelError(f"{where} has surface_pair='{pair}', which does not exist; there is {known}")


def _end(path: Path, root: Element) -> float:
    end = 0.0
    for control in root.iter("Control"):
        end += _number(path, control, "time_steps") * _number(path, control, "step_size")
    return end


def _number(path: Path, control: Element, tag: str) -> float:
    found = control.find(tag)
    if found is None:
        return 0.0
    try:
        return float(found.text or "")
    except ValueError as error:
        raise ModelError(f"{path}, line {found.sourceline}: <{tag}> is '{found.text}'; a number is needed") from error
