"""A run that is interrupted and restarted, or whose step is cut back, equals the one that was not."""

from __future__ import annotations

import shutil
from dataclasses import replace

import febio_runs
import numpy as np
import pytest

from harness.models.diffusion import CLOSING, Diffusion
from harness.models.interface import PAPER, ContactSettings, InterfaceType, augmented
from harness.models.parts import Control, Curve, Param, TimeStepper, displace
from harness.run import engine, logdata
from harness.run.runner import Runner

EQUAL = 1e-10
SETTINGS = {
    "default": None,
    "two passes": ContactSettings(two_pass=True),
    "paper": PAPER,
    "augmented": augmented(PAPER, 1e-4),
    "multipliers": ContactSettings(laugon="LAGMULT"),
}


@pytest.fixture(params=SETTINGS)
def settings(request, interface):
    if request.param in ("two passes", "multipliers") and interface is not InterfaceType.MIXTURE:
        pytest.skip("FEBio's own interfaces do not run with two passes and no penalties, nor with multipliers")
    return SETTINGS[request.param]


def test_restart(context, settings, tmp_path):
    """From the archive that was written after 12 of 20 steps; FEBio needs a plot file to continue."""
    model = Diffusion(
        context.interface, settings, elements=5, control=Control(20, 50.0), name="restart", plot=True
    ).model()
    run = context.runner(model, options=("-dump=1", "-dump_stride=12"))
    folder = shutil.copytree(run.folder, tmp_path / "continued")
    (folder / model.node_file).unlink()
    plugin = engine.required_plugin() if context.interface is InterfaceType.MIXTURE else None
    febio_runs.restart(folder / "restart.dmp", plugin=plugin)
    whole, part = run.nodes, logdata.read_history(folder / model.node_file, model.node_columns)
    np.testing.assert_allclose(part.times, whole.times[13:])
    np.testing.assert_allclose(part.values, whole.values[13:], atol=EQUAL, rtol=0.0)


def _with_lasting_penalty(interface, settings):
    """An automatic penalty would give way after a failed attempt: the same, given."""
    if interface is not InterfaceType.MIXTURE:
        return settings
    settings = settings or ContactSettings()
    if settings.penalty is not None or settings.laugon == "LAGMULT":
        return settings
    return replace(settings, auto_penalty=True, penalty=100.0 if settings.two_pass else 1000.0)


def _spiked(interface, settings, stepper, times=None):
    """Problem 3.1 with a displacement that no step can reach at t = 100 s, and is harmless before and after.

    With `times` the steps end there, and the spike is passed over.
    """
    spike = Curve(((0.0, 1.0), (99.0, 1.0), (100.0, 1500.0), (101.0, 1.0)))
    curves = (spike,) if times is None else (spike, Curve(tuple((float(t), 20.0) for t in times), "STEP"))
    # An attempt after a failed one starts where the step does, not ahead. What Newton's method leaves, 4e-10 where
    # FEBio takes a residual of 1e-20 for zero, is to be below EQUAL.
    solver = (Param("min_residual", 1e-28),)
    control = Control(10, 20.0, concentration_tolerance=1e-6, stepper=stepper, solver=solver)
    model = Diffusion(
        interface, _with_lasting_penalty(interface, settings), elements=5, control=control, name="cutback"
    ).model()
    conditions = tuple(
        displace("top", "z", -CLOSING, 1) if condition.kind == "prescribed displacement" else condition
        for condition in model.conditions
    )
    return replace(model, conditions=conditions, curves=curves)


def test_cutback(context, settings):
    """The failed attempt moves the bodies far into each other; nothing of that may stay."""
    cut_back = context.runner(
        _spiked(context.interface, settings, TimeStepper(20.0, optimal_iterations=10**6, aggressive=True))
    )
    assert cut_back.report.retries >= 1
    times = cut_back.nodes.times
    straight = context.runner(
        _spiked(
            context.interface, settings, TimeStepper(0.0, optimal_iterations=10**6, must_points=2, force=True), times
        )
    )
    assert straight.report.retries == 0
    np.testing.assert_allclose(straight.nodes.times, times, rtol=1e-8)
    np.testing.assert_allclose(straight.nodes.values, cut_back.nodes.values, atol=EQUAL, rtol=0.0)


def test_a_second_run_is_the_same_run(context, settings, tmp_path):
    """Bit for bit, as far as FEBio writes: nothing depends on what memory held before."""
    model = Diffusion(context.interface, settings, elements=5, control=Control(10, 50.0), name="again").model()
    first = context.runner(model)
    plugin = engine.required_plugin() if context.interface is InterfaceType.MIXTURE else None
    febio_runs.run(model.write(tmp_path), plugin=plugin)
    again = logdata.read_history(tmp_path / model.node_file, model.node_columns)
    np.testing.assert_array_equal(again.values, first.nodes.values)


def test_two_threads_make_the_same_run(context, settings, tmp_path, monkeypatch):
    """The contact adds in a fixed order; FEBio's own assembly does not, so the whole run agrees to rounding alone."""
    model = Diffusion(context.interface, settings, elements=5, control=Control(10, 50.0), name="again").model()
    runs = []
    for threads in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        runs.append(Runner(tmp_path / threads)(model))
    assert runs[0].report.iterations == runs[1].report.iterations
    np.testing.assert_allclose(runs[1].nodes.values, runs[0].nodes.values, atol=EQUAL, rtol=0.0)
