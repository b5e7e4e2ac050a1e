"""Two thin biphasic layers under a force: the contact grows as the asymptotic closed form says."""

from __future__ import annotations

import numpy as np
import pytest

from harness.closed_forms.biphasic_layers import EDGE
from harness.models.biphasic_hertz import LENGTH, THICKNESS, BiphasicHertz, BiphasicLine
from harness.post import contact_growth

BAR = 0.03
COARSE = BiphasicLine()
FINE = BiphasicLine(across=2 * COARSE.across, through=2 * COARSE.through, name="biphasic-hertz-fine")


@pytest.fixture(scope="module")
def growth(runner):
    """What a run found and the closed form, from when the load has come."""

    def of(problem: BiphasicHertz):
        found = contact_growth.measured(problem, runner(problem.model())).since(problem.load.points[1][0])
        return found, contact_growth.exact(problem, found.times)

    return of


def errors(found, exact, edge: float = 0.0) -> tuple[float, float]:
    """Largest relative errors of half-width, its edge `edge` (mm) inwards of thin layers', and of peak pressure."""
    width = found.half_width / (exact.half_width - edge) - 1.0
    return float(np.abs(width).max()), float(np.abs(found.peak / exact.peak - 1.0).max())


@pytest.mark.mixture_only
def test_half_width_and_peak_pressure_follow_the_closed_form(growth):
    found, exact = growth(COARSE)
    assert max(errors(found, exact)) <= BAR
    assert exact.half_width[-1] / exact.half_width[0] > 1.13
    assert exact.peak[-1] / exact.peak[0] < 0.85


@pytest.mark.mixture_only
def test_the_edge_is_where_a_layer_of_finite_thickness_has_it(growth):
    """Within half a facet, which is what a contact area counted in facets resolves, and half of one for the mesh."""
    found, exact = growth(COARSE)
    facet = LENGTH / COARSE.across
    assert np.abs(found.half_width - (exact.half_width - EDGE * THICKNESS)).max() <= facet


@pytest.mark.mixture_only
@pytest.mark.slow
def test_errors_fall_with_the_mesh(growth):
    coarse, fine = (errors(*growth(problem), EDGE * THICKNESS) for problem in (COARSE, FINE))
    assert fine[0] < coarse[0]
    assert fine[1] < coarse[1] < BAR
