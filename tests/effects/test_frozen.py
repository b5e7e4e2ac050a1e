"""Blocks whose displacements are all fixed: contact is transport alone, and says so."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from harness.models import pairs
from harness.models.pairs import Kind
from harness.models.parts import Param, fix

REASON = "No traction: the displacements of both surfaces are fixed."
SAME = 1e-9
"""Relative: two runs that differ in the word for their effects alone."""


def blocks(name, effects="all", frozen=True):
    """Two multiphasic blocks that share three solutes and just touch; all nodes fixed, or pressed together."""
    settings = pairs.ContactSettings(extra=(Param("effects", effects),))
    pair = replace(pairs.of_kinds(Kind.MULTIPHASIC, Kind.MULTIPHASIC), name=name, settings=settings)
    model = pair.model()
    if not frozen:
        return model
    transport = tuple(c for c in model.conditions if "displacement" not in c.kind)
    fixed = (*transport, fix("lower-all", "xyz"), fix("upper-all", "xyz"))
    # Later steps are steady to rounding, and FEBio's relative norms then compare rounding with rounding.
    return replace(model, conditions=fixed, control=replace(model.control, steps=4))


def end_of(run, surface):
    return run.surface(surface).values[-1, 0]


@pytest.fixture(scope="module")
def run(runner):
    return runner(blocks("frozen"))


def test_the_log_says_why_there_is_no_traction(run):
    assert f"exchanges solvent, solute 1, solute 2, solute 3. {REASON}" in run.log


def test_fluxes_pass_and_no_force_does(run):
    lower, upper = (end_of(run, surface) for surface in ("lower-top", "upper-bottom"))
    assert np.all(lower[:3] == 0)
    assert np.all(np.abs(lower[3:]) > 0)
    assert np.array_equal(lower, -upper)


def test_traction_may_be_left_out_by_name(run, runner):
    named = runner(blocks("frozen-named", "solvent, solutes"))
    assert np.allclose(end_of(named, "lower-top"), end_of(run, "lower-top"), rtol=SAME, atol=0)


def test_traction_must_not_be_left_out_where_bodies_can_move(runner):
    run = runner(blocks("frozen-refused", "solvent, solutes", frozen=False), check=False)
    assert not run.report.normal
    assert run.report.steps == 0
    assert "<effects> leaves traction out, but not all displacements" in " ".join(run.report.errors)
