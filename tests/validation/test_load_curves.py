"""Load curves on parameters of the contact: each parameter follows one, or the model is refused before it runs."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from harness.preflight.plugin_types import PLUGIN_TYPES
from harness.preflight.rules.settings import FOLLOWED
from studies.models import small
from studies.models.small import Document, Parts, biphasic, contact, control, curve, elastic, fixed, moved

pytestmark = pytest.mark.mixture_only

RAMP = curve(1, (0, 0), (1, 1))
CONSTANT = curve(2, (0, 1), (1, 1))


def pressed(params: str, depth: float = 0.1, *, fluid: bool = False, drag: bool = False) -> Document:
    """A block on a wider one, pressed down by a depth."""
    parts = Parts()
    parts.box("low", (-0.3, -0.3, 0), (1.3, 1.3, 1), (4, 4, 2), "low")
    parts.box("up", (0, 0, 1), (1, 1, 2), (3, 3, 2), "up")
    material = biphasic if fluid else elastic
    module, analysis = ("biphasic", "TRANSIENT") if fluid else ("solid", "STATIC")
    sideways = (moved("up-top", "x", 0.2), fixed("up-top", "y")) if drag else (fixed("up-top", "x", "y"),)
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (material("low", 1, 2), material("up", 2, 1)),
        module=module,
        control=control(module, 4, 0.25, analysis=analysis),
        boundary=(fixed("low-bottom", "x", "y", "z"), moved("up-top", "z", -depth), *sideways),
        contacts=(contact("c", "pair", params=params),),
        curves=(RAMP, CONSTANT),
        surface_data={"up-bottom": "contact_force.z;friction_force.x"},
    )


def forces(folder):
    """Normal and friction force at each step."""
    return small.table(folder / "surface-up-bottom.txt")[:, 0]


@pytest.mark.parametrize("rule", ["gauss", "segments"])
def test_an_offset_that_grows_is_a_body_that_comes_nearer(solve, rule):
    params = f"<integration>{rule}</integration>"
    moved_in, _ = solve("moved", pressed(params, depth=0.01))
    grown, found = solve("grown", pressed(f"{params}<offset lc='1'>0.01</offset>", depth=0.0))
    np.testing.assert_allclose(forces(grown), forces(moved_in), rtol=1e-4)
    assert found.report.retries == 0


def test_the_part_of_the_load_on_the_solid_follows_its_curve(solve):
    """At first the fluid bears all of its load; in the end friction acts on everything."""
    rubs = "<fric_coeff>0.3</fric_coeff>"
    late = (curve(1, (0, 0), (1, 1)), curve(2, (0, 0), (0.5, 0), (0.75, 1)))
    made = [
        pressed(f"{rubs}<contact_frac{attribute}>{value}</contact_frac>", fluid=True, drag=True)
        for attribute, value in (("", 0), (" lc='2'", 1), ("", 1))
    ]
    none, varies, all_ = (forces(solve(str(n), replace(each, curves=late))[0])[:, 1] for n, each in enumerate(made))
    np.testing.assert_allclose(varies[:2], none[:2], rtol=1e-3)
    assert abs(varies[-1] - none[-1]) > 0.5 * abs(all_[-1] - none[-1])


def test_a_curve_that_is_constant_is_no_curve(solve):
    """All parameters that may follow one, at once, but for those of solutes and of a membrane, which has no penalty."""
    values = {
        "penalty": 20,
        "tangential_penalty": 2,
        "fric_coeff": 0.2,
        "contact_frac": 0.5,
        "offset": 0.01,
        "pressure_penalty": 1,
        "ambient_pressure": 0.001,
        "gaptol": 1,
        "ptol": 1,
        **dict.fromkeys(("tolerance", "traction_tolerance", "solvent_tolerance"), 0.01),
    }
    of_solutes = {"concentration_penalty", "ambient_concentration", "solute_tolerance", "ctol"}
    of_membranes = {"hydraulic_conductance", "solute_permeance", "reflection"}
    assert set(FOLLOWED) - set(values) == of_solutes | of_membranes
    whole = [
        "<laugon>AUGLAG</laugon>" + "".join(f"<{name}{curve_}>{value}</{name}>" for name, value in values.items())
        for curve_ in ("", " lc='2'")
    ]
    with_curves, without = (solve(str(n), pressed(each, fluid=True, drag=True))[0] for n, each in enumerate(whole))
    np.testing.assert_array_equal(forces(with_curves), forces(without))


REFUSED = [parameter.name for parameter in PLUGIN_TYPES["sliding-mixture"] if parameter.name not in FOLLOWED]


@pytest.mark.parametrize("name", REFUSED)
def test_a_parameter_that_cannot_change_is_refused_by_name(solve, name):
    """FEBio refuses curves on words, switches and counts itself."""
    value = {"laugon": "PENALTY", "integration": "gauss", "effects": "all"}.get(name, 0)
    _, found = solve("refused", pressed(f"<{name} lc='2'>{value}</{name}>"), ends=False)
    assert found.report.steps == 0
    assert re.search(rf'<{name}> has a load curve|tag "{name}" .* invalid attribute "lc"', found.report.errors[0])
