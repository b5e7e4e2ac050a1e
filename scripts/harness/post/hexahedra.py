"""Shape functions and quadrature of FEBio's hexahedra, over many elements at once.

Written here and not taken from scikit-fem or basix, because those number the nodes of an element in orders of their own
and take a mesh of their own: the translation would be as long as the two functions, and a balance to rounding hangs on
the same nodes and points as FEBio's.
"""

from dataclasses import dataclass
from functools import cache
from itertools import product

import numpy as np

from harness.arrays import Array, Ids
from harness.models.blocks import EDGES

_CORNERS = np.array(
    [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
    dtype=np.float64,
)


@dataclass(frozen=True)
class Rule:
    """An element type with its integration rule."""

    weights: Array  # shape (n_points,)
    values: Array  # shape (n_points, n_nodes): shape functions
    slopes: Array  # shape (n_points, n_nodes, 3): their derivatives in the parent coordinates


@cache
def rule(n_nodes: int) -> Rule:
    """The rule that FEBio uses by default: 2 x 2 x 2 Gauss points for hex8, 3 x 3 x 3 for hex20.

    Raises ValueError for another number of nodes.
    """
    if n_nodes not in (8, 20):
        raise ValueError(f"no rule for a hexahedron of {n_nodes} nodes; there is 8 and 20")
    points, weights = np.polynomial.legendre.leggauss(2 if n_nodes == 8 else 3)
    places = np.array(list(product(points, repeat=3)))
    factors = np.array([a * b * c for a, b, c in product(weights, repeat=3)])
    shape = _linear if n_nodes == 8 else _serendipity
    made = [shape(place) for place in places]
    return Rule(factors, np.stack([values for values, _ in made]), np.stack([slopes for _, slopes in made]))


def _linear(x: Array) -> tuple[Array, Array]:
    """Shape functions of hex8 and their derivatives at a parent coordinate."""
    factors = 1.0 + _CORNERS * x
    values = factors.prod(axis=1) / 8.0
    slopes = np.stack([_CORNERS[:, i] * np.delete(factors, i, axis=1).prod(axis=1) / 8.0 for i in range(3)], axis=1)
    return values, slopes


def _serendipity(x: Array) -> tuple[Array, Array]:
    """The same for hex20: functions of the mid-edge nodes, and of the corners less half of their neighbours."""
    values, slopes = _linear(x)
    middle_values, middle_slopes = [], []
    for a, b in EDGES:
        value, slope = _bubble(x, (_CORNERS[a] + _CORNERS[b]) / 2.0)
        for corner in (a, b):
            values[corner] -= value / 2.0
            slopes[corner] -= slope / 2.0
        middle_values.append(value)
        middle_slopes.append(slope)
    return np.concatenate([values, middle_values]), np.concatenate([slopes, middle_slopes])


def _bubble(x: Array, node: Array) -> tuple[float, Array]:
    """Function of a mid-edge node, quadratic along its edge, and its derivatives."""
    along = int(np.flatnonzero(node == 0.0)[0])
    factors = 1.0 + node * x
    slopes = node.copy()
    factors[along], slopes[along] = 1.0 - x[along] ** 2, -2.0 * x[along]
    value = float(factors.prod()) / 4.0
    return value, np.array([slopes[i] * np.delete(factors, i).prod() / 4.0 for i in range(3)])


@dataclass(frozen=True)
class Geometry:
    """Elements of one type in one configuration."""

    rule: Rule
    volumes: Array  # shape (n_elements, n_points): weight times Jacobian determinant, mm^3
    gradients: Array  # shape (n_elements, n_points, n_nodes, 3): of the shape functions, in space, 1/mm

    def at_points(self, nodal: Array) -> Array:
        """Values at the integration points, (n_elements, n_points), of nodal ones, (n_elements, n_nodes)."""
        return np.asarray(np.einsum("qa,ea->eq", self.rule.values, nodal))

    def gradient(self, nodal: Array) -> Array:
        """Gradients at the integration points, (n_elements, n_points, 3)."""
        return np.asarray(np.einsum("eqai,ea->eqi", self.gradients, nodal))


def geometry(positions: Array, elements: Ids) -> Geometry:
    """Elements, shape (n_elements, 8 or 20), nodes from 0, at positions of all nodes (mm), shape (n_nodes, 3)."""
    used = rule(elements.shape[1])
    jacobian = np.einsum("eai,qaj->eqij", positions[elements], used.slopes)
    gradients = np.einsum("qaj,eqji->eqai", used.slopes, np.linalg.inv(jacobian))
    return Geometry(used, np.linalg.det(jacobian) * used.weights, gradients)
