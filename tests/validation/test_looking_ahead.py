"""What a time step begins with: the nodes that the last one has come near to contact."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from harness.models.ball_in_socket import BallInSocket
from harness.run import engine
from studies import diagnosis
from studies.models.small import step

pytestmark = pytest.mark.mixture_only

STEPS = 5
DUMPED = 3
JOINT = BallInSocket(elements=4, steps=STEPS, slides=False)


def _iterations(log: Path) -> list[int]:
    """Of each time step."""
    return [len(attempt.residuals) for attempt in diagnosis.attempts(log.read_text())]


def test_a_load_that_another_analysis_step_holds_takes_an_iteration_each_time(runner, tmp_path):
    """Nothing moves any more: no node is expected to close as it would have, had the load gone on to grow."""
    path = JOINT.model().write(tmp_path)
    text = path.read_text()
    control = re.search(r"<Control>.*?</Control>", text, flags=re.DOTALL)
    assert control is not None
    steps = "".join(step(number, control.group()) for number in (1, 2))
    path.write_text(text.replace(control.group(), "").replace("<Output>", f"<Step>{steps}</Step>\n<Output>"))
    engine.run(path, plugin=engine.required_plugin())
    pressed_and_held = _iterations(path.with_suffix(".log"))
    assert len(pressed_and_held) == 2 * STEPS
    assert pressed_and_held[STEPS:] == [1] * STEPS


def test_a_run_that_is_continued_looks_ahead_as_the_whole_one(runner, tmp_path):
    """On from the middle of the steps in which the ball is pressed into its socket."""
    path = replace(JOINT.model(), plot=True).write(tmp_path)
    engine.run(path, plugin=engine.required_plugin(), options=("-dump=1", f"-dump_stride={DUMPED}"))
    whole = _iterations(path.with_suffix(".log"))
    engine.restart(path.with_suffix(".dmp"), plugin=engine.required_plugin())
    in_one_log = _iterations(path.with_suffix(".log"))
    assert in_one_log == whole + whole[DUMPED:]
