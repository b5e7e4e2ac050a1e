"""Structured hexahedral columns, split into bodies or in one piece, with the sets that a model refers to."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from harness.arrays import Array, Ids
from harness.errors import ModelError

Nodes = Array


@dataclass(frozen=True)
class Part:
    """A named group of elements of one type and one material."""

    # Names in the model file.
    name: str
    material: str
    # shape (n_elements, 8, 20, 27, 6 or 15): node numbers, from 1, in FEBio's order of hex8, hex20, hex27, penta6 or
    # penta15.
    elements: Ids


@dataclass(frozen=True)
class Mesh:
    """Nodes, parts and named sets; all node numbers start from 1."""

    nodes: Nodes  # shape (n_nodes, 3): reference positions, mm
    parts: tuple[Part, ...]
    node_sets: dict[str, Ids] = field(default_factory=dict)
    # shape (n_facets, 3, 4, 6, 8 or 9): facets whose nodes turn counterclockwise seen from outside the body.
    surfaces: dict[str, Ids] = field(default_factory=dict)
    # Primary and secondary surface of each contact pair.
    pairs: dict[str, tuple[str, str]] = field(default_factory=dict)


@dataclass(frozen=True)
class Layer:
    """One slab of a column: its name, material, thickness (mm) and number of elements through the thickness."""

    name: str
    material: str
    thickness: float
    elements: int


@dataclass(frozen=True)
class Section:
    """Cross-section of a column: widths (mm) and numbers of elements along x and y."""

    width: tuple[float, float] = (1.0, 1.0)
    elements: tuple[int, int] = (1, 1)


@dataclass(frozen=True)
class Box:
    """A body: its name, material, lowest corner (mm), size (mm) and numbers of elements along x, y, z."""

    name: str
    material: str
    corner: tuple[float, float, float]
    size: tuple[float, float, float]
    elements: tuple[int, int, int]


def _block(x: Array, y: Array, z: Array) -> tuple[Nodes, Ids, dict[str, Ids], dict[str, Ids]]:
    """One box of hex8 over the given lines of nodes (mm), nodes numbered from 1, x fastest.

    Returns: nodes, elements, and the nodes and the facets of ``bottom`` and ``top``.
    """
    zz, yy, xx = np.meshgrid(z, y, x, indexing="ij")
    nodes = np.column_stack([xx.ravel(), yy.ravel(), zz.ravel()])
    number = 1 + np.arange(len(nodes), dtype=np.int64).reshape(zz.shape)
    a, b = number[:-1, :-1, :-1], number[:-1, :-1, 1:]
    c, d = number[:-1, 1:, 1:], number[:-1, 1:, :-1]
    e, f = number[1:, :-1, :-1], number[1:, :-1, 1:]
    g, h = number[1:, 1:, 1:], number[1:, 1:, :-1]
    elements = np.stack([v.ravel() for v in (a, b, c, d, e, f, g, h)], axis=1)
    upward = np.stack([v[-1].ravel() for v in (e, f, g, h)], axis=1)
    downward = np.stack([v[0].ravel() for v in (a, d, c, b)], axis=1)
    ends = {"bottom": number[0].ravel(), "top": number[-1].ravel()}
    return nodes, elements, ends, {"bottom": downward, "top": upward}


def _line(start: float, length: float, elements: int, name: str) -> Array:
    if elements < 1 or length <= 0.0:
        raise ModelError(f"'{name}' needs a size above 0 and at least one element, got {length} mm and {elements}")
    return np.linspace(start, start + length, elements + 1)


def assemble(boxes: Sequence[Box]) -> Mesh:
    """Put bodies together that share no nodes.

    boxes: numbered in this order.
    Returns: node sets ``all`` and, for each box, ``<name>-bottom`` and ``<name>-top``; surfaces of the latter names,
        their facets ordered with x fastest; no pairs.
    Raises ModelError for a box without size or elements.
    """
    nodes: list[Nodes] = []
    parts: list[Part] = []
    sets: dict[str, Ids] = {}
    surfaces: dict[str, Ids] = {}
    offset = 0
    for box in boxes:
        lines = (_line(box.corner[k], box.size[k], box.elements[k], box.name) for k in range(3))
        points, elements, ends, facets = _block(*lines)
        nodes.append(points)
        parts.append(Part(box.name, box.material, elements + offset))
        sets |= {f"{box.name}-{end}": ids + offset for end, ids in ends.items()}
        surfaces |= {f"{box.name}-{end}": ids + offset for end, ids in facets.items()}
        offset += len(points)
    everything = {"all": np.arange(1, offset + 1, dtype=np.int64)}
    return Mesh(np.concatenate(nodes), tuple(parts), everything | sets, surfaces)


def split_column(layers: Sequence[Layer], *, bottom: float, section: Section | None = None, gap: float = 0.0) -> Mesh:
    """Stack layers along z as separate bodies, with a contact pair between each two neighbours.

    layers: from below to above.
    bottom: height of the lowest face, mm.
    section: cross-section; one element of 1 mm x 1 mm by default.
    gap: distance between neighbours, mm; negative where they are to overlap.
    Returns: node sets ``all``, ``bottom``, ``top``, and for each layer ``<name>-bottom`` and ``<name>-top``; surfaces
        of the same names; pairs ``<lower>/<upper>`` whose primary surface is the top of the lower layer.
    Raises ModelError for a layer without thickness or elements.
    """
    section = section or Section()
    boxes: list[Box] = []
    height = bottom
    for layer in layers:
        size, elements = (*section.width, layer.thickness), (*section.elements, layer.elements)
        boxes.append(Box(layer.name, layer.material, (0.0, 0.0, height), size, elements))
        height += layer.thickness + gap
    mesh = assemble(boxes)
    pairs = {f"{a.name}/{b.name}": (f"{a.name}-top", f"{b.name}-bottom") for a, b in pairwise(layers)}
    ends = {"bottom": f"{layers[0].name}-bottom", "top": f"{layers[-1].name}-top"}
    sets, surfaces = (
        {end: groups[name] for end, name in ends.items()} | groups for groups in (mesh.node_sets, mesh.surfaces)
    )
    return replace(mesh, node_sets=sets, surfaces=surfaces, pairs=pairs)


def conforming_column(layers: Sequence[Layer], *, bottom: float, section: Section | None = None) -> Mesh:
    """Stack layers along z as one body: the same mesh as `split_column`, its coincident nodes merged.

    Parameters and sets are those of `split_column`; there are no contact pairs.

    Raises ModelError for a layer without thickness or elements.
    """
    mesh = split_column(layers, bottom=bottom, section=section)
    same = np.arange(len(mesh.nodes))
    for lower, upper in pairwise(layers):
        same[mesh.node_sets[f"{upper.name}-bottom"] - 1] = mesh.node_sets[f"{lower.name}-top"] - 1
    kept, places = np.unique(same, return_inverse=True)
    number = np.asarray(1 + places, dtype=np.int64)
    sets = {"all": np.arange(1, len(kept) + 1, dtype=np.int64)}
    sets |= {name: number[ids - 1] for name, ids in mesh.node_sets.items() if name != "all"}
    ends = ("bottom", "top", f"{layers[0].name}-bottom", f"{layers[-1].name}-top")
    surfaces = {name: number[mesh.surfaces[name] - 1] for name in ends}
    parts = tuple(replace(part, elements=number[part.elements - 1]) for part in mesh.parts)
    return Mesh(mesh.nodes[kept], parts, sets, surfaces)
