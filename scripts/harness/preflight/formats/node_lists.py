"""Sets of nodes and of elements that have a tag for each member, or name other sets."""

from __future__ import annotations

from collections.abc import Mapping

from harness.preflight.formats.rewriting import set_text
from harness.preflight.xml_file import Document, Element, attribute, children, text, unknown_name


def list_members(document: Document) -> None:
    """Members as a list of numbers."""
    known = {str(tag.get("name")): _numbers(tag) for tag in document.all("Mesh", "Nodes") if tag.get("name")}
    for tag in document.all("Mesh", "NodeSet"):
        set_text(tag, _members(tag, known))
        known[attribute(tag, "name")] = text(tag)
    for tag in document.all("Mesh", "ElementSet"):
        set_text(tag, _members(tag, {}))


def _numbers(tag: Element) -> str:
    return ",".join(attribute(child, "id") for child in children(tag))


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
