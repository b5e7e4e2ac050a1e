"""Large sliding with friction beside published curves."""

from __future__ import annotations

import numpy as np
import pytest

from harness.post.compare import missed
from studies import files
from studies.friction import curves, curves_table, published
from studies.friction.curves import Row
from studies.models import twisting_hemisphere
from studies.models.concentric_spheres import ConcentricSpheres
from studies.models.twisting_hemisphere import TwistingHemisphere
from studies.pages.evidence import DATA

NEWTON = 1e-3
"""FEBio's tolerance on the displacements of a step."""


def inner_radius(mesh, part):
    """Least distance of a part's nodes from their centre, which lies in the plane of its rim."""
    nodes = mesh.nodes[np.unique(next(p.elements for p in mesh.parts if p.name == part)) - 1]
    return np.linalg.norm(nodes - np.array([0.0, 0.0, nodes[:, 2].max()]), axis=1).min()


def test_a_value_is_measured_from_what_is_published():
    assert curves.outside(1.0, (0.9, 1.1)) == 0.0
    assert curves.outside(0.9, (1.0, 1.1)) == pytest.approx(0.1)
    assert curves.outside(1.2, (0.9, 1.0)) == pytest.approx(0.2)


def test_a_curve_has_no_value_where_it_does_not_reach():
    rows = [curves.Row("torque", "run", place, 2.0 * place) for place in (0.0, 10.0, 30.0)]
    np.testing.assert_allclose(curves.values_at(rows, "torque", "run", (20.0, 30.0, 40.0)), (40.0, 60.0, np.nan))


def test_the_hemisphere_has_the_published_wall_and_turns_half_round():
    assert inner_radius(TwistingHemisphere().model().mesh, "hemisphere") == pytest.approx(2.0 / 3.0)
    rim = np.array([1.0, 0.0, 3.0])
    np.testing.assert_allclose(twisting_hemisphere.position(rim, twisting_hemisphere.END), [-1.0, 0.0, 2.0], atol=1e-12)


def shells(elements):
    """Volumes that the edges at the first corner of each element of both shells make."""
    mesh = ConcentricSpheres(elements=elements, through=elements // 2).model().mesh
    corners = mesh.nodes[np.concatenate([part.elements for part in mesh.parts if part.name in ("inner", "outer")]) - 1]
    return np.linalg.det(corners[:, [1, 3, 4]] - corners[:, :1])


def test_the_shells_fill_their_octant():
    exact = np.pi / 6.0 * (14.0**3 - 10.0**3)
    coarse, fine = (shells(elements) for elements in (8, 16))
    assert min(coarse.min(), fine.min()) > 0.0
    assert 0.0 < exact - fine.sum() < 0.6 * (exact - coarse.sum())  # of first order in the size of the elements


RECORDED = files.read_csv(DATA / curves_table.SOURCE, Row)
"""What the page of friction says."""


@pytest.mark.slow(longest=True)
@pytest.mark.mixture_only
@pytest.mark.parametrize("problem", ["torque", "force"])
def test_the_hemisphere_of_the_page_is_what_the_code_gives(runner, problem):
    """On the coarse mesh, to Newton's tolerance. Where this fails on purpose: `friction-benchmarks --folder docs`."""
    rows, series = curves.hemisphere_rows("coarse mesh", runner), (problem, "coarse mesh")
    now, written = (curves.values_at(each, *series, published.ANGLES) for each in (rows, RECORDED))
    np.testing.assert_allclose(now, written, rtol=NEWTON)


def test_the_torque_of_a_twisting_hemisphere():
    """On the fine mesh, as the page has it."""
    assert missed(curves.torque_measures(RECORDED, "fine mesh")) == []


@pytest.mark.slow(longest=True)
@pytest.mark.mixture_only
def test_the_force_of_concentric_spheres(runner):
    """On the coarse mesh; `friction-benchmarks` runs the fine one, too."""
    rows = curves.sphere_rows(curves.SPHERES, "coarse mesh", runner)
    found = curves.values_at(rows, curves.SPHERES, "coarse mesh", published.WAYS)
    spans = published.spread(published.SPHERES)
    assert [curves.outside(value, span) for value, span in zip(found.tolist(), spans, strict=True)] == [0.0] * 5
