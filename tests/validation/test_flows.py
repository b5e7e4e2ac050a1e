"""What passes over the contact: equal and opposite on the two sides, and as much as the bodies lose and gain."""

from __future__ import annotations

import febio_runs
import numpy as np
import pytest

from harness.models import convection
from harness.models.convection import Convection
from harness.models.diffusion import AMBIENT, CLOSING, Diffusion
from harness.models.interface import PAPER, ContactSettings, InterfaceType, augmented
from harness.models.mesh import Section
from harness.models.parts import Control
from harness.run import engine, logdata

pytestmark = pytest.mark.mixture_only
LOGGED = ("contact_force.x", "contact_force.y", "contact_force.z", "contact solvent flow", "contact solute flow 1")
SURFACES = ("lower-top", "upper-bottom")
OPTIONS = {"defaults": None, "two passes": ContactSettings(two_pass=True), "augmented": augmented(PAPER, 1e-4)}


@pytest.fixture
def run(runner, tmp_path):
    """Runs a model and reads its nodes and the loads of both surfaces, each of shape (n_times, n_logged)."""

    def run_with_flows(model):
        path = model.write(tmp_path)
        lines = "".join(
            f'<surface_data surface="{name}" data="{";".join(LOGGED)}" file="{name}.txt" delim=" "/>'
            for name in SURFACES
        )
        path.write_text(path.read_text().replace("</logfile>", f"{lines}</logfile>"))
        febio_runs.run(path, plugin=engine.required_plugin())
        loads = [logdata.read_history(tmp_path / f"{name}.txt", LOGGED).values[:, 0] for name in SURFACES]
        return logdata.read_history(tmp_path / model.node_file, model.node_columns), *loads

    return run_with_flows


@pytest.mark.parametrize("option", OPTIONS)
def test_both_sides_receive_the_same_with_opposite_sign(run, option):
    model = Diffusion(
        InterfaceType.MIXTURE,
        OPTIONS[option],
        elements=6,
        control=Control(10, 100.0),
        section=Section((1.0, 1.0), (2, 2)),
    ).model()
    _, below, above = run(model)
    size = np.abs(below).max(axis=0)
    assert np.all(size[2:] > 0.0)
    np.testing.assert_allclose(below[:, 2:], -above[:, 2:], atol=1e-12 * size[2:].min(), rtol=1e-12)
    assert np.abs(below[:, :2] + above[:, :2]).max() <= 1e-12 * size[2]


def test_what_passes_is_what_the_closed_form_says(run):
    """3.2 at Pe = 1: w0 = k (p_u - p_d)/h, and j = c_u w0/(1 - e^{-Pe}), over 1 mm^2."""
    model = Convection(InterfaceType.MIXTURE, control=Control(10, 2000.0)).model()
    _, below, above = run(model)
    solvent = convection.PERMEABILITY * convection.PRESSURES[1] / 2.0
    solute = solvent * convection.UPSTREAM / -np.expm1(-1.0)
    np.testing.assert_allclose(np.abs(below[-1, 3:]), [solvent, solute], rtol=2e-3)
    np.testing.assert_allclose(np.abs(above[-1, 3:]), [solvent, solute], rtol=2e-3)


def test_the_upper_cube_gains_what_passes(run):
    """Content of the upper cube, INT phi_w c dV, against the flow summed over the steps (backward Euler)."""
    step = 100.0
    model = Diffusion(InterfaceType.MIXTURE, elements=10, control=Control(20, step)).model()
    history, below, _ = run(model)
    upper = model.mesh.parts[1].elements - 1
    z, c = history["z"][:, upper], history["c1"][:, upper]
    height = z[:, :, 4:].mean(axis=2) - z[:, :, :4].mean(axis=2)
    stretch = height / height[0]
    content = ((0.8 - 1.0 + stretch) * height[0] * c.mean(axis=2)).sum(axis=1)
    gained = np.abs(below[1:, 4]).cumsum() * step
    assert content[-1] > 0.1 * AMBIENT
    np.testing.assert_allclose(gained, content[1:], rtol=2 * CLOSING, atol=1e-6)
