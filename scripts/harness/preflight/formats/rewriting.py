"""Changes to the tags of a model that was read, which keep line and tag of its file for messages."""

from collections.abc import Iterable

from lxml import etree

from harness.preflight.xml_file import WRITTEN_AS, Document, Element, children, place


def rename(tag: Element, name: str, /, **attributes: str) -> Element:
    """Gives a tag another name, and attributes."""
    _remember(tag, tag)
    tag.tag = name
    for key, value in attributes.items():
        tag.set(key, value)
    return tag


def add(parent: Element, tag: str, origin: Element, text: str | None = None, /, **attributes: str) -> Element:
    """A new tag in `parent`, made from another one of the file."""
    made = etree.SubElement(parent, tag, attributes)
    made.text = text
    _remember(made, origin)
    return made


def _remember(tag: Element, origin: Element) -> None:
    where = place(origin)
    tag.set(WRITTEN_AS, f"{where.line} {where.tag}")


def set_text(tag: Element, text: str) -> None:
    """Replaces all that stands in a tag."""
    tag[:] = []
    tag.text = text


def enclose(parent: Element, name: str, tags: Iterable[Element]) -> None:
    """Puts children of a tag into a new child."""
    inner = list(tags)
    add(parent, name, parent).extend(inner)


def material_names(document: Document) -> dict[str, str]:
    """Names of the materials by their numbers; one without a name has FEBio's."""
    found = {}
    for tag in document.all("Material", "material"):
        number = str(tag.get("id"))
        if not tag.get("name"):
            tag.set("name", f"Material{number}")
        found[number] = str(tag.get("name"))
    return found


def upper_case(document: Document) -> None:
    """Kinds of analysis as 4.0 writes them."""
    for control in document.each("Control"):
        for tag in children(control, "analysis"):
            set_text(tag, (tag.get("type") or tag.text or "").strip().upper())


OLD_NAMES = {"facet-to-facet sliding": "sliding-facet-on-facet", "sliding_with_gaps": "sliding-node-on-facet"}
"""What they are called in format 4.0."""


def rename_contacts(document: Document) -> None:
    """Contact types by the names of format 4.0."""
    for section in document.each("Contact"):
        for tag in children(section, "contact"):
            kind = str(tag.get("type"))
            if kind in OLD_NAMES:
                rename(tag, "contact", type=OLD_NAMES[kind])
