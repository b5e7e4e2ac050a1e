"""Names of contact types that FEBio reads in older formats alone."""

from __future__ import annotations

from harness.preflight.formats.rewriting import rename
from harness.preflight.xml_file import Document, children

OLD_NAMES = {
    "facet-to-facet sliding": "sliding-facet-on-facet",
    "sliding_with_gaps": "sliding-node-on-facet",
}
"""What they are called in format 4.0."""


def rename_contacts(document: Document) -> None:
    """Contact types by the names of format 4.0."""
    for section in document.each("Contact"):
        for tag in children(section, "contact"):
            kind = str(tag.get("type"))
            if kind in OLD_NAMES:
                rename(tag, "contact", type=OLD_NAMES[kind])
