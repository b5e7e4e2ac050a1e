"""Ties are exact for linear fields on meshes that do not match, and of the order of the elements for others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes.harmonic import Harmonic
from scenes.harmonic_errors import errors
from scenes.nonmatching import PATCHES, QUADRATIC_PATCHES, STEADY
from scenes.tied_patches import exact, tied

from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Param

pytestmark = pytest.mark.mixture_only

EXACT = {
    "augmented": ContactSettings(laugon="AUGLAG", tolerance=1e-9, maxaug=12),
    "multipliers": ContactSettings(laugon="LAGMULT"),
}
UNSEARCHED = replace(STEADY, solver=(Param("lstol", 0.0),))
"""FEBio's line search compares energies, which are rounding where a step of 1e12 diffusion times has converged."""
JOINTS = PATCHES | QUADRATIC_PATCHES


@pytest.mark.parametrize("settings", EXACT.values(), ids=EXACT)
@pytest.mark.parametrize("name", JOINTS)
def test_linear_fields_are_exact_in_tension_and_shear(runner, name, settings):
    slug = "".join(letter if letter.isalnum() else "-" for letter in name)
    model = replace(tied(JOINTS[name], settings), name=f"tied-{slug}-{settings.laugon}", control=UNSEARCHED)
    result = runner(model)
    for field, value in exact(model.mesh.nodes).items():
        assert np.abs(result.nodes[field][-1] - value).max() <= 1e-10 * np.abs(value).max(), field


@pytest.mark.parametrize(
    ("nodes", "levels", "order"),
    [
        (8, (2, 4), 1.95),
        pytest.param(20, (2, 3), 2.85, marks=pytest.mark.slow),
        pytest.param(10, (2, 4), 2.5, marks=pytest.mark.slow),
    ],
)
def test_displacement_and_concentration_converge_with_the_order_of_the_elements(runner, nodes, levels, order):
    # The strain is 1e-6: 1e-7 of that is still a thousand times the rounding of positions.
    control = replace(STEADY, displacement_tolerance=1e-7)
    models = (Harmonic(level, nodes, None, InterfaceType.TIED, f"tied-{nodes}-{level}").model() for level in levels)
    coarse, fine = (errors(runner(replace(model, control=control))) for model in models)
    for name, error in coarse.items():
        assert np.log(error / fine[name]) / np.log(levels[1] / levels[0]) >= order, name
