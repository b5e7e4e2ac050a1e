"""Steps in which nothing changes pass at once, though a stiff contact makes more of rounding than the bodies do."""

from __future__ import annotations

import febio_runs
import pytest

from harness.run import engine
from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed

pytestmark = pytest.mark.mixture_only

FAR = 1000.0
"""mm from the origin: rounding of positions grows with it."""
STEPS = 12


def _held(kind: str) -> Document:
    """A block rests on another one under a pressure that stays after the second step; it may not move sideways."""
    parts = Parts()
    low, high = (FAR - 0.3, FAR - 0.3, FAR), (FAR + 1.3, FAR + 1.3, FAR + 1)
    parts.box("low", low, high, (5, 5, 2), "low")
    parts.box("up", (FAR, FAR, FAR + 0.99), (FAR + 1, FAR + 1, FAR + 2), (4, 4, 2), "up")
    params = "<auto_penalty>1</auto_penalty><penalty>1</penalty>" if kind == "sliding-elastic" else ""
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (elastic("up", 1, 100.0, 0.3), elastic("low", 2, 100.0, 0.3)),
        control=control("solid", STEPS, 1.0, retries=5),
        boundary=(fixed("low-bottom", "x", "y", "z"), fixed("up-top", "x", "y")),
        loads=('<surface_load type="pressure" surface="up-top"><pressure lc="1">5</pressure></surface_load>',),
        contacts=(contact("joint", "pair", kind, params),),
        curves=(curve(1, (0, 0), (2, 1), (100, 1)),),
    )


@pytest.mark.parametrize("kind", ["sliding-elastic", "sliding-mixture"])
def test_a_force_is_held_without_retries(runner, tmp_path, kind):
    path = tmp_path / "held.feb"
    path.write_text(_held(kind).text())
    found = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
    assert found.report.normal, found.report.errors
    assert found.report.retries == 0
    assert found.report.steps == STEPS
