"""The section <Geometry>, which has the materials of the elements beside them, and its sets, which list members."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from harness.preflight.formats.instances import one_mesh
from harness.preflight.formats.rewriting import add, rename, set_text
from harness.preflight.xml_file import Document, Element, attribute, children, text, unknown_name

_SIDES = {"master": "secondary", "slave": "primary"}
_OF_OTHER_USE = ("NodeSetPair", "NodeSetSet")  # what 4.0 does not have, and no contact uses


def mesh_of_geometry(document: Document, materials: Mapping[str, str]) -> Document:
    """<Geometry> as <Mesh> and <MeshDomains>; `materials` are names by numbers."""
    for section in document.all("Geometry"):
        one_mesh(document.path, section)
    domains = [_domains(section, materials) for section in document.all("Geometry")]
    for section in [*document.all("Geometry")]:
        _mesh(section)
    return replace(document, sections=(*document.sections, *domains))


def _domains(section: Element, materials: Mapping[str, str]) -> Element:
    root = section.getparent()
    assert root is not None  # a section stands in <febio_spec>
    made = add(root, "MeshDomains", section)
    for tag, name in _named([*children(section, "Elements")]):
        tag.set("name", name)
        material = attribute(tag, "mat")
        by_name = material in materials.values()
        add(made, "SolidDomain", tag, name=name, mat=material if by_name else materials.get(material, material))
    return made


def _named(blocks: list[Element]) -> Iterator[tuple[Element, str]]:
    """Blocks of elements with a name of their own each."""
    taken = {""}
    for number, tag in enumerate(blocks, 1):
        name = str(tag.get("name") or "")
        yield tag, (f"{name or 'part'} {number}" if name in taken else name)
        taken.add(name)


def _mesh(section: Element) -> None:
    for tag in [*children(section)]:
        if tag.tag in _OF_OTHER_USE:
            section.remove(tag)
    for pair in children(section, "SurfacePair"):
        for tag in [*children(pair)]:
            if tag.tag in _SIDES:
                set_text(tag, attribute(tag, "surface"))
                rename(tag, _SIDES[str(tag.tag)])
    rename(section, "Mesh")


def list_members(document: Document) -> None:
    """Members as a list of numbers."""
    named = (tag for tag in document.all("Mesh", "Nodes") if tag.get("name"))
    known = {str(tag.get("name")): ",".join(attribute(child, "id") for child in children(tag)) for tag in named}
    for tag in document.all("Mesh", "NodeSet"):
        set_text(tag, _members(tag, known))
        known[attribute(tag, "name")] = text(tag)
    for tag in document.all("Mesh", "ElementSet"):
        set_text(tag, _members(tag, {}))


def _members(tag: Element, known: Mapping[str, str]) -> str:
    own = [_member(child, known) for child in children(tag)]
    return ",".join(own) if own else text(tag)


def _member(tag: Element, known: Mapping[str, str]) -> str:
    if tag.tag == "node_list":
        return text(tag)
    if tag.tag not in ("NodeSet", "node_set"):
        return attribute(tag, "id")
    name = tag.get("node_set") or text(tag)
    if name not in known:
        raise unknown_name(tag, "node set", name, known, "none before it")
    return known[name]
