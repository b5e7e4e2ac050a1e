"""Numbers that say how far two solutions are apart, and whether that is near enough."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from harness.arrays import Array, Ids
from harness.errors import ModelError
from harness.models.mesh import Mesh
from harness.run.runner import RunResult

SAME_PLACE = 1e-6  # mm between nodes of two meshes that stand for one another


@dataclass(frozen=True)
class Measure:
    """One measured number and the tolerance it is held against."""

    name: str
    value: float
    tolerance: float  # largest value allowed
    lowest: float = -math.inf  # smallest value allowed
    note: str = ""  # where the number comes from

    @property
    def passed(self) -> bool:
        """Whether the value lies within its bounds; nan does not."""
        return self.lowest <= self.value <= self.tolerance


def missed(measures: Iterable[Measure]) -> list[str]:
    """The measures that miss their tolerance, each in a line."""
    return [
        f"{m.name}: {m.value:.6g}, not within [{m.lowest:g}, {m.tolerance:g}] {m.note}"
        for m in measures
        if not m.passed
    ]


def counterparts(mesh: Mesh, reference: Mesh) -> Ids:
    """For each node of a split mesh, the index (from 0) of the node of the conforming mesh at the same place.

    Raises ModelError where a node has no counterpart within `SAME_PLACE`.
    """
    distance, index = cKDTree(reference.nodes).query(mesh.nodes)
    if np.any(distance > SAME_PLACE):
        worst = int(np.argmax(distance))
        raise ModelError(f"node {worst + 1} at {mesh.nodes[worst]} has no counterpart within {SAME_PLACE:g} mm")
    return np.asarray(index, dtype=np.int64)


def largest_difference(split: RunResult, reference: RunResult, column: str) -> float:
    """Largest of `differences`."""
    return float(np.max(differences(split, reference, column)))


def differences(split: RunResult, reference: RunResult, column: str) -> Array:
    """Differences of one nodal variable between a split body and the conforming reference, shape (n_times, n_nodes).

    Raises ModelError where the times differ.
    """
    a, b = split.nodes, reference.nodes
    if a.times.shape != b.times.shape or not np.allclose(a.times, b.times, rtol=1e-8, atol=0.0):
        raise ModelError(f"'{split.model.name}' and '{reference.model.name}' were not written at the same times")
    same = counterparts(split.model.mesh, reference.model.mesh)
    return np.abs(a[column] - b[column][:, same])


def jump(result: RunResult, column: str, pair: str) -> float:
    """Largest |difference| of a nodal variable over a contact pair of matching meshes, at the end."""
    values = result.nodes[column][-1]
    below, above = facing(result.model.mesh, pair)
    return float(np.max(np.abs(values[below - 1] - values[above - 1])))


def facing(mesh: Mesh, pair: str) -> tuple[Ids, Ids]:
    """Numbers of the nodes of the primary surface of a pair, and of the nodes of the secondary that face them."""
    primary, secondary = (np.unique(mesh.surfaces[name]) for name in mesh.pairs[pair])
    _, index = cKDTree(mesh.nodes[secondary - 1, :2]).query(mesh.nodes[primary - 1, :2])
    return primary, secondary[index]


def error_at(result: RunResult, column: str, exact: Array, time: float | None = None) -> float:
    """Largest nodal |value - exact| at a time (s) or the last; `exact` has shape (n_nodes,)."""
    history = result.nodes
    state = history.at(time) if time is not None else -1
    return float(np.max(np.abs(history[column][state] - exact)))


def observed_order(coarse: float, fine: float) -> float:
    """log2(coarse/fine), for two errors or two successive differences on elements of half the size."""
    return math.log2(coarse / fine)
