"""Scenes of the breadth that users have: what FEBio's interface ends, sliding-mixture ends, too."""

from __future__ import annotations

import pytest

from harness.pages import scene_results
from harness.studies.real_models import comparison
from harness.studies.real_models.all_scenes import SCENES

QUICK = ("material-Mooney-Rivlin", "elements-tet10", "two-pass-augmented", "rigid-free", "multiphasic")
TIMEOUT = 300.0
PULLS_WHAT_IS_FAR_APART = ("tension",)
"""The default penalty pulls at the edges of the curved block, 0.17 mm away, until the first step gives way to a smaller
one."""


def test_there_are_scenes_of_every_kind():
    assert len(SCENES) >= 40
    assert {scene.module for scene in SCENES.values()} == {"solid", "biphasic", "solute", "multiphasic"}


@pytest.mark.usefixtures("runner")
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in SCENES]
)
def test_a_scene_runs_as_with_febios_interface(name, tmp_path):
    row = comparison.compare(name, SCENES[name], tmp_path, TIMEOUT)
    for ours in (row.converted, row.defaults):
        assert ours.ended, ours.why
        if not row.febio.ended:
            continue
        assert ours.iterations <= scene_results.MOST * row.febio.iterations
        if name not in PULLS_WHAT_IS_FAR_APART:
            assert ours.retries <= row.febio.retries
