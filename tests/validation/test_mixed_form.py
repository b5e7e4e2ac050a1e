"""Loads at nodes as unknowns of the linear solver alone: the same iterations, to other matrices."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np
import pytest

from harness.models.ball_in_socket import BallInSocket
from harness.models.interface import PREDICTOR
from harness.models.parts import Param
from harness.pages.linear_solver_results import Solver
from harness.run import engine
from harness.run.febio_log import Report
from harness.studies.linear_solvers.trials import write

pytestmark = pytest.mark.mixture_only

MIXED, PRODUCTS = Solver("pardiso"), Solver("mkl_dss")
"""A linear solver that is given loads in mixed form, and one that is not."""
EQUATIONS = re.compile(r"Nr of equations \.+ : (\d+)")
CHANGES = re.compile(r"^\s*displacement\s+\S+\s+(\S+)\s+\S+\s*$", re.MULTILINE)
"""Squared norms of the iterations' increments."""
ROUNDING = 1e-6
"""Of a squared norm over that of the step's first increment: the solvers' own rounding, times the condition of a
penalty of 1000 times the tissue's stiffness."""

SCENES: Mapping[str, BallInSocket] = {
    "elastic": BallInSocket(elements=4),
    "biphasic": BallInSocket(elements=4, porous=True, steps=5),
    "quadratic": BallInSocket(elements=4, quadratic=True, slides=False, steps=5),
    "quasi-Newton": BallInSocket(elements=4, updates=10, steps=5),
    "two passes": BallInSocket(elements=4, porous=True, steps=5, params=(Param("two_pass", 1),)),
    "augmented": BallInSocket(elements=4, steps=5, params=(Param("laugon", "AUGLAG"),)),
}


def _run(scene: BallInSocket, solver: Solver, folder) -> tuple[Report, str]:
    path = write(scene.model(), solver, folder / solver.type)
    run = engine.run(path, plugin=engine.required_plugin(), check=False)
    return run.report, path.with_suffix(".log").read_text()


def _equations(log: str) -> set[int]:
    return {int(number) for number in EQUATIONS.findall(log)}


def _changes(log: str) -> np.ndarray:
    return np.array([float(value) for value in CHANGES.findall(log)])


@pytest.mark.parametrize("name", SCENES)
def test_iterations_are_those_with_products_in_the_matrix(runner, tmp_path, name):
    (mixed, with_unknowns), (products, without) = (_run(SCENES[name], s, tmp_path) for s in (MIXED, PRODUCTS))
    assert mixed.normal, mixed.errors
    assert mixed == products
    assert min(_equations(with_unknowns)) > max(_equations(without))
    found, expected = _changes(with_unknowns), _changes(without)
    np.testing.assert_allclose(found, expected, rtol=ROUNDING, atol=ROUNDING * expected.max())


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
    (mixed, one), (products, two) = (_run(scene, s, tmp_path) for s in (MIXED, PRODUCTS))
    assert mixed.normal
    assert products.normal
    assert _equations(one) == _equations(two)
