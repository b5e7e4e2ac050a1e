"""A mesh of parts and their instances as one mesh."""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from harness.arrays import Array
from harness.errors import ModelError
from harness.preflight import xml_file
from harness.preflight.formats.rewriting import set_text
from harness.preflight.xml_file import (
    Element,
    attribute,
    children,
    floats,
    identifier,
    integers,
    place,
    shortened,
    text,
    unknown_name,
)

Move = Callable[[Array], Array]


def _of_quaternion(four: Array) -> Array:
    """As FEBio turns a vector v: q v q*, which scales where q is no unit, and not at all where its last number is 0."""
    return np.asarray(four @ four * Rotation.from_quat(four).as_matrix()) if four[3] else np.eye(3)


_ROTATIONS: Mapping[str, tuple[int, Callable[[Array], Array]]] = {
    "quaternion": (4, _of_quaternion),
    "vector": (3, lambda vector: np.asarray(Rotation.from_rotvec(vector, degrees=True).as_matrix())),
    "Euler": (3, lambda angles: np.asarray(Rotation.from_euler("xyz", angles, degrees=True).as_matrix())),
}
"""How many numbers each form of a rotation has, and its matrix."""


@dataclass
class _Mesh:
    """What there is so far: parts, sections of the mesh, and the largest numbers of nodes and elements."""

    model: Path
    section: Element
    parts: dict[str, Element] = field(default_factory=dict)
    surfaces: dict[str, Element] = field(default_factory=dict)
    nodes: int = 0
    elements: int = 0


@dataclass(frozen=True)
class _Place:
    """Where an instance lies, and how many nodes and elements have their numbers before it."""

    move: Move
    nodes: int
    elements: int


def one_mesh(model: Path, section: Element) -> None:
    """Puts the nodes, elements and sets of each instance in the place of the instance.

    Raises ModelError: a part, surface or rotation that does not exist; numbers that are none.
    """
    tags = [*children(section)]
    if not any(tag.tag in ("Part", "Instance") for tag in tags):
        return
    mesh = _Mesh(model, section)
    section[:] = []
    for tag in tags:
        section.append(tag)
        if tag.tag == "Part":
            _part(mesh, tag)
        elif tag.tag == "Instance":
            _build(mesh, _named(mesh.parts, "part", tag, attribute(tag, "part")), tag)
        elif tag.tag == "Surface":
            _join(mesh, tag)
        if tag.tag in ("Part", "Instance"):
            section.remove(tag)


def _named(known: Mapping[str, Element], what: str, tag: Element, name: str) -> Element:
    if name not in known:
        raise unknown_name(tag, what, name, known)
    return known[name]


def _part(mesh: _Mesh, tag: Element) -> None:
    name = attribute(tag, "name")
    mesh.parts[name] = _part_from(mesh.model, tag) if tag.get("from") else tag
    if tag.get("type") == "instance":
        _build(mesh, mesh.parts[name], tag)


def _part_from(model: Path, tag: Element) -> Element:
    source = xml_file.included(model, place(tag), str(tag.get("from")))
    parts = xml_file.parse(source).iterfind("Geometry/Part")
    found = next((part for part in parts if part.get("name") == tag.get("name")), None)
    if found is None:
        raise ModelError(f"{place(tag)}: refers to {source}, which has no such <Part> in <Geometry>")
    return found


def _build(mesh: _Mesh, part: Element, instance: Element) -> None:
    """Copies of all that a part has, with numbers behind those that there are."""
    own = _Place(_move(instance), mesh.nodes, mesh.elements)
    materials = {tag.get("name"): tag.get("mat") for tag in instance}
    for tag in children(part):
        made = deepcopy(tag)
        if tag.tag == "Elements" and materials.get(tag.get("name")):
            made.set("mat", str(materials[tag.get("name")]))
        if tag.get("name"):
            made.set("name", f"{instance.get('name') or instance.get('part')}.{tag.get('name')}")
        mesh.section.append(made)
        if tag.tag == "Surface":
            mesh.surfaces[str(made.get("name"))] = made
        for member in children(made):
            _place_member(mesh, str(tag.tag), member, own)


def _place_member(mesh: _Mesh, kind: str, member: Element, own: _Place) -> None:
    """Moves a node; gives nodes, elements and what is made of them numbers of the whole mesh."""
    if kind == "Nodes":
        set_text(member, ",".join(repr(float(x)) for x in own.move(floats(member, 3))))
    elif kind in ("Elements", "Surface"):
        set_text(member, ",".join(str(node + own.nodes) for node in integers(member)))
    if kind in ("Nodes", "NodeSet"):
        member.set("id", str(identifier(member) + own.nodes))
        mesh.nodes = max(mesh.nodes, identifier(member))
    elif kind in ("Elements", "ElementSet"):
        member.set("id", str(identifier(member) + own.elements))
        mesh.elements = max(mesh.elements, identifier(member))


def _join(mesh: _Mesh, surface: Element) -> None:
    facets = [
        deepcopy(facet)
        for tag in children(surface)
        for facet in children(_named(mesh.surfaces, "surface", tag, tag.get("surface") or text(tag)))
    ]
    surface[:] = facets
    mesh.surfaces[attribute(surface, "name")] = surface


def _move(instance: Element) -> Move:
    parts = (children(tag) if tag.tag == "transform" else (tag,) for tag in children(instance))  # format 3.0 has one
    found = {str(tag.tag): tag for part in parts for tag in part}
    scale = floats(found["scale"], 3) if "scale" in found else np.ones(3)
    shift = floats(found["translate"], 3) if "translate" in found else np.zeros(3)
    turn = _rotation(found["rotate"]) if "rotate" in found else np.eye(3)
    return lambda point: np.asarray(turn @ (scale * point) + shift)


def _rotation(tag: Element) -> Array:
    kind = str(tag.get("type") or "quaternion")
    if kind not in _ROTATIONS:
        raise ModelError(f"{place(tag)}: is of type '{shortened(kind)}'; there is {', '.join(_ROTATIONS)}")
    size, matrix = _ROTATIONS[kind]
    return matrix(floats(tag, size))
