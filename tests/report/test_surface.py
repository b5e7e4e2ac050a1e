"""Areas and values of surfaces, as `report` sums them up."""

from __future__ import annotations

import numpy as np
import pytest

from harness.report.surface import TRIANGLES, Surface

# A facet of each kind on the unit square or the triangle below its diagonal: corners, middles of edges, centre.
_TRIANGLE = ((0, 0), (1, 0), (0, 1), (0.5, 0), (0.5, 0.5), (0, 0.5), (1 / 3, 1 / 3))
_SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5), (0.5, 0.5))


@pytest.mark.parametrize("nodes", sorted(TRIANGLES))
def test_area_and_normal_of_each_facet(nodes: int) -> None:
    corners, area = (_TRIANGLE, 0.5) if nodes in (3, 6, 7) else (_SQUARE, 1.0)
    positions = np.array([(x, y, 2.0) for x, y in corners[:nodes]])
    surface = Surface("one", (np.arange(nodes),))
    assert surface.area_vectors(positions) == pytest.approx(np.array([[0.0, 0.0, area]]), abs=1e-15)


def test_nodes_are_in_the_order_of_their_appearance() -> None:
    surface = Surface.from_faces("two", np.array([[1, 4, 7, 3, 5, 9], [2, 3, 9, 5, 1, 0]], dtype=np.int32))
    assert surface.nodes.tolist() == [7, 3, 5, 9, 1]


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ([[1.0], [2.0]], [1.0, 2.0]),
        ([[4.0]], [4.0, 4.0]),
        ([[0.0], [3.0], [6.0], [9.0]], [3.0, 6.0]),
        ([[1.0], [2.0], [3.0], [4.0], [5.0], [6.0]], [2.0, 5.0]),
    ],
    ids=["facets", "surface", "nodes", "corners"],
)
def test_values_at_facets(values: list[list[float]], expected: list[float]) -> None:
    surface = Surface("two", (np.array([0, 1, 2]), np.array([2, 1, 3])))
    assert surface.at_facets(np.array(values))[:, 0] == pytest.approx(expected)


def test_other_numbers_of_values_are_refused() -> None:
    surface = Surface("one", (np.array([0, 1, 2]),))
    with pytest.raises(ValueError, match="2 values on 1 facets with 3 nodes"):
        surface.at_facets(np.zeros((2, 1)))
