"""Synthetic test scenes: what FEBio's interface ends, sliding-mixture ends, too."""

from __future__ import annotations

import pytest

from studies import feb
from studies.pages import scene_results
from studies.stamps import LIMIT
from studies.synthetic_scenes import comparison
from studies.synthetic_scenes.collections_of_scenes import SCENES

QUICK = ("material-Mooney-Rivlin", "rigid-free", "quasi-newton", "shells-back")
SLOW = (
    "material-damage",
    "material-mixture-with-exponential-fibres",
    "elements-penta6",
    "type-sliding-facet-on-facet",
    "type-sliding-node-on-facet",
    "sphere-tet4",
    "flat",
    "sliding",
    "two-pass-augmented",
    "tension",
    "rigid-slab",
    "dynamic",
    "biphasic-creep",
    "biphasic-impermeable",
    "solute-tet4",
    "multiphasic",
    "quasi-newton-biphasic",
    "symmetric",
    "begins-with-a-step",
    "ends-with-a-step",
    "explicit",
    "mesh-from-a-file",
    "part-lists",
    "both-ways",
    "fluid-FSI",
    "slot-closes",
    "friction-sliding",
    "friction-rigid-free",
    "friction-biphasic",
    "friction-elements-tet10",
)
"""One of each kind; the command `synthetic-scenes` runs all."""
WITH_RETRIES_BY_DEFAULT = {
    "slot-closes": "the step in which the slot's mouth touches fails with a factor of 100, FEBio's interface's as well",
}
WITH_ITERATIONS_BY_DEFAULT = {
    "friction-elements-tet10": "the default tangential penalty is a hundred times that of the scene: more nodes change "
    "between stick and slip",
}


def test_there_are_scenes_of_every_kind(tmp_path):
    assert len(SCENES) >= 90
    modules = {"solid", "explicit-solid", "biphasic", "solute", "multiphasic", "fluid-FSI"}
    assert {feb.read(scene.write(name, tmp_path)).module for name, scene in SCENES.items()} == modules


@pytest.mark.usefixtures("runner")
@pytest.mark.parametrize("name", [*QUICK, *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW)])
def test_a_scene_runs_as_with_febios_interface(name, tmp_path):
    row = comparison.compare(name, SCENES[name], tmp_path, LIMIT)
    assert row.febio.ended
    for ours in (row.converted, row.defaults):
        assert ours.ended, ours.why
    assert row.converted.retries <= row.febio.retries
    assert row.converted.iterations <= scene_results.MOST * row.febio.iterations
    if name not in WITH_RETRIES_BY_DEFAULT:
        assert row.defaults.retries <= row.febio.retries
    if name not in WITH_ITERATIONS_BY_DEFAULT:
        assert row.defaults.iterations <= scene_results.MOST * row.febio.iterations
