"""Format 2.5, of FEBio 2."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from harness.errors import ModelError
from harness.preflight.formats import conditions
from harness.preflight.formats.geometry import list_members, mesh_of_geometry
from harness.preflight.formats.rewriting import add, enclose, material_names, rename, rename_contacts, upper_case
from harness.preflight.xml_file import Document, Element, attribute, children, place, shortened

_OF_STEP = ("analysis", "time_steps", "step_size", "time_stepper")
_RIGID = {"x": "Rx", "y": "Ry", "z": "Rz", "Rx": "Ru", "Ry": "Rv", "Rz": "Rw"}
"""Unknowns of a rigid body as format 4.0 calls them."""


def rewritten(document: Document) -> Document:
    """A document of format 2.5 in the form of 4.0."""
    names = material_names(document)
    document = mesh_of_geometry(document, names)
    list_members(document)
    for step in document.all("Step"):
        enclose(step, "step", children(step))
    rigid = [_rigid_bodies(section, names) for section in document.all("Boundary")]
    for section in document.all("Step", "step", "Boundary"):
        _rigid_bodies(section, names)
    for section in document.each("Boundary"):
        section[:] = [made for tag in [*children(section)] for made in _boundary(section, tag)]
    for section in document.each("Initial"):
        for tag in children(section, "init"):
            conditions.initial(tag, attribute(tag, "bc"))
    upper_case(document)
    for section in document.each("Control"):
        enclose(section, "solver", (tag for tag in children(section) if tag.tag not in _OF_STEP))
    for curve in document.all("LoadData", "loadcurve"):
        enclose(rename(curve, "load_controller"), "points", children(curve))
    rename_contacts(document)
    return replace(document, sections=(*document.sections, *rigid))


def _rigid_bodies(section: Element, names: Mapping[str, str]) -> Element:
    """Takes the conditions of rigid bodies out of a section of boundary conditions into one of their own."""
    parent = section.getparent()
    assert parent is not None  # <febio_spec> or <step>
    rigid = add(parent, "Rigid", section)
    for body in [*children(section, "rigid_body")]:
        for tag in children(body):
            _rigid(rigid, tag, names.get(attribute(body, "mat"), attribute(body, "mat")))
        section.remove(body)
    return rigid


def _boundary(section: Element, tag: Element) -> Iterator[Element]:
    if tag.tag == "fix":
        yield from conditions.fixed(section, tag, conditions.names(tag, attribute(tag, "bc")))
    elif tag.tag == "prescribe":
        yield conditions.prescribed(tag, attribute(tag, "bc"))
    elif tag.tag == "rigid":
        yield rename(tag, "bc", type="rigid")
    else:
        yield tag


def _rigid(section: Element, tag: Element, body: str) -> None:
    if tag.tag not in ("fixed", "prescribed"):
        return
    unknown = attribute(tag, "bc")
    if unknown not in _RIGID:
        raise ModelError(f"{place(tag)}: is of the unknown '{shortened(unknown)}'; there is {', '.join(_RIGID)}")
    dof = _RIGID[unknown]
    made = add(section, "rigid_bc", tag, type="rigid_fixed" if tag.tag == "fixed" else "rigid_displacement")
    add(made, "rb", tag, body)
    if tag.tag == "fixed":
        add(made, f"{dof}_dof", tag, "1")
    else:
        add(made, "dof", tag, dof)
