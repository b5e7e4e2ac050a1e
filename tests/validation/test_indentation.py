"""Problem 3.3 without a run: its meshes, the balance of solute, the contact seen as a line, and the reading of logs."""

from __future__ import annotations

from dataclasses import replace

import jacobians
import numpy as np
import pytest

from harness.indentation import measures
from harness.models import blocks, indentation_mesh
from harness.models.blocks import Body
from harness.models.indentation import CONCENTRATION, Indentation
from harness.models.indentation_mesh import Grid
from harness.models.mesh import Mesh
from harness.post import contact_line, solute_balance
from harness.post.hexahedra import geometry, rule
from harness.post.solute_balance import State
from studies import diagnosis
from studies.diagnosis import FailureMode
from studies.models.kept_models import LEVELS
from studies.models.quadratic import quadratic

GRIDS = {
    "medium": Grid(),
    "fine": LEVELS[2],
}


def made_of(nodes: int, mesh: Mesh) -> Mesh:
    """The mesh with elements of 8 or 20 nodes."""
    return mesh if nodes == 8 else quadratic(mesh, nodes)


def volume(body: Body) -> float:
    return float(geometry(body.nodes, body.elements).volumes.sum())


@pytest.mark.parametrize("grid", GRIDS.values(), ids=GRIDS)
def test_no_element_is_inverted(grid):
    for body in (indentation_mesh.slab_body(grid), indentation_mesh.cylinder_body(grid)):
        assert geometry(body.nodes, body.elements).volumes.min() > 0.0
        found = jacobians.at_corners(body.nodes, body.elements)
        assert (found.min(axis=1) / found.max(axis=1)).min() > 0.2


def test_volume_of_the_round_body_converges_to_that_of_the_circle():
    exact = np.pi / 4 * 3.0**2 * 0.25
    errors = [abs(volume(indentation_mesh.cylinder_body(Grid(around=n))) / exact - 1.0) for n in (3, 6)]
    order = np.log2(errors[0] / errors[1])
    assert order == pytest.approx(2.0, abs=0.1)


def test_bodies_touch_at_the_axis_and_nowhere_else():
    mesh = indentation_mesh.mesh(Grid())
    slab, arc = (mesh.nodes[contact_line.line_nodes(mesh, f"{body}-contact") - 1, :2] for body in ("slab", "cylinder"))
    gap = contact_line.project(slab, arc).gap
    assert gap[0] == pytest.approx(0.0, abs=1e-12)
    assert np.all(gap[1:] > 0.0)


def test_facets_point_outwards():
    mesh = indentation_mesh.mesh(Grid())
    for name, middle in (("slab-contact", (0.0, 1.0)), ("cylinder-contact", (0.0, 5.0))):
        x = mesh.nodes[mesh.surfaces[name][:, :4] - 1]
        normal = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])[:, :2]
        outward = x.mean(axis=1)[:, :2] - np.array(middle)
        assert np.all(np.sum(normal * outward, axis=1) > 0.0)


def test_a_left_handed_block_is_turned_over():
    axes = np.meshgrid([0.0, 1.0], [0.0, 1.0], [0.0, -2.0], indexing="ij")
    assert volume(blocks.structured(np.stack(axes, axis=-1))) == pytest.approx(2.0)


@pytest.mark.parametrize("nodes", [8, 20])
def test_shape_functions_reproduce_their_space(nodes):
    used = rule(nodes)
    np.testing.assert_allclose(used.values.sum(axis=1), 1.0, atol=1e-14)
    np.testing.assert_allclose(used.slopes.sum(axis=1), 0.0, atol=1e-14)
    mesh = made_of(nodes, indentation_mesh.mesh(Grid(across=2, down=2)))
    body = Body(mesh.nodes, mesh.parts[0].elements - 1)
    x, y, _ = body.nodes.T
    field = 2.0 * x - y if nodes == 8 else x**2 + x * y
    found = geometry(body.nodes, body.elements)
    places = [found.at_points(component[body.elements]) for component in (x, y)]
    exact = (2.0, -1.0) if nodes == 8 else (2.0 * places[0] + places[1], places[0])
    for axis in (0, 1):
        np.testing.assert_allclose(
            found.gradient(field[body.elements])[..., axis], np.broadcast_to(exact[axis], places[0].shape), atol=1e-12
        )


