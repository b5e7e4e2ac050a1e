"""Scenes of the breadth that users have: what FEBio's interface ends, sliding-mixture ends, too."""

from __future__ import annotations

import pytest

from harness.pages import scene_results
from harness.studies.real_models import comparison
from harness.studies.real_models.all_scenes import SCENES

QUICK = (
    "material-Mooney-Rivlin",
    "elements-tet10",
    "two-pass-augmented",
    "rigid-free",
    "multiphasic",
    "quasi-newton",
    "shells-back",
)
TIMEOUT = 300.0
WITH_RETRIES_BY_DEFAULT = {
    "slot-closes": "the step in which the slot's mouth touches fails with a factor of 100, FEBio's interface's as well",
}


def test_there_are_scenes_of_every_kind():
    assert len(SCENES) >= 70
    assert {scene.module for scene in SCENES.values()} == {"solid", "biphasic", "solute", "multiphasic", "fluid-FSI"}


@pytest.mark.usefixtures("runner")
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in SCENES]
)
def test_a_scene_runs_as_with_febios_interface(name, tmp_path):
    row = comparison.compare(name, SCENES[name], tmp_path, TIMEOUT)
    for ours, may_retry in ((row.converted, False), (row.defaults, name in WITH_RETRIES_BY_DEFAULT)):
        assert ours.ended, ours.why
        if not row.febio.ended:
            continue
        assert ours.iterations <= scene_results.MOST * row.febio.iterations
        if not may_retry:
            assert ours.retries <= row.febio.retries
