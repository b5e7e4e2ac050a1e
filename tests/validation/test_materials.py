"""Bodies of different material on the two sides of the contact."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from harness.closed_forms import transient_diffusion
from harness.models import composite, layers
from harness.models.diffusion import MATERIAL, Diffusion
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Control, Solute
from harness.post import compare
from harness.validate import checks

SHORT = Control(100, 20.0)
FAST = Solute(2, 1e-3, 1e-3, 0.6)
SLOW = Solute(1, 5e-4, 5e-4, 1.0)


def test_composite_slab(context):
    assert compare.missed(checks.composite_layers(context)) == []


def test_two_layer_convection(context):
    assert compare.missed(checks.convection_layers(context)) == []


def test_confined_creep_across_a_cut(context):
    assert compare.missed(checks.confined_creep(context)) == []


def test_the_actual_concentration_jumps_by_the_ratio_of_solubilities(context):
    """Steady flux through two layers: c~ is continuous, c = kappa~ c~ is not, and the solute flux is one."""
    run = context.runner(layers.Layers(context.interface).model())
    assert compare.jump(run, "c1", checks.PAIR) < 1e-4
    state, n = run.elements, layers.Layers().elements
    actual, flux = state.values[-1, :, 1], state.values[-1, :, 2]
    towards, beyond = (1.5 * actual[n - 1] - 0.5 * actual[n - 2], 1.5 * actual[n] - 0.5 * actual[n + 1])
    assert beyond / towards == pytest.approx(layers.SECOND.solubility / layers.FIRST.solubility, rel=2e-3)
    assert np.ptp(flux) / flux.mean() < 1e-4


def test_a_finite_penalty_between_unlike_layers_leaves_the_jump_it_should(context):
    """j/eps with the flux of the closed form for a finite conductance."""
    conductance = 1e-3
    settings = ContactSettings(
        laugon="PENALTY", auto_penalty=False, penalty=1e6, pressure_penalty=1.0, concentration_penalty=conductance
    )
    run = context.runner(layers.Layers(context.interface, settings, name="layers-leak").model())
    given = replace(layers.GIVEN, conductance=conductance)
    jump = layers.two_layer_convection.solute_flux(layers.FIRST, layers.SECOND, given) / conductance
    assert compare.jump(run, "c1", checks.PAIR) == pytest.approx(jump, rel=0.01)
    exact = layers.two_layer_convection.concentration(run.model.mesh.nodes[:, 2], layers.FIRST, layers.SECOND, given)
    lower = run.model.mesh.nodes[:, 2] < layers.FIRST.thickness - 1e-9
    assert np.max(np.abs(run.nodes["c1"][-1] - exact)[lower]) < 1e-3


def test_a_partition_jump_in_a_transient_with_a_finite_conductance(context):
    """The composite slab with a penalty of 5e-4 mm/s, against its closed form."""
    settings = ContactSettings(
        laugon="PENALTY", auto_penalty=False, penalty=1e6, pressure_penalty=1.0, concentration_penalty=5e-4
    )
    model = composite.Composite(context.interface, settings, control=Control(100, 10.0), name="composite-leak").model()
    run = context.runner(model)
    z = model.mesh.nodes[:, 2]
    upper = np.isin(np.arange(1, len(z) + 1), model.mesh.parts[1].elements)
    place = np.where(upper, np.maximum(z, composite.FIRST.thickness * (1 + 1e-12)), z)
    exact = composite.composite_slab.concentration(place, 1000.0, composite.FIRST, composite.SECOND, 5e-4)
    assert compare.error_at(run, "c1", exact, 1000.0) < 5e-3


@pytest.mark.mixture_only
@pytest.mark.parametrize("order", [(SLOW, FAST), (FAST, SLOW)])
def test_two_solutes_in_any_order_on_either_side(context, order):
    lower, upper = replace(MATERIAL, solutes=(SLOW, FAST)), replace(MATERIAL, solutes=order)
    data = {
        "control": SHORT,
        "elements": 8,
        "lower": lower,
        "upper": upper,
        "ambient": (1.0, 0.5),
        "module": "multiphasic",
    }
    split = context.runner(Diffusion(context.interface, name="two-solutes", **data).model())
    reference = context.runner(Diffusion(InterfaceType.CONFORMING, name="two-solutes-conforming", **data).model())
    for column in ("c1", "c2"):
        assert compare.largest_difference(split, reference, column) <= 1e-6


@pytest.mark.mixture_only
def test_a_solute_that_the_other_body_lacks_stays_on_its_side(context):
    """The upper cube has no second solute: for that one the lower cube is impermeable at the contact."""
    lower, upper = replace(MATERIAL, solutes=(SLOW, FAST)), replace(MATERIAL, solutes=(SLOW,))
    model = Diffusion(
        context.interface,
        control=SHORT,
        elements=8,
        lower=lower,
        upper=upper,
        ambient=(1.0, 0.5),
        module="multiphasic",
        name="lacking",
    ).model()
    run = context.runner(model)
    assert _error_of_an_impermeable_cube(run, "c2", FAST.diffusivity, ambient=0.5) < 5e-3
    assert compare.jump(run, "c1", checks.PAIR) < 1e-5


@pytest.mark.mixture_only
def test_a_biphasic_body_is_impermeable_to_the_solute(context):
    upper = replace(MATERIAL, solutes=())
    model = Diffusion(context.interface, control=SHORT, elements=8, upper=upper, name="biphasic-upper").model()
    run = context.runner(model)
    assert _error_of_an_impermeable_cube(run, "c1", SLOW.diffusivity, ambient=1.0) < 5e-3
    assert compare.jump(run, "p", checks.PAIR) < 1e-8


def _error_of_an_impermeable_cube(run, column, diffusivity, ambient):
    """Error of the lower cube against diffusion into 1 mm with an impermeable face at the contact, t = 2000 s."""
    mesh = run.model.mesh
    ids = np.unique(mesh.parts[0].elements) - 1
    z = mesh.nodes[ids, 2] + 0.5
    exact = ambient * transient_diffusion.concentration(z, 2000.0, height=1.0, diffusivity=diffusivity)
    return float(np.max(np.abs(run.nodes[column][-1, ids] - exact)))
