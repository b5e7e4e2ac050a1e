"""Problems 3.1 and 3.2 of Ateshian, Maas and Weiss (2012) against closed forms and against the conforming reference."""

from __future__ import annotations

import numpy as np
import pytest

from harness.models.diffusion import Diffusion
from harness.models.interface import PAPER, ContactSettings, InterfaceType
from harness.models.mesh import Section
from harness.models.parts import Control, Param
from harness.post import compare
from harness.validate import checks

SHORT = Control(
    40,
    50.0,
    displacement_tolerance=1e-6,
    energy_tolerance=1e-8,
    pressure_tolerance=1e-6,
    concentration_tolerance=1e-6,
)
"""So strict that what Newton leaves does not matter."""
OPTIONS = {
    "defaults": ContactSettings(),
    "two passes": ContactSettings(two_pass=True),
    "augmented": ContactSettings(laugon="AUGLAG"),
    "two passes, augmented": ContactSettings(laugon="AUGLAG", two_pass=True),
    "symmetric": ContactSettings(extra=(Param("symmetric_stiffness", True),)),
    "updated": ContactSettings(update_penalty=True),
}


def test_diffusion_is_that_of_the_conforming_reference_in_as_many_iterations(context):
    assert compare.missed(checks.diffusion_against_reference(context)) == []


def test_diffusion_follows_the_closed_form_as_well_as_the_conforming_reference(context):
    assert compare.missed(checks.diffusion_against_closed_form(context)) == []


@pytest.mark.parametrize("peclet", [*(pytest.param(k, marks=pytest.mark.slow) for k in (0, 1)), 10])
def test_convection_follows_the_closed_form_as_well_as_the_conforming_reference(context, peclet):
    assert compare.missed(checks.convection_against_closed_form(context, [peclet])) == []


def test_a_penalty_leaks_what_its_value_says(context):
    assert compare.missed(checks.leak_of_a_penalty(context)) == []


@pytest.mark.parametrize("module", ["solute", "multiphasic"])
def test_steps_that_go_on_as_predicted_end_with_their_first_iteration(runner, module):
    """A diffusion takes two iterations in each step, and one where it is predicted, as most of it is. No step takes
    more than one evaluation of the residual for an iteration and one for itself, and two to compare a predicted state
    with the plain start. What is left out changes the ninth digit.
    """
    control = Control(40, 50.0)
    settings = {on: ContactSettings(extra=(Param("predictor", on),)) for on in (False, True)}
    plain, ahead = (
        runner(Diffusion(settings=settings[on], module=module, control=control).model()) for on in (False, True)
    )
    assert plain.report.residuals == plain.report.iterations + plain.report.steps
    assert ahead.report.residuals <= ahead.report.iterations + 3 * ahead.report.steps
    assert plain.report.iterations == 2 * plain.report.steps
    assert ahead.report.iterations <= 1.4 * ahead.report.steps
    assert np.max(np.abs(plain.nodes["c1"] - ahead.nodes["c1"])) <= 1e-8 * np.max(plain.nodes["c1"])


@pytest.mark.parametrize("penalty", [1e-4, 4e-4, 4e-3])
def test_the_leak_follows_the_penalty(context, penalty):
    settings = ContactSettings(
        laugon="PENALTY", auto_penalty=False, penalty=1400.0, pressure_penalty=1e-3, concentration_penalty=penalty
    )
    model = checks.convection.Convection(
        context.interface, settings, elements=4, control=Control(20, 2000.0), name="leak", peclet=0
    ).model()
    jump = compare.jump(context.runner(model), "c1", checks.PAIR)
    assert jump == pytest.approx(checks.expected_leak(settings), rel=0.01)


@pytest.mark.mixture_only
def test_augmentation_closes_the_jump_at_a_bounded_cost(context):
    assert compare.missed(checks.augmentation(context)) == []


def test_orders_of_convergence_across_the_contact(context):
    assert compare.missed(checks.orders(context)) == []


@pytest.mark.mixture_only
@pytest.mark.parametrize("option", OPTIONS)
@pytest.mark.parametrize("module", ["solute", "multiphasic"])
def test_the_split_body_is_its_reference_whatever_the_options(context, module, option):
    """Short runs with 2 x 2 facets in both modules.

    Closing the contact in one step presses the fluid up; there the pressure sees that the contact gives, by 1/factor of
    what the elements beside it do. The concentration jumps by 1/factor of its drop over them, of another factor.
    """
    stiffness, conductance = (1e2, 1e3) if option.startswith("two passes") else (1e3, 1e5)
    data = {"elements": 10, "control": SHORT, "section": Section((1.0, 1.0), (2, 2)), "module": module}
    split = context.runner(Diffusion(context.interface, OPTIONS[option], name="diffusion-short", **data).model())
    reference = context.runner(Diffusion(InterfaceType.CONFORMING, name="diffusion-short-conforming", **data).model())
    assert compare.largest_difference(split, reference, "c1") <= 0.1 / conductance
    assert compare.largest_difference(split, reference, "p") <= np.abs(reference.nodes["p"]).max() / stiffness
    allowed = {"augmented": 1.25, "two passes, augmented": 1.25, "symmetric": 2.0}.get(option, 1.05)
    assert split.report.iterations <= allowed * reference.report.iterations


@pytest.mark.mixture_only
def test_the_papers_penalties_leave_the_transient_open_without_augmentation(context):
    """So that the test of augmentation above has something to close."""
    run = context.runner(Diffusion(context.interface, PAPER, elements=10, control=SHORT, name="diffusion-open").model())
    below, above = compare.facing(run.model.mesh, checks.PAIR)
    history = run.nodes["c1"]
    assert abs(history[:, below - 1] - history[:, above - 1]).max() > 0.1
