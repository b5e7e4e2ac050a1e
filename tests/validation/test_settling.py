"""Nodes that open and close within an iteration, as its matrix answers that they would pull and overlap."""

from __future__ import annotations

from pathlib import Path

import febio_runs
import numpy as np
import pytest

from harness.run import engine, logdata
from harness.run.febio_log import Report
from studies.linear_solvers.command import write
from studies.models.ball_in_socket import BallInSocket
from studies.pages.linear_solver_results import Solver

pytestmark = pytest.mark.mixture_only

LARGE_STEPS = BallInSocket(elements=6, steps=4)
"""In each of them many nodes overlap at first of which half are in contact at its end."""
ASKED, NOT_ASKED = Solver("pardiso"), Solver("mkl_dss")
"""A linear solver whose matrix has loads for unknowns, so that it answers with them, and one whose has not."""
SOLUTION = 2e-3
"""Of the largest displacement: FEBio accepts a step whose last increment is 1e-3 of its displacements, and each of two
runs may be off by that."""


def _run(scene: BallInSocket, solver: Solver, folder: Path) -> tuple[Report, np.ndarray]:
    """Report, and displacements at the end."""
    model = scene.model()
    path = write(model.text(), solver, folder / solver.type)
    report = febio_runs.run(path, plugin=engine.required_plugin(), check=False).report
    assert report.normal, report.errors
    history = logdata.read_history(path.parent / model.node_file, model.node_columns)
    return report, logdata.at_the_end(history, ("ux", "uy", "uz"))


def test_large_steps_take_fewer_iterations_to_the_same_state(runner, tmp_path):
    asked, found = _run(LARGE_STEPS, ASKED, tmp_path)
    not_asked, reference = _run(LARGE_STEPS, NOT_ASKED, tmp_path)
    assert asked.iterations < not_asked.iterations
    assert asked.retries <= not_asked.retries
    assert np.abs(found - reference).max() <= SOLUTION * np.abs(reference).max()
