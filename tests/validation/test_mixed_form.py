"""Loads at nodes as unknowns of the linear solver alone: the same iterations, to other matrices."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import replace
from pathlib import Path

import febio_runs
import numpy as np
import pytest

from harness.models.parts import Param
from harness.run import engine
from harness.run.febio_log import Report
from studies.linear_solvers.command import write
from studies.models.ball_in_socket import BallInSocket
from studies.models.pieces import PREDICTOR
from studies.pages.linear_solver_results import Solver
from studies.synthetic_scenes import drawn_scenes

MODELS = Path(__file__).parent / "models"

pytestmark = pytest.mark.mixture_only

MIXED, PRODUCTS = Solver("pardiso"), Solver("mkl_dss")
"""A linear solver that is given loads in mixed form, and one that is not."""
EQUATIONS = re.compile(r"Nr of equations \.+ : (\d+)")
NORMS = re.compile(r"^\s*(residual|energy|displacement)\s+(\S+)\s+(\S+)\s+\S+\s*$", re.MULTILINE)
"""Squared, as FEBio compares them: name, first of the step and present value."""
ROUNDING = 1e-6
"""Of a squared norm over the largest: the solvers' own rounding, times the condition of a penalty of 1000 times the
tissue's stiffness."""
LEFT_BY_SWEEPS = 1e-2
"""Of an increment, at most, for what stands beside the matrix with loads in mixed form."""
ATOL = {"residual": ROUNDING, "energy": 2 * LEFT_BY_SWEEPS, "displacement": 2 * LEFT_BY_SWEEPS}
"""Of a squared norm over the largest: to first order twice as much as of what is squared."""

PIVOTS_LOST = "row operations lose pivots"
TAKEN_IN = "couplings across the contact are large"

UNASKED = Param("solver_devices", "loads_as_unknowns, row_operations, deferred_coupling, kept_matrix")
"""No matrix is asked which nodes open and close: it answers with its loads alone."""
WHOLE = Param("solver_devices", "loads_as_unknowns, row_operations, kept_matrix, active_set_prediction")
"""The matrix holds all couplings: what deferred ones leave may decide whether a kept matrix is formed again."""
SCENES: Mapping[str, BallInSocket] = {
    "elastic": BallInSocket(elements=4, params=(UNASKED,)),
    "biphasic": BallInSocket(elements=4, porous=True, steps=5),
    "quadratic": BallInSocket(elements=4, quadratic=True, slides=False, steps=5),
    "quasi-Newton, biphasic": BallInSocket(elements=4, porous=True, updates=10, steps=5, params=(WHOLE,)),
    "two passes": BallInSocket(elements=4, porous=True, steps=5, params=(Param("two_pass", 1),)),
    "ambient that rises": BallInSocket(elements=4, porous=True, steps=5, params=(Param("ambient_pressure", 0.05, 1),)),
    "augmented": BallInSocket(elements=4, steps=5, params=(Param("laugon", "AUGLAG"), UNASKED)),
}
ONE_PIVOT = ("two passes", "ambient that rises")
"""Scenes whose loads may do with one pivot: loads that face each other, and a ball that the fluid nearly lifts."""


def _run(model: str, solver: Solver, folder: Path) -> tuple[Report, str]:
    path = write(model, solver, folder / solver.type)
    run = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
    return run.report, path.with_suffix(".log").read_text()


def _equations(log: str) -> set[int]:
    return {int(number) for number in EQUATIONS.findall(log)}


def _norms(log: str) -> Mapping[str, np.ndarray]:
    """First values of residual and energy, and present ones of increments, which no rounding decides."""
    found: dict[str, list[float]] = {"residual": [], "energy": [], "displacement": []}
    for name, first, now in NORMS.findall(log):
        found[name].append(float(now if name == "displacement" else first))
    return {name: np.array(values) for name, values in found.items()}


def _assert_same_iterations(model: str, folder: Path, norms: Collection[str] = tuple(ATOL)) -> str:
    """Returns the log of the run with loads in mixed form."""
    (mixed, with_unknowns), (products, without) = (_run(model, s, folder) for s in (MIXED, PRODUCTS))
    assert mixed.normal, mixed.errors
    keeps_matrix = products.reformations < products.iterations
    if keeps_matrix and TAKEN_IN in with_unknowns:  # another one has what stood beside that
        products = replace(products, reformations=products.reformations + 1)
    assert mixed == products
    assert min(_equations(with_unknowns)) > max(_equations(without))
    found, expected = _norms(with_unknowns), _norms(without)
    for name in norms:
        values = expected[name]
        np.testing.assert_allclose(found[name], values, rtol=0, atol=ATOL[name] * values.max(), err_msg=name)
    return with_unknowns


@pytest.mark.parametrize("name", SCENES)
def test_iterations_are_those_with_products_in_the_matrix(runner, tmp_path, name):
    log = _assert_same_iterations(SCENES[name].model().text(), tmp_path)
    if name not in ONE_PIVOT:
        assert PIVOTS_LOST not in log


def test_a_body_that_contact_alone_holds_keeps_its_pivots(runner, tmp_path):
    """A disc between two blocks: its motion as a whole has no stiffness but that of the loads on it."""
    text = drawn_scenes.SCENES["stacked"].draw().text()
    ours = text.replace('type="sliding-elastic"', 'type="sliding-mixture"').replace(drawn_scenes.PENALTY, "")
    assert ours != text
    (mixed, with_unknowns), (products, without) = (_run(ours, s, tmp_path) for s in (MIXED, PRODUCTS))
    assert mixed.normal
    assert mixed == products
    assert with_unknowns.count(PIVOTS_LOST) == 1
    assert PIVOTS_LOST not in without


def test_prescribed_increments_of_nodes_in_contact_count_as_they_do_with_products(runner, tmp_path):
    text = (MODELS / "two-blocks.feb").read_text()
    pushed = '<bc node_set="edge" type="prescribed displacement"><dof>z</dof><value lc="1">-0.06</value></bc>'
    for old, new in (
        ('<solver type="CG-solid">', '<solver type="solid">'),
        ('<NodeSet name="bot_bot">', '<NodeSet name="edge">28,31,34</NodeSet><NodeSet name="bot_bot">'),
        ("</Boundary>", pushed + "</Boundary>"),
    ):
        assert old in text
        text = text.replace(old, new)
    _assert_same_iterations(text, tmp_path)


def test_a_matrix_of_symmetric_structure_holds_products(runner, tmp_path):
    text = BallInSocket(elements=4, steps=2, slides=False).model().text()
    tag = "<symmetric_stiffness>{}</symmetric_stiffness>"
    structure = text.replace(tag.format("non-symmetric"), tag.format("symmetric structure"))
    assert structure != text
    (mixed, one), (products, two) = (_run(each, MIXED, tmp_path / str(n)) for n, each in enumerate((text, structure)))
    assert mixed == products
    assert min(_equations(one)) > max(_equations(two))


@pytest.mark.parametrize(
    "params",
    [
        pytest.param((Param("fric_coeff", 0.1),), id="friction"),
        pytest.param((Param("symmetric_stiffness", 1),), id="symmetric"),
        pytest.param((PREDICTOR,), id="predictor"),
    ],
)
def test_there_are_no_further_equations_where_loads_are_no_products(runner, tmp_path, params):
    scene = BallInSocket(elements=4, steps=2, slides=False, params=params)
    (mixed, one), (products, two) = (_run(scene.model().text(), s, tmp_path) for s in (MIXED, PRODUCTS))
    assert mixed.normal
    assert products.normal
    assert _equations(one) == _equations(two)
