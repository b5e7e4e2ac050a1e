"""Errors of a run of `scenes.harmonic` against its closed form."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness.post.hexahedra import Geometry, Rule, geometry
from harness.run.runner import RunResult
from scenes.harmonic import AMPLITUDE, COMPRESSION, EXACT, WAVE
from studies.models.quadratic import ADDED

Array = NDArray[np.float64]


def errors(result: RunResult) -> dict[str, float]:
    """Root mean square error over both bodies of displacement (mm) and concentration (mM) at the last time."""
    mesh = result.model.mesh
    values = {name: result.nodes[name][-1] for name in EXACT}
    squares = dict.fromkeys(("u", "c1"), 0.0)
    volume = 0.0
    for part in mesh.parts:
        elements = part.elements - 1
        made = _tetrahedra(mesh.nodes[elements]) if elements.shape[1] == 10 else geometry(mesh.nodes, elements)
        x, z = (made.at_points(mesh.nodes[elements][:, :, axis]) for axis in (0, 2))
        volume += float(made.volumes.sum())
        for name, expected in _exact(x, z).items():
            error = made.at_points(values[name][elements]) - expected
            squares["c1" if name == "c1" else "u"] += float((made.volumes * error**2).sum())
    return {name: float(np.sqrt(square / volume)) for name, square in squares.items()}


def _exact(x: Array, z: Array) -> dict[str, Array]:
    """The closed form, by the names of the logged data."""
    return {
        "ux": np.asarray(-AMPLITUDE * WAVE * np.cosh(WAVE * z) * np.sin(WAVE * x)),
        "uz": np.asarray(AMPLITUDE * WAVE * np.sinh(WAVE * z) * np.cos(WAVE * x) - COMPRESSION * z),
        "c1": np.asarray(0.5 + 0.05 * np.exp(WAVE * z) * np.cos(WAVE * x)),
    }


def _tetrahedra(places: Array) -> Geometry:
    """Elements of ten nodes with straight edges: 4 x 4 x 4 Gauss points of a cube that collapses to the tetrahedron."""
    points, weights = (0.5 * values for values in np.polynomial.legendre.leggauss(4))
    a, b, c = (axis.ravel() for axis in np.meshgrid(*[points + 0.5] * 3, indexing="ij"))
    one, two, three = a, b * (1 - a), c * (1 - a) * (1 - b)
    corners = np.stack([1 - one - two - three, one, two, three], axis=1)
    middles = [4 * corners[:, i] * corners[:, j] for i, j in ADDED[10]]
    values = np.column_stack([corners * (2 * corners - 1), *middles])
    shares = np.einsum("i,j,k->ijk", weights, weights, weights).ravel() * (1 - a) ** 2 * (1 - b)
    edges = places[:, 1:4] - places[:, :1]
    volumes = np.abs(np.linalg.det(edges))[:, None] * shares
    return Geometry(Rule(shares, values, np.empty(0)), volumes, np.empty(0))
