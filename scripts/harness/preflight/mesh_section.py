"""The mesh of a model file: nodes, blocks of elements, sets, surfaces and pairs, whatever the element types."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from harness.arrays import Array, Ids, Mask
from harness.errors import ModelError
from harness.preflight import elements
from harness.preflight.xml_file import (
    Document,
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

SECTIONS = ("Nodes", "Elements", "NodeSet", "Surface", "Edge", "ElementSet", "PartList", "SurfacePair", "DiscreteSet")
"""What <Mesh> may hold."""


@dataclass(frozen=True)
class Block:
    """Elements of one type and name."""

    name: str
    shape: elements.Shape
    nodes: Ids  # shape (n_elements, n_nodes): places of the nodes in the mesh's list, from 0
    ids: Ids  # shape (n_elements,): numbers of the elements in the file
    tag: Element

    @property
    def solid(self) -> bool:
        """Whether these are volume elements."""
        return bool(self.shape.faces)


@dataclass(frozen=True)
class Surface:
    """A named surface."""

    name: str
    corners: Ids  # shape (n_facets, 4): places of the corner nodes; a triangle repeats its last corner
    kinds: tuple[str, ...]  # FEBio's facet types
    tag: Element
    facet_tags: tuple[Element, ...]


@dataclass(frozen=True)
class Pair:
    """Primary and secondary surface of a contact."""

    name: str
    primary: Surface
    secondary: Surface
    tag: Element


@dataclass(frozen=True)
class Mesh:
    """All of it."""

    points: Array  # shape (n_nodes, 3)
    blocks: tuple[Block, ...]
    # What FEBio makes node sets from is here too, as ``@surface:name``, ``@edge:``, ``@elem_set:``, ``@part_list:``.
    node_sets: dict[str, Ids]
    surfaces: dict[str, Surface]
    pairs: dict[str, Pair]

    @cached_property
    def faces(self) -> Faces:
        """Faces of all volume elements."""
        return _faces(self)

    @cached_property
    def bodies(self) -> Ids:
        """Number of the body that each node belongs to: bodies are what elements connect. Shape (n_nodes,)."""
        ends = [
            (np.repeat(block.nodes[:, 0], block.nodes.shape[1]), block.nodes.ravel())
            for block in self.blocks
            if len(block.nodes)
        ]
        size = len(self.points)
        row, column = (np.concatenate([end[k] for end in ends]) if ends else np.empty(0, int) for k in range(2))
        graph = coo_array((np.ones(len(row), dtype=np.int8), (row, column)), shape=(size, size))
        return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


@dataclass(frozen=True)
class Faces:
    """Faces of volume elements."""

    corners: Ids  # shape (n_faces, 4): counter-clockwise seen from outside their element
    element: Ids  # shape (n_faces,): number of their element, counted through all volume blocks
    key: Ids  # shape (n_faces,): equal for faces of the same nodes
    volume: Array  # shape (n_elements,)
    block: Ids  # shape (n_elements,): place of each element's block among the mesh's blocks

    def outer(self, chosen: Mask) -> Ids:
        """Places of the faces that have a chosen element, shape (n_elements,), on one side alone."""
        own = np.flatnonzero(chosen[self.element])
        count = np.bincount(self.key[own], minlength=int(self.key.max(initial=0)) + 1)
        return np.asarray(own[count[self.key[own]] == 1], dtype=np.int64)

    def behind(self, corners: Ids) -> list[Ids]:
        """Places of the faces on each of the given facets, shape (n_facets, 4): none, one, or two of them."""
        keys = _keys(np.concatenate([self.corners, corners]))
        count = len(self.corners)
        order = np.argsort(keys[:count], kind="stable")
        low = np.searchsorted(keys[:count][order], keys[count:], side="left")
        high = np.searchsorted(keys[:count][order], keys[count:], side="right")
        return [order[a:b] for a, b in zip(low, high, strict=True)]


def _keys(corners: Ids) -> Ids:
    """One number for each set of corners."""
    if not len(corners):
        return np.empty(0, dtype=np.int64)
    ordered = np.sort(corners, axis=1)
    # A triangle repeats a corner; which one does not matter.
    double = ordered[:, 1:] == ordered[:, :-1]
    ordered[:, 1:][double] = -1
    _, keys = np.unique(np.sort(ordered, axis=1), axis=0, return_inverse=True)
    return np.asarray(keys, dtype=np.int64).ravel()


def _faces(mesh: Mesh) -> Faces:
    corners, volume = [np.empty((0, 4), dtype=np.int64)], [np.empty(0)]
    element, block = [np.empty(0, dtype=np.int64)], [np.empty(0, dtype=np.int64)]
    for number, own in enumerate(mesh.blocks):
        if not own.solid or not len(own.nodes):
            continue
        faces, count, first = own.nodes[:, own.shape.corner_faces], len(own.nodes), sum(map(len, volume))
        corners.append(faces.reshape(-1, 4))
        element.append(np.repeat(np.arange(first, first + count), faces.shape[1]))
        volume.append(elements.volumes(mesh.points[faces]))
        block.append(np.full(count, number))
    joined = np.concatenate(corners)
    return Faces(joined, np.concatenate(element), _keys(joined), np.concatenate(volume), np.concatenate(block))


# ---- reading ----


@dataclass(frozen=True)
class _Numbering:
    """Finds nodes by their numbers in the file."""

    ids: Ids

    def places(self, numbers: Iterable[int], tag: Element) -> Ids:
        """Places of nodes. Raises ModelError where a node does not exist."""
        wanted = np.array(list(numbers), dtype=np.int64)
        found = np.minimum(np.searchsorted(self.ids, wanted), len(self.ids) - 1)
        missing = wanted[self.ids[found] != wanted] if len(wanted) else wanted
        if len(missing):
            raise ModelError(f"{place(tag)}: names node {missing[0]}, which does not exist")
        return np.asarray(found, dtype=np.int64)


def read(document: Document) -> Mesh:
    """Read the mesh. Raises ModelError: what is missing, unknown or malformed; names file, line and tag."""
    _refuse_unknown(document)
    points, numbering, sets = _read_nodes(document)
    blocks = tuple(_read_block(tag, numbering) for tag in document.all("Mesh", "Elements"))
    if not blocks:
        raise ModelError(f"{document.path}: <Mesh> has no <Elements>")
    for tag in document.all("Mesh", "NodeSet"):
        sets[attribute(tag, "name")] = numbering.places(integers(tag), tag)
    surfaces = {attribute(tag, "name"): _read_surface(tag, numbering) for tag in document.all("Mesh", "Surface")}
    pairs = {attribute(tag, "name"): _read_pair(tag, surfaces) for tag in document.all("Mesh", "SurfacePair")}
    sets |= {f"@surface:{name}": np.unique(surface.corners) for name, surface in surfaces.items()}
    for tag in document.all("Mesh", "Edge"):
        nodes = [node for edge in children(tag) for node in integers(edge)]
        sets[f"@edge:{attribute(tag, 'name')}"] = np.unique(numbering.places(nodes, tag))
    sets |= _sets_of_elements(document, blocks)
    return Mesh(points, blocks, sets, surfaces, pairs)


def _refuse_unknown(document: Document) -> None:
    for section in document.all("Mesh"):
        for tag in children(section):
            if tag.tag not in SECTIONS:
                raise ModelError(
                    f"{place(tag)}: FEBio 4 reads no <{tag.tag}> in <Mesh>; there is {', '.join(SECTIONS)}"
                )


def _sets_of_elements(document: Document, blocks: tuple[Block, ...]) -> dict[str, Ids]:
    """Nodes of parts, of element sets, and of lists of parts."""
    parts = {block.name: np.unique(block.nodes) for block in blocks}
    found = {f"@elem_set:{name}": nodes for name, nodes in parts.items()}
    for tag in document.all("Mesh", "ElementSet"):
        chosen = integers(tag)
        rows = [block.nodes[np.isin(block.ids, chosen)].ravel() for block in blocks]
        found[f"@elem_set:{attribute(tag, 'name')}"] = np.unique(np.concatenate(rows))
    for tag in document.all("Mesh", "PartList"):
        names = [name.strip() for name in text(tag).split(",")]
        unknown = next((name for name in names if name not in parts), None)
        if unknown is not None:
            raise unknown_name(tag, "part", unknown, parts)
        found[f"@part_list:{attribute(tag, 'name')}"] = np.unique(np.concatenate([parts[name] for name in names]))
    return found


def _read_nodes(document: Document) -> tuple[Array, _Numbering, dict[str, Ids]]:
    ids: list[int] = []
    points: list[Array] = []
    sets: dict[str, Ids] = {}
    for section in document.all("Mesh", "Nodes"):
        first = len(ids)
        for node in children(section):
            ids.append(identifier(node))
            if len(ids) > 1 and ids[-1] <= ids[-2]:
                raise ModelError(f"{place(node)}: node numbers must increase, and {ids[-2]} comes before {ids[-1]}")
            points.append(floats(node, 3))
        if section.get("name"):
            sets[str(section.get("name"))] = np.arange(first, len(ids), dtype=np.int64)
    if not ids:
        raise ModelError(f"{document.path}: there is no <Mesh> with <Nodes>")
    return np.array(points), _Numbering(np.array(ids, dtype=np.int64)), sets


def _read_block(tag: Element, numbering: _Numbering) -> Block:
    kind = attribute(tag, "type")
    shape = elements.shape(kind)
    if shape is None:
        known = ", ".join(elements.SHAPES)
        raise ModelError(f"{place(tag)}: has elements of type '{shortened(kind)}', which is unknown; there is {known}")
    rows = [_element(element, shape.nodes, kind) for element in children(tag)]
    flat = numbering.places((node for row in rows for node in row), tag)
    ids = np.array([identifier(element) for element in children(tag)], dtype=np.int64)
    return Block(attribute(tag, "name"), shape, flat.reshape(len(rows), shape.nodes), ids, tag)


def _element(tag: Element, nodes: int, kind: str) -> list[int]:
    row = integers(tag)
    if len(row) != nodes:
        raise ModelError(f"{place(tag)}: has {len(row)} nodes; a {kind} has {nodes}")
    return row


def _read_surface(tag: Element, numbering: _Numbering) -> Surface:
    tags = tuple(children(tag))
    rows = []
    for facet in tags:
        count = elements.FACETS.get(str(facet.tag))
        if count is None:
            raise ModelError(f"{place(facet)}: is not a facet; there is {', '.join(elements.FACETS)}")
        nodes = _element(facet, count, str(facet.tag))
        rows.append(elements.four(nodes[: 3 if str(facet.tag).startswith("tri") else 4]))
    corners = numbering.places((node for row in rows for node in row), tag).reshape(len(rows), 4)
    return Surface(attribute(tag, "name"), corners, tuple(str(facet.tag) for facet in tags), tag, tags)


def _read_pair(tag: Element, surfaces: dict[str, Surface]) -> Pair:
    sides = []
    for side in ("primary", "secondary"):
        found = tag.find(side)
        if found is None:
            raise ModelError(f"{place(tag)}: has no <{side}>")
        surface = surfaces.get(text(found))
        if surface is None:
            raise unknown_name(found, "surface", text(found), surfaces)
        sides.append(surface)
    return Pair(attribute(tag, "name"), sides[0], sides[1], tag)
