"""Quadratic elements with linear pressure, FEBio's <mixed_formulation>: a layer in two parts behaves as a whole one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from harness.models.confined import OVERLAP, Confined
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Control, Param
from studies.models.quadratic import quadratic

pytestmark = pytest.mark.mixture_only

JUMP = 1e-5
"""Of the pressure: the default penalty is 1e5 times the conductance of the elements, across which less is lost."""


def layer(interface: InterfaceType, mixed: int):
    control = replace(Control(10, 20.0), solver=(Param("mixed_formulation", mixed),))
    model = Confined(interface, ContactSettings(), elements=4, control=control).model()
    return replace(model, mesh=quadratic(model.mesh, 20))


@pytest.mark.parametrize("mixed", [0, 1])
def test_a_layer_in_two_parts_has_the_pressure_of_a_whole_one(runner, mixed):
    whole, parts = (runner(layer(kind, mixed)) for kind in (InterfaceType.CONFORMING, InterfaceType.MIXTURE))
    assert whole.report.iterations == parts.report.iterations
    places = [run.model.mesh.nodes for run in (whole, parts)]
    apart = np.abs(places[0][None] - places[1][:, None]).max(axis=2)
    same = apart <= 2.0 * OVERLAP
    assert np.all(same.any(axis=1))
    known, found = whole.nodes["p"][-1], parts.nodes["p"][-1]
    jumps = np.where(same, np.abs(known[None] - found[:, None]), np.inf).min(axis=1)
    assert jumps.max() <= JUMP * np.abs(known).max()
