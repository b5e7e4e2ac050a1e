"""Two thin biphasic layers under a force: the contact grows as the asymptotic closed form says, line and circle."""

from __future__ import annotations

import numpy as np
import pytest

from studies import files
from studies.closed_forms.biphasic_layers import EDGE
from studies.hertz.growth_records import SPHERES, Record, largest_errors
from studies.hertz.page import SOURCE
from studies.models.biphasic_hertz import LENGTH, THICKNESS, BiphasicHertz, BiphasicLine, BiphasicSphere
from studies.pages.evidence import DATA
from studies.post import contact_growth

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


@pytest.mark.mixture_only
def test_a_circle_carries_the_force_and_grows(runner):
    """On a mesh that is small enough to run at each change.

    Two chords for a quarter circle have a tenth less area, which acts like a tenth more load: the approach, which goes
    with its third root, is a thirtieth larger.
    """
    problem = BiphasicSphere(across=18, through=1, around=2, name="biphasic-hertz-sphere-small")
    run = runner(problem.model())
    (_, force) = problem.load.points[-1]
    carried = run.surface("lower-cartilage")["contact_force.y"][-1, 0]
    assert carried == pytest.approx(-problem.modelled * force, rel=1e-6)
    found = contact_growth.measured(problem, run).since(problem.load.points[1][0])
    exact = contact_growth.exact(problem, found.times)
    assert found.half_width[-1] > 1.1 * found.half_width[0]
    assert np.abs(found.approach / exact.approach - 1.0).max() <= 0.05


def test_radius_and_peak_pressure_over_a_circle_are_nearer_to_the_closed_form_on_the_finer_mesh():
    """As the page has them: `biphasic-hertz --folder docs` runs both meshes."""
    rows = files.read_csv(DATA / SOURCE, Record)
    coarse, fine = (
        largest_errors([row for row in rows if row.model == problem.name], problem.load.points[1][0])
        for problem in SPHERES
    )
    assert all(fine[name] < coarse[name] for name in ("half_width", "peak"))
    assert max(fine["half_width"], fine["peak"]) <= BAR
