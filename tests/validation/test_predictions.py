"""What `check` says of a penalty is what a run shows: the jump in steady diffusion, by any interface."""

from __future__ import annotations

import pytest

from harness.models.convection import UPSTREAM, Convection
from harness.models.interface import PAPER, ContactSettings, InterfaceType, automatic
from harness.models.parts import Control
from harness.post import compare
from harness.preflight.model import read
from harness.preflight.penalty import leak, penalty
from harness.preflight.sides import Joint, solute

SETTINGS = {"the paper's": PAPER, "factor 1": automatic(1.0), "default": ContactSettings()}


@pytest.mark.parametrize("kind", [InterfaceType.MIXTURE, InterfaceType.SOLUTE, InterfaceType.MULTIPHASIC])
@pytest.mark.parametrize("name", SETTINGS)
def test_the_leak_is_the_jump(runner, tmp_path, kind, name):
    model = Convection(kind, SETTINGS[name], elements=5, control=Control(20, 2000.0), name="leak", peclet=0).model()
    looked = read(model.write(tmp_path))
    joint = Joint(looked, looked.contacts[0])
    predicted = leak(joint, solute(1), penalty(joint, solute(1)).value)
    assert compare.jump(runner(model), "c1", "lower/upper") / UPSTREAM == pytest.approx(predicted, rel=2e-3)
