"""Multipliers as unknowns of the Newton solve: no gap, no jump, and no more iterations than an uncut body."""

from __future__ import annotations

import numpy as np
import pytest

from harness import compare
from harness.models.confined import Confined
from harness.models.convection import Convection
from harness.models.diffusion import Diffusion
from harness.models.interface import ContactSettings, Join
from harness.models.mesh import Section
from harness.models.parts import Control

LAGMULT = ContactSettings(laugon="LAGMULT")
STRICT = Control(
    40,
    50.0,
    displacement_tolerance=1e-6,
    energy_tolerance=1e-8,
    pressure_tolerance=1e-6,
    concentration_tolerance=1e-6,
)
"""So strict that what Newton leaves does not matter."""
BAR = 1e-8

pytestmark = pytest.mark.mixture_only


def _agree(cut, whole, columns):
    for column in columns:
        assert compare.largest_difference(cut, whole, column) <= BAR * np.abs(whole.nodes[column]).max(), column
    assert cut.report.iterations <= 1.05 * whole.report.iterations
    assert cut.report.retries == 0


@pytest.mark.parametrize("module", ["solute", "multiphasic"])
def test_diffusion_is_that_of_the_whole_body(context, module):
    data = {"elements": 10, "control": STRICT, "section": Section((1.0, 1.0), (2, 2)), "module": module}
    cut = context.runner(Diffusion(context.join, LAGMULT, name="multipliers-diffusion", **data).model())
    whole = context.runner(Diffusion(Join.UNSPLIT, name="multipliers-diffusion-whole", **data).model())
    _agree(cut, whole, ("uz", "p", "c1"))


@pytest.mark.parametrize("peclet", [0, 10])
def test_convection_is_that_of_the_whole_body(context, peclet):
    data = {"elements": 10, "control": STRICT, "peclet": peclet}
    cut = context.runner(Convection(context.join, LAGMULT, name="multipliers-convection", **data).model())
    whole = context.runner(Convection(Join.UNSPLIT, name="multipliers-convection-whole", **data).model())
    _agree(cut, whole, ("uz", "p", "c1"))


def test_creep_in_the_biphasic_module_is_that_of_the_whole_body(context):
    data = {"elements": 10, "control": STRICT}
    cut = context.runner(Confined(context.join, LAGMULT, name="multipliers-creep", **data).model())
    whole = context.runner(Confined(Join.UNSPLIT, name="multipliers-creep-whole", **data).model())
    assert compare.largest_difference(cut, whole, "p") <= BAR * np.abs(whole.nodes["p"]).max()
    assert cut.report.iterations <= 1.05 * whole.report.iterations