@pytest.fixture(params=[8, 20], ids=["hex8", "hex20"])
def model(request):
    made = Indentation(grid=Grid(across=4, down=3, around=2)).model()
    return replace(made, mesh=made_of(request.param, made.mesh))


def squeezed(model, stretch: float) -> np.ndarray:
    """Positions after a uniform stretch along y."""
    return model.mesh.nodes * np.array([1.0, stretch, 1.0])


def test_content_of_a_squeezed_slab(model):
    """phi_w = 1 - phi_0/J: with J = 0.7 and phi_0 = 0.2 the pores hold 0.5 of the reference volume."""
    x = model.mesh.nodes[:, 0]
    slab = model.mesh.parts[0]
    amount = solute_balance.content(model, slab, State(squeezed(model, 0.7), 0.0 * x, 1.0 + x[None]))
    assert amount == pytest.approx((0.7 - 0.2) * (3.0 * 2.0 * 0.25) * (1.0 + 1.5), rel=1e-12)


def test_pores_that_are_squeezed_shut_hold_nothing(model):
    x = model.mesh.nodes[:, 0]
    state = State(squeezed(model, 0.15), 0.0 * x, 1.0 + 0.0 * x[None])
    assert solute_balance.content(model, model.mesh.parts[0], state) == 0.0


def test_inflow_is_the_change_of_the_content(model):
    part, x = model.mesh.parts[0], model.mesh.nodes
    before = State(x, 0.01 * x[:, 0], np.ones((1, len(x))))
    after = State(squeezed(model, 0.8), 0.02 * x[:, 1], 1.0 - 0.1 * x[None, :, 0])
    entered = solute_balance.inflow(model, part, before, after, 3.0)
    contents = [solute_balance.content(model, part, state) for state in (before, after)]
    assert entered.sum() == pytest.approx(contents[1] - contents[0], rel=1e-12)


def test_inflow_of_steady_diffusion(model):
    """A linear profile without solvent flux: phi_w d dc/dy enters at the top and leaves at the bottom."""
    part, x = model.mesh.parts[0], model.mesh.nodes
    solute = model.materials["slab"].solutes[0]
    thermal = solute_balance.GAS_CONSTANT * solute_balance.TEMPERATURE
    ratio = solute.diffusivity / solute.free_diffusivity
    concentration = x[:, 1]
    state = State(x, -thermal * ratio * concentration, concentration[None])
    entered = solute_balance.inflow(model, part, state, state, 10.0)
    expected = 10.0 * 0.8 * solute.diffusivity * 3.0 * 0.25
    top, bottom = np.abs(x[:, 1] - 2.0) < 1e-9, np.abs(x[:, 1]) < 1e-9
    assert entered[top].sum() == pytest.approx(expected)
    assert entered[bottom].sum() == pytest.approx(-expected)
    assert np.max(np.abs(entered[~top & ~bottom])) < 1e-15


def test_initial_content_is_that_of_the_slab(model):
    concentration = np.zeros(len(model.mesh.nodes))
    concentration[model.mesh.node_sets["slab"] - 1] = CONCENTRATION
    state = State(model.mesh.nodes, 0.0 * concentration, concentration[None])
    contents = [solute_balance.content(model, part, state) for part in model.mesh.parts]
    assert contents == pytest.approx([0.8 * 3.0 * 2.0 * 0.25, 0.0])


def test_projection_on_a_line():
    line = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0]])
    found = contact_line.project(np.array([[0.25, -0.1], [0.5, 0.2], [1.5, 0.5]]), line)
    np.testing.assert_allclose(found.gap, [0.1, -0.2, 0.0], atol=1e-12)
    np.testing.assert_allclose(found.sample(np.array([0.0, 1.0, 3.0])), [0.25, 0.5, 2.0])


