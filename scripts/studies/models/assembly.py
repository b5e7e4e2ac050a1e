"""Several bodies of hexahedra in one mesh, with sets and surfaces chosen by position."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import log

import numpy as np
from numpy.typing import NDArray

from harness.arrays import Ids
from harness.errors import ModelError
from harness.models import blocks
from harness.models.blocks import Body, Points
from harness.models.mesh import Mesh, Part

Inside = Callable[[Points], NDArray[np.bool_]]  # which positions, shape (..., 3) in mm, belong to a set
NEAR = 1e-9  # tolerance for positions, mm


@dataclass(frozen=True)
class Chosen:
    """Nodes or outer facets of one body (of all bodies, for an empty name) that lie inside."""

    body: str
    inside: Inside


def plane(axis: str, value: float, body: str = "") -> Chosen:
    """What lies in the plane where the coordinate `axis` (x, y or z) has a value, mm."""
    number = "xyz".index(axis)
    return Chosen(body, lambda x: np.asarray(np.abs(x[..., number] - value) < NEAR))


def sphere(radius: float, body: str = "", height: float = 0.0) -> Chosen:
    """What lies on the sphere around the point of a height on the z axis; radius and height in mm."""
    centre = np.array([0.0, 0.0, height])
    return Chosen(body, lambda x: np.asarray(np.abs(np.linalg.norm(x - centre, axis=-1) - radius) < NEAR))


def cylinder(radius: float, body: str = "") -> Chosen:
    """What lies on the circular cylinder around the z axis, radius in mm."""
    return Chosen(body, lambda x: np.asarray(np.abs(np.hypot(x[..., 0], x[..., 1]) - radius) < NEAR))


def everywhere(body: str = "") -> Chosen:
    """All of a body, or of all bodies."""
    return Chosen(body, lambda x: np.ones(x.shape[:-1], dtype=bool))


def assembled(
    bodies: Mapping[str, Body],
    node_sets: Mapping[str, Chosen],
    surfaces: Mapping[str, Chosen],
    pairs: Mapping[str, tuple[str, str]],
) -> Mesh:
    """One mesh of bodies that share no nodes; each is a part whose material has its name.

    Raises ModelError where a set or surface is empty: nothing of the mesh lies there.
    """
    names = list(bodies)
    ends = np.cumsum([len(body.nodes) for body in bodies.values()]).tolist()
    offsets = dict(zip(names, [0, *ends[:-1]], strict=True))
    nodes = np.concatenate([body.nodes for body in bodies.values()])
    parts = tuple(Part(name, name, body.elements + offsets[name] + 1) for name, body in bodies.items())
    sets = {name: _filled(name, _node_set(bodies, offsets, chosen)) for name, chosen in node_sets.items()}
    facets = {
        name: _filled(name, blocks.facets_where(bodies[chosen.body], chosen.inside) + offsets[chosen.body] + 1)
        for name, chosen in surfaces.items()
    }
    return Mesh(nodes, parts, sets, facets, dict(pairs))


def _node_set(bodies: Mapping[str, Body], offsets: Mapping[str, int], chosen: Chosen) -> Ids:
    """Numbers of the chosen nodes, from 1."""
    names = [chosen.body] if chosen.body else list(bodies)
    found = [np.flatnonzero(chosen.inside(bodies[name].nodes)) + offsets[name] + 1 for name in names]
    return np.concatenate(found).astype(np.int64)


def _filled(name: str, ids: Ids) -> Ids:
    if not len(ids):
        raise ModelError(f"nothing of the mesh lies in '{name}'")
    return ids


def graded(length: float, elements: int, ratio: float) -> NDArray[np.float64]:
    """Positions of the nodes of a line from 0 to `length` (mm); each element is `ratio` times the one before."""
    sizes = ratio ** np.arange(elements)
    return np.asarray(length * np.concatenate([[0.0], np.cumsum(sizes)]) / sizes.sum())


def refined(even: float, size: float, length: float, ratio: float) -> NDArray[np.float64]:
    """Positions from 0 to `length` (mm): elements of `size` as far as `even`, then each `ratio` times the last one."""
    first = np.linspace(0.0, even, round(even / size) + 1)
    number = round(log(1.0 + (length - even) * (ratio - 1.0) / size) / log(ratio))
    return np.concatenate([first[:-1], even + graded(length - even, number, ratio)])


def box(low: Sequence[float], high: Sequence[float], elements: Sequence[int]) -> Body:
    """A box between two corners (mm)."""
    return tensor([np.linspace(a, b, n + 1) for a, b, n in zip(low, high, elements, strict=True)])


def raised(body: Body, axis: str, rise: Callable[[Points], NDArray[np.float64]]) -> Body:
    """The same body with its nodes moved along an axis by a function (mm) of their positions."""
    nodes = body.nodes.copy()
    nodes[:, "xyz".index(axis)] += rise(nodes)
    return Body(nodes, body.elements)


def tensor(lines: Sequence[NDArray[np.float64]]) -> Body:
    """A box with a node at each combination of positions (mm) along x, y and z."""
    return blocks.structured(np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1))
