"""Solvers other than full Newton, and steps that are cut back: a run ends, with the result of the plain one."""

from __future__ import annotations

from pathlib import Path

import febio_runs
import numpy as np
import pytest

from harness.run import engine, logdata

MODELS = Path(__file__).parent / "models"
COLUMNS = ("x", "y", "z", "ux", "uy", "uz")

pytestmark = pytest.mark.mixture_only


@pytest.fixture
def blocks(runner, tmp_path):
    """Displacements of two blocks, one pressed into the other by 0.05 mm, after an edit of the model's text."""

    def run(name, *edits):
        text = (MODELS / "two-blocks.feb").read_text()
        for old, new in edits:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / name / "model.feb"
        path.parent.mkdir()
        path.write_text(text)
        finished = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
        assert finished.report.normal, finished.report.errors
        return logdata.read_history(path.parent / "nodes.dat", COLUMNS)["uz"][-1]

    return run


NEWTON = ('type="CG-solid"', 'type="solid"')
FACTOR = (
    'type="sliding-mixture"/>',
    'type="sliding-mixture"><auto_penalty>1</auto_penalty><penalty>10</penalty></contact>',
)


def test_conjugate_gradients_find_what_newton_finds(blocks):
    found, expected = blocks("cg", FACTOR), blocks("newton", FACTOR, NEWTON)
    # CG's displacement tolerance is 1e-6 of an increment, of which there are some hundred.
    np.testing.assert_allclose(found, expected, atol=1e-4 * 0.05)


def test_conjugate_gradients_bear_the_default_penalty(blocks):
    np.testing.assert_allclose(blocks("cg-default"), blocks("cg-10", FACTOR), atol=0)


def test_explicit_dynamics_come_near_equilibrium(blocks):
    steps = ("<time_steps>4</time_steps><step_size>1<", "<time_steps>400</time_steps><step_size>0.01<")
    dynamic = (("CG-solid", "explicit-solid"), ("STATIC", "DYNAMIC"), steps)
    found, expected = blocks("explicit", *dynamic), blocks("newton", NEWTON)
    # Waves cross the blocks thrice while the load rises: what is asked for is contact that bears.
    assert np.max(np.abs(found - expected)) < 0.3 * 0.05
    assert np.min(found[18:27]) < -0.01


def test_newton_without_a_jacobian_finds_what_newton_finds(blocks):
    solver = '<solver type="CG-solid"></solver>'
    jfnk = '<solver type="solid"><qn_method type="JFNK"/><linear_solver type="fgmres"/></solver>'
    expected = blocks("newton", FACTOR, NEWTON)
    # FEBio's tolerance on the change of a step is 1e-3.
    np.testing.assert_allclose(blocks("jfnk", FACTOR, (solver, jfnk)), expected, atol=1e-3 * 0.05)


def test_multipliers_need_a_matrix(runner, tmp_path):
    path = tmp_path / "model.feb"
    text = (MODELS / "two-blocks.feb").read_text()
    path.write_text(text.replace(FACTOR[0], 'type="sliding-mixture"><laugon>LAGMULT</laugon></contact>'))
    finished = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
    assert not finished.report.normal
    assert "CG-solid" in " ".join(finished.report.errors)


def test_a_step_in_which_overlap_was_first_found_is_cut_back(runner, tmp_path):
    """Two reformations do not suffice for a step that gains nodes of the other surface: each is tried again shorter."""
    path = tmp_path / "model.feb"
    path.write_text((MODELS / "blunt-corner.feb").read_text())
    finished = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
    assert finished.report.retries >= 10
    assert "Max nr of reformations" in " ".join(finished.report.errors)
    assert "Segmentation" not in finished.output
    path.write_text(path.read_text().replace("<max_refs>2<", "<max_refs>3<"))
    assert febio_runs.run(path, plugin=engine.required_plugin(), check=False).report.normal