@pytest.mark.parametrize(("gap", "expected"), [([0.0, -0.1, 0.3], 1.25), ([0.1, 0.2, 0.3], 0.0), ([-1.0] * 3, 2.0)])
def test_half_width(gap, expected):
    assert contact_line.half_width(np.array([0.0, 1.0, 2.0]), np.array(gap)) == pytest.approx(expected)


STEP = "===== beginning time step {} : {} =====\n"
ITERATION = """
\tstep from line search         = {ls}
\tconvergence norms :     INITIAL         CURRENT         REQUIRED
\t   residual          1.0e+00    {residual}    0.0e+00
\t   energy            1.0e+00    1.0e-09    1.0e-02
\t   concentration     1.0e+00    1.0e-03    1.0e-06
"""
FAILED = """
 *************************************************************************
 *                                ERROR                                  *
 * {}  *
 *************************************************************************
"""


def attempt(residuals, *, ls=1.0, error="Max nr of reformations reached."):
    text = "".join(ITERATION.format(ls=ls, residual=residual) for residual in residuals)
    return STEP.format(1, 0.5) + text + (FAILED.format(error) if error else "")


@pytest.mark.parametrize(
    ("log", "failure_mode"),
    [
        (attempt([1e-5, 5e-9] * 10), FailureMode.CHATTER),
        (attempt([1e-9] * 20, ls=0.06), FailureMode.SEARCH),
        (attempt([10.0**k for k in range(12)]), FailureMode.DIVERGES),
        (attempt([1e-3 / k for k in range(1, 20)]), FailureMode.SLOW),
        (attempt([1.0, float("nan")], error="NAN detected in residual vector at index 3."), FailureMode.NAN),
        (attempt([1.0], error="2 negative jacobians detected."), FailureMode.JACOBIAN),
        (attempt([1.0], error=""), FailureMode.UNFINISHED),
        (attempt([1.0], error="") + "------- converged at time : 0.5\n", FailureMode.NONE),
    ],
)
def test_ailment_of_an_attempt(log, failure_mode):
    assert [found.failure_mode for found in diagnosis.attempts(log)] == [failure_mode]


def test_the_contacts_table_of_times_is_no_iteration():
    table = "    residual         6.123e-02   0.000e+00   6.123e-02   1.191e-03\n"
    (found,) = diagnosis.attempts(attempt([1.0, 0.5], error="") + table)
    assert found.residuals == (1.0, 0.5)


def test_summary_counts_failed_attempts_and_names_the_unmet_norm():
    converged = attempt([1.0], error="") + "------- converged at time : 0.5\n"
    text = diagnosis.summary(converged + attempt([1e-9] * 20, ls=0.06))
    assert text == "line search stalls x 1; the last, to t = 0.5 s: line search stalls (unmet: concentration)"
    assert diagnosis.summary(converged) == "no failed attempt"


def test_a_node_off_the_other_body_has_to_be_at_ambient():
    model = Indentation().model()
    lines, n = measures.contact_lines(model), len(model.mesh.nodes)
    empty = State(model.mesh.nodes, np.zeros(n), np.zeros((1, n)))
    assert measures.not_at_ambient(empty, lines) == 0
    outermost = lines[0][-1]
    apart = State(model.mesh.nodes, np.zeros(n), np.eye(n)[[outermost]])
    assert measures.not_at_ambient(apart, lines) == 1


def test_means_over_the_contact_are_of_what_is_closed():
    model = Indentation().model()
    lines, n = measures.contact_lines(model), len(model.mesh.nodes)
    slab, cylinder = lines
    closed = np.zeros(n)
    closed[slab[:1]] = closed[cylinder[:1]] = 1.0
    gap, jump = measures.mean_gap_and_jump(State(model.mesh.nodes, closed, closed[None]), lines)
    assert (gap, jump) == (pytest.approx(0.0, abs=1e-12), pytest.approx(0.0, abs=1e-12))
    lowered = model.mesh.nodes - 0.1 * np.isin(np.arange(n), slab)[:, None] * [0.0, 1.0, 0.0]
    gap, jump = measures.mean_gap_and_jump(State(lowered, closed, (closed + closed * lowered[:, 1])[None]), lines)
    assert gap == pytest.approx(0.1, rel=1e-3)
    assert jump == pytest.approx(-0.1)
