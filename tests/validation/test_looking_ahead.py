"""What a time step begins with: the nodes that the last one has come near to contact."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from harness.models.ball_in_socket import BallInSocket
from harness.run import engine

pytestmark = pytest.mark.mixture_only

STEPS = 5
JOINT = BallInSocket(elements=4, steps=STEPS, slides=False)
BEGINS, ITERATES = "===== beginning time step", "Nonlinear solution status"


def _iterations(model: Path) -> list[int]:
    """Of each time step."""
    engine.run(model, plugin=engine.required_plugin())
    return [step.count(ITERATES) for step in model.with_suffix(".log").read_text().split(BEGINS)[1:]]


def test_a_load_that_another_step_of_the_analysis_holds_takes_an_iteration_each_time(runner, tmp_path):
    """Nothing moves any more: no node is expected to close as it would have, had the load gone on to grow."""
    path = JOINT.model().write(tmp_path)
    text = path.read_text()
    control = re.search(r"<Control>.*?</Control>", text, flags=re.DOTALL)
    assert control is not None
    steps = "".join(f'<step id="{number}" name="step{number}">{control.group()}</step>' for number in (1, 2))
    path.write_text(text.replace(control.group(), "").replace("<Output>", f"<Step>{steps}</Step>\n<Output>"))
    pressed_and_held = _iterations(path)
    assert pressed_and_held[STEPS:] == [1] * STEPS
    assert pressed_and_held[:STEPS] == _iterations(replace(JOINT, name="pressed").model().write(tmp_path))
