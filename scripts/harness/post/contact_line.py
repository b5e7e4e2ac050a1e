"""Two surfaces seen as lines in the plane z = 0: their gap, and the fields on both sides of it."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from harness.arrays import Array, Ids
from harness.models.mesh import Mesh


@dataclass(frozen=True)
class Projection:
    """Points projected on a line."""

    gap: Array  # shape (n_points,): mm along the normal of the line, negative where a point lies inside the other body
    segment: Ids  # shape (n_points,): the segment of the line, from 0
    fraction: Array  # shape (n_points,): place on the segment, from 0 to 1

    def sample(self, values: Array) -> Array:
        """Values on the line at the projections, of the values at its nodes."""
        low, high = values[self.segment], values[self.segment + 1]
        return np.asarray(low + self.fraction * (high - low))


def line_nodes(mesh: Mesh, surface: str) -> Ids:
    """Numbers (from 1) of a surface's nodes in the plane z = 0, from the axis x = 0 outwards along the surface."""
    on_plane = np.abs(mesh.nodes[:, 2]) < 1e-9
    chains: dict[int, set[int]] = {}
    for facet in mesh.surfaces[surface].tolist():
        for a, b in pairwise([*facet, facet[0]]):
            if on_plane[a - 1] and on_plane[b - 1]:
                chains.setdefault(a, set()).add(b)
                chains.setdefault(b, set()).add(a)
    ends = [number for number, others in chains.items() if len(others) == 1]
    path = [min(ends, key=lambda number: float(mesh.nodes[number - 1, 0]))]
    while True:
        following = [number for number in chains[path[-1]] if number not in path[-2:-1]]
        if not following:
            return np.array(path, dtype=np.int64)
        path.append(following[0])


def project(points: Array, line: Array) -> Projection:
    """Project points on a line of segments.

    points: shape (n_points, 2), positions x, y, mm.
    line: shape (n_nodes, 2), positions of its nodes; the body it bounds lies to its left.
    """
    start, along = line[:-1], np.diff(line, axis=0)
    squared = np.sum(along**2, axis=1)
    relative = points[:, None, :] - start
    fraction = np.clip(np.sum(relative * along, axis=2) / squared, 0.0, 1.0)
    away = relative - fraction[..., None] * along
    distance = np.linalg.norm(away, axis=2)
    nearest = np.argmin(distance, axis=1)
    rows = np.arange(len(points))
    cross = along[:, 0] * relative[..., 1] - along[:, 1] * relative[..., 0]
    side = np.where(cross[rows, nearest] > 0.0, -1.0, 1.0)
    return Projection(side * distance[rows, nearest], nearest.astype(np.int64), fraction[rows, nearest])


def half_width(x: Array, gap: Array) -> float:
    """Place (mm) at which a line that touches at its start leaves the other one.

    x, gap: shape (n_points,), positions along the line and gaps, mm, from the axis outwards; 0 and less is contact.
    Returns: interpolated between the last closed point and the first open one after it; 0 where nothing is in contact.
    """
    touching = np.flatnonzero(gap <= 0.0)
    if touching.size == 0:
        return 0.0
    last = int(touching[-1])
    if last == len(x) - 1:
        return float(x[last])
    share = -gap[last] / (gap[last + 1] - gap[last])
    return float(x[last] + share * (x[last + 1] - x[last]))
