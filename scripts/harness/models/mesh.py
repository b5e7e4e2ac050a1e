"""Structured hexahedral columns, cut into bodies or glued, with the sets that a model refers to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from harness.errors import ModelError

Nodes = NDArray[np.float64]
Ids = NDArray[np.int64]


@dataclass(frozen=True)
class Part:
    """A named group of elements of one type and one material.

    Attributes
    ----------
    name, material : str
        Names in the model file.
    elements : ndarray of int, shape (n_elements, 8)
        Node numbers, from 1, in FEBio's hex8 order.
    """

    name: str
    material: str
    elements: Ids


@dataclass(frozen=True)
class Mesh:
    """Nodes, parts and named sets; all node numbers start from 1.

    Attributes
    ----------
    nodes : ndarray, shape (n_nodes, 3)
        Reference positions, mm.
    parts : tuple of Part
    node_sets : dict of str to ndarray of int
    surfaces : dict of str to ndarray of int, shape (n_facets, 4)
        Facets whose nodes turn counterclockwise seen from outside the body.
    pairs : dict of str to (str, str)
        Primary and secondary surface of each contact pair.
    """

    nodes: Nodes
    parts: tuple[Part, ...]
    node_sets: dict[str, Ids] = field(default_factory=dict)
    surfaces: dict[str, Ids] = field(default_factory=dict)
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
class _Block:
    nodes: Nodes
    elements: Ids
    bottom: Ids
    top: Ids
    bottom_facets: Ids
    top_facets: Ids


def _block(z: NDArray[np.float64], section: Section) -> _Block:
    """One box of hex8 over the heights `z` (n_z + 1 values, mm), nodes numbered from 1, x fastest."""
    nx, ny = section.elements
    x = np.linspace(0.0, section.width[0], nx + 1)
    y = np.linspace(0.0, section.width[1], ny + 1)
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
    return _Block(nodes, elements, number[0].ravel(), number[-1].ravel(), downward, upward)


def _heights(layer: Layer, start: float) -> NDArray[np.float64]:
    if layer.elements < 1 or layer.thickness <= 0.0:
        raise ModelError(
            f"layer '{layer.name}': needs a thickness above 0 and at least one element, "
            f"got {layer.thickness} mm and {layer.elements}"
        )
    return np.linspace(start, start + layer.thickness, layer.elements + 1)


def cut_column(layers: Sequence[Layer], *, bottom: float, section: Section | None = None, gap: float = 0.0) -> Mesh:
    """Stack layers along z as separate bodies, with a contact pair between each two neighbours.

    Parameters
    ----------
    layers : sequence of Layer
        From below to above.
    bottom : float
        Height of the lowest face, mm.
    section : Section, optional
        Cross-section; one element of 1 mm x 1 mm by default.
    gap : float
        Distance between neighbours, mm; negative where they are to overlap.

    Returns
    -------
    Mesh
        Node sets ``all``, ``bottom``, ``top``, and for each layer ``<name>-bottom`` and ``<name>-top``; surfaces of
        the same names; pairs ``<lower>/<upper>`` whose primary surface is the top of the lower layer.

    Raises
    ------
    ModelError
        For a layer without thickness or elements.
    """
    section = section or Section()
    nodes: list[Nodes] = []
    parts: list[Part] = []
    sets: dict[str, Ids] = {}
    surfaces: dict[str, Ids] = {}
    offset, height = 0, bottom
    for layer in layers:
        block = _block(_heights(layer, height), section)
        nodes.append(block.nodes)
        parts.append(Part(layer.name, layer.material, block.elements + offset))
        sets[f"{layer.name}-bottom"] = block.bottom + offset
        sets[f"{layer.name}-top"] = block.top + offset
        surfaces[f"{layer.name}-bottom"] = block.bottom_facets + offset
        surfaces[f"{layer.name}-top"] = block.top_facets + offset
        offset += len(block.nodes)
        height += layer.thickness + gap
    pairs = {f"{a.name}/{b.name}": (f"{a.name}-top", f"{b.name}-bottom") for a, b in pairwise(layers)}
    return Mesh(
        np.concatenate(nodes), tuple(parts), _with_ends(sets, layers, offset), _with_ends(surfaces, layers), pairs
    )


def glued_column(layers: Sequence[Layer], *, bottom: float, section: Section | None = None) -> Mesh:
    """Stack layers along z as one body: the same mesh as `cut_column`, its coincident nodes merged.

    Parameters and sets are those of `cut_column`; there are no contact pairs.

    Raises
    ------
    ModelError
        For a layer without thickness or elements.
    """
    section = section or Section()
    heights = [_heights(layers[0], bottom)]
    for layer in layers[1:]:
        heights.append(_heights(layer, float(heights[-1][-1])))
    z = np.concatenate([heights[0], *[h[1:] for h in heights[1:]]])
    block = _block(z, section)
    per_plane = (section.elements[0] + 1) * (section.elements[1] + 1)
    per_row = section.elements[0] * section.elements[1]
    parts: list[Part] = []
    sets: dict[str, Ids] = {}
    first = 0
    for layer in layers:
        last = first + layer.elements
        parts.append(Part(layer.name, layer.material, block.elements[first * per_row : last * per_row]))
        sets[f"{layer.name}-bottom"] = block.bottom + first * per_plane
        sets[f"{layer.name}-top"] = block.bottom + last * per_plane
        first = last
    surfaces = {f"{layers[0].name}-bottom": block.bottom_facets, f"{layers[-1].name}-top": block.top_facets}
    return Mesh(block.nodes, tuple(parts), _with_ends(sets, layers, len(block.nodes)), _with_ends(surfaces, layers))


def _with_ends(groups: dict[str, Ids], layers: Sequence[Layer], n_nodes: int | None = None) -> dict[str, Ids]:
    """Add the names ``bottom`` and ``top`` (and ``all`` where the number of nodes is given)."""
    ends = {"bottom": groups[f"{layers[0].name}-bottom"], "top": groups[f"{layers[-1].name}-top"]}
    everything = {} if n_nodes is None else {"all": np.arange(1, n_nodes + 1, dtype=np.int64)}
    return everything | ends | groups
