"""Multipliers as unknowns of the Newton solve: no gap, no jump, and no more iterations than a conforming reference."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import pairs

from harness.models.confined import Confined
from harness.models.convection import Convection
from harness.models.diffusion import Diffusion
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.mesh import Section
from harness.models.parts import Control
from harness.post import compare
from studies.models.sheared_blocks import Kind

LAGMULT = ContactSettings(laugon="LAGMULT")
STRICT = Control(
    20,
    50.0,
    displacement_tolerance=1e-6,
    energy_tolerance=1e-8,
    pressure_tolerance=1e-6,
    concentration_tolerance=1e-6,
)
"""So strict that what Newton leaves does not matter."""
BAR = 1e-8

pytestmark = pytest.mark.mixture_only


def _agree(split, reference, columns):
    for column in columns:
        assert compare.largest_difference(split, reference, column) <= BAR * np.abs(reference.nodes[column]).max(), (
            column
        )
    assert split.report.iterations <= 1.05 * reference.report.iterations
    assert split.report.retries == 0


@pytest.mark.parametrize("module", ["solute", "multiphasic"])
def test_diffusion_is_that_of_the_conforming_reference(context, module):
    data = {"elements": 10, "control": STRICT, "section": Section((1.0, 1.0), (2, 2)), "module": module}
    split = context.runner(Diffusion(context.interface, LAGMULT, name="multipliers-diffusion", **data).model())
    reference = context.runner(
        Diffusion(InterfaceType.CONFORMING, name="multipliers-diffusion-conforming", **data).model()
    )
    _agree(split, reference, ("uz", "p", "c1"))


@pytest.mark.parametrize("peclet", [0, 10])
def test_convection_is_that_of_the_conforming_reference(context, peclet):
    data = {"elements": 10, "control": STRICT, "peclet": peclet}
    split = context.runner(Convection(context.interface, LAGMULT, name="multipliers-convection", **data).model())
    reference = context.runner(
        Convection(InterfaceType.CONFORMING, name="multipliers-convection-conforming", **data).model()
    )
    _agree(split, reference, ("uz", "p", "c1"))


def test_creep_in_the_biphasic_module_is_that_of_the_conforming_reference(context):
    data = {"elements": 10, "control": STRICT}
    split = context.runner(Confined(context.interface, LAGMULT, name="multipliers-creep", **data).model())
    reference = context.runner(Confined(InterfaceType.CONFORMING, name="multipliers-creep-conforming", **data).model())
    assert compare.largest_difference(split, reference, "p") <= BAR * np.abs(reference.nodes["p"]).max()
    assert split.report.iterations <= 1.05 * reference.report.iterations


@pytest.mark.parametrize("primary", ["lower", "upper"])
@pytest.mark.parametrize("upper", [Kind.ELASTIC, Kind.RIGID])
def test_bodies_of_the_module_solid_are_those_of_a_converged_augmentation(runner, upper, primary):
    pair = pairs.of_kinds(Kind.ELASTIC, upper, primary)
    assert pair.module == "solid"
    augmented = ContactSettings(laugon="AUGLAG", tolerance=1e-9, maxaug=20)
    one, other = (
        runner(replace(pair, settings=settings, name=f"{settings.laugon}-{pair.name}").model())
        for settings in (LAGMULT, augmented)
    )
    assert compare.largest_difference(one, other, "uz") <= BAR * np.abs(other.nodes["uz"]).max()
    assert one.report.iterations < other.report.iterations


@pytest.mark.parametrize("primary", ["lower", "upper"])
def test_a_free_rigid_body_under_a_force_goes_where_that_force_is_needed(runner, primary):
    moved = replace(pairs.of_kinds(Kind.ELASTIC, Kind.RIGID, primary), settings=LAGMULT, name=f"moved-{primary}")
    reached = runner(moved.model())
    force = float(reached.surface("lower-top")["contact_force.z"][-1].item())
    pushed = runner(replace(moved, force=force, name=f"pushed-{primary}").model())
    assert pushed.report.retries == 0
    assert np.max(np.abs(pushed.nodes["uz"][-1] - reached.nodes["uz"][-1])) <= 1e-6 * pairs.CLOSING
    assert abs(pushed.surface("lower-top")["contact_force.z"][-1].item() / force - 1.0) <= 1e-6
