"""Looks into a .feb file that somebody wants to run, and says clearly what is wrong with it."""

from dataclasses import dataclass
from pathlib import Path

from harness.errors import ModelError
from harness.preflight.formats import read_newest
from harness.preflight.xml_file import Element, number, place


@dataclass(frozen=True)
class FebFile:
    """What the harness needs to know of a model file."""

    path: Path
    module: str  # FEBio's module
    contacts: tuple[str, ...]  # types of the contact interfaces
    end: float  # time at which the last analysis step ends, s; 0 where the file does not say


def inspect(path: Path) -> FebFile:
    """Read a model file and what it includes.

    Raises ModelError: no such file, no XML, no FEBio model, or a contact without a type or with a surface pair that
    does not exist; names the file, the line, the tag and what is allowed.
    """
    if path.suffix != ".feb":
        raise ModelError(f"{path}: a model file ends in .feb")
    document = read_newest(path)
    pairs = [pair.get("name", "") for pair in document.all("Mesh", "SurfacePair")]
    contacts = [contact for _, contact in document.everywhere("Contact", "contact")]
    for contact in contacts:
        _check_contact(contact, pairs)
    module = next(document.all("Module"), None)
    if module is None or not module.get("type"):
        raise ModelError(f'{path}: <febio_spec> has no <Module type="...">, which FEBio needs first')
    end = sum(_number(each, "time_steps") * _number(each, "step_size") for each in document.each("Control"))
    return FebFile(path, str(module.get("type")), tuple(str(c.get("type")) for c in contacts), end)


def _check_contact(contact: Element, pairs: list[str]) -> None:
    if not contact.get("type"):
        raise ModelError(f"{place(contact)} has no type; for this plugin it is type='sliding-mixture'")
    pair = contact.get("surface_pair")
    if pair not in pairs and contact.get("surface") is None:  # which a rigid wall has
        known = ", ".join(pairs) or "none: add a <SurfacePair> to <Mesh>"
        raise ModelError(f"{place(contact)} has surface_pair='{pair}', which does not exist; there is {known}")


def _number(control: Element, tag: str) -> float:
    found = control.find(tag)
    return 0.0 if found is None else number(found)
