"""Format 3.0, of FEBio 3."""

from collections.abc import Iterator, Mapping

from harness.preflight.formats import conditions
from harness.preflight.formats.geometry import list_members, mesh_of_geometry
from harness.preflight.formats.rewriting import add, material_names, rename, rename_contacts, upper_case
from harness.preflight.xml_file import Document, Element, children, text


def rewritten(document: Document) -> Document:
    """A document of format 3.0 in the form of 4.0."""
    names = material_names(document)
    document = mesh_of_geometry(document, names)
    list_members(document)
    for section in document.each("Boundary"):
        section[:] = [made for tag in [*children(section)] for made in _boundary(section, tag)]
    for section in document.each("Initial"):
        for tag in children(section, "ic"):
            if tag.get("type") == "init_dof":
                conditions.initial(tag, _unknown(tag, "dof"))
    for section in document.each("Rigid"):
        for tag in [*children(section, "rigid_constraint")]:
            _rigid(tag, names)
    upper_case(document)
    rename_contacts(document)
    return document


def _unknown(tag: Element, name: str) -> str:
    found = tag.find(name)
    return "" if found is None else text(found)


def _boundary(section: Element, tag: Element) -> Iterator[Element]:
    if tag.get("type") == "fix":
        yield from conditions.fixed(section, tag, conditions.names(tag, _unknown(tag, "dofs")))
    elif tag.get("type") == "prescribe":
        yield conditions.prescribed(tag, _unknown(tag, "dof"))
    else:
        yield tag


def _rigid(tag: Element, names: Mapping[str, str]) -> None:
    """A condition on a rigid body; forces on it hold nothing."""
    body = tag.find("rb")
    if body is not None:
        body.text = names.get(text(body), text(body))
    if "force" in str(tag.get("type")) or "moment" in str(tag.get("type")):
        rename(tag, "rigid_load")
        return
    rename(tag, "rigid_bc")
    if tag.get("type") == "fix":
        tag.set("type", "rigid_fixed")
        for dof in conditions.names(tag, _unknown(tag, "dofs")):
            add(tag, f"{dof}_dof", tag, "1")
    elif tag.get("type") == "prescribe":
        tag.set("type", "rigid_displacement")
