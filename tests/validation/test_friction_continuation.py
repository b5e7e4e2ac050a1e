"""Friction in runs that are continued, cut back, on two threads, under a load curve; and models without it."""

from __future__ import annotations

import shutil
from dataclasses import replace

import febio_runs
import numpy as np
import pytest
from scenes.block_on_incline import FRICTION, PUSHED, SLOPE, STANDING, BlockOnIncline

from harness.models.interface import ContactSettings
from harness.models.parts import Curve, Param
from harness.run import engine, logdata
from harness.run.runner import Runner
from studies.hard_cases.rubbing import CASES
from studies.hard_cases.scene import Fineness, Interface
from studies.models.sheared_blocks import Kind, ShearedBlocks

pytestmark = pytest.mark.mixture_only

EQUAL = 1e-10
SLIDES = 1250.0
"""s: within the first time that the block of `_stick_slip` slides."""
MIXTURE_PENALTY = (Param("auto_penalty", True), Param("penalty", 1000.0))
"""The default penalty, given: one that nobody gives is reduced after a failed attempt."""


def _stick_slip(extra=(), times=None, reformations=25):
    """A block that sticks until 1000 s, slides until 1500 s, sticks until 2100 s, and slides again until 2600 s."""
    scene = CASES["stick-slip-stick"].scene
    scene = replace(scene, extra=(*scene.extra, *extra), times=scene.times if times is None else times)
    model = scene.model(Fineness.COARSE, Interface.MIXTURE)
    # febio4 cannot continue a run that logs data of surfaces or facets.
    control = replace(model.control, reformations=reformations)
    return replace(model, surface_columns=(), facet_columns=(), control=control)


@pytest.mark.parametrize(("steps", "phase"), [(27, "slip"), (38, "stick")])
def test_a_continued_run_keeps_its_friction(runner, tmp_path, steps, phase):
    model = replace(_stick_slip(), name=f"continued-in-{phase}", plot=True)
    whole = runner(model, options=("-dump=1", f"-dump_stride={steps}"))
    folder = shutil.copytree(whole.folder, tmp_path / "continued")
    (folder / model.node_file).unlink()
    febio_runs.restart(folder / f"{model.name}.dmp", plugin=engine.required_plugin())
    part = logdata.read_history(folder / model.node_file, model.node_columns)
    after = whole.nodes.times > part.times[0] - 1e-6
    np.testing.assert_allclose(part.times, whole.nodes.times[after])
    np.testing.assert_allclose(part.values, whole.nodes.values[after], atol=EQUAL, rtol=0.0)


def test_a_failed_attempt_leaves_no_friction_behind(runner):
    """Five reformations are too few where the block begins to slide."""
    cut_back = runner(replace(_stick_slip(MIXTURE_PENALTY, reformations=5), name="cut-back"))
    assert cut_back.report.retries >= 1
    times = tuple(cut_back.nodes.times[1:].tolist())
    straight = runner(replace(_stick_slip(MIXTURE_PENALTY, times), name="straight"))
    assert straight.report.retries == 0
    np.testing.assert_allclose(straight.nodes.times, cut_back.nodes.times, rtol=1e-8)
    np.testing.assert_allclose(straight.nodes.values, cut_back.nodes.values, atol=EQUAL, rtol=0.0)


@pytest.mark.slow
def test_two_threads_make_the_same_run(tmp_path, monkeypatch):
    """Stick, then slip. The contact adds in a fixed order; FEBio's own assembly does not, so the runs agree to rounding
    alone.
    """
    times = tuple(time for time in CASES["stick-slip-stick"].scene.times if time <= SLIDES)
    runs = []
    for threads in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        runs.append(Runner(tmp_path / threads)(_stick_slip(times=times)))
    assert runs[0].report.iterations == runs[1].report.iterations
    np.testing.assert_allclose(runs[1].nodes.values, runs[0].nodes.values, atol=EQUAL, rtol=0.0)


def test_a_load_curve_on_the_friction_coefficient(runner):
    """The block on the incline, with friction that falls to a third while it slides."""
    end = float(STANDING + PUSHED)
    curve = Curve(((0.0, FRICTION), (float(STANDING), FRICTION), (end, FRICTION / 3.0)))
    settings = ContactSettings(extra=(Param("fric_coeff", 1.0, curve=3), Param("contact_frac", 1.0)))
    model = BlockOnIncline(settings=settings, name="falling-friction").model()
    run = runner(replace(model, curves=(*model.curves, curve)))
    base, nodes = run.model.mesh.node_sets["base"] - 1, run.nodes
    slides = nodes.times > STANDING + 1.5
    along, weight = (np.abs(nodes[column][slides][:, base].sum(axis=1)) for column in ("Rx", "Rz"))
    mu = np.interp(nodes.times, *zip(*curve.points, strict=True))
    exact = (SLOPE + mu) / (1.0 - SLOPE * mu)
    np.testing.assert_allclose(along / weight, exact[slides], atol=1e-4)


def test_a_coefficient_of_zero_is_no_friction(tmp_path):
    """Iterations, and every digit of what is logged."""
    runs = []
    for name, extra in (("absent", ()), ("zero", (Param("fric_coeff", 0.0),))):
        blocks = ShearedBlocks(Kind.BIPHASIC, settings=ContactSettings(extra=extra), name="frictionless").model()
        runs.append(Runner(tmp_path / name)(blocks))
    absent, zero = runs
    assert zero.report.iterations == absent.report.iterations
    np.testing.assert_array_equal(zero.nodes.values, absent.nodes.values)
