"""Whole outsides of bodies as contact surfaces give what the facing sides alone give."""

from __future__ import annotations

from dataclasses import dataclass

import febio_runs
import numpy as np
import pytest
from scenes import facing
from scenes.facing import FacingScene

from harness.run import engine
from harness.run.febio_log import Report
from studies.models.small import table

BAR = 1e-8
"""Of forces and pressures, relative."""
BY_DEFAULT = 1e-2
"""Of forces, relative, where penalties at edges are means over other facets; they leave an overlap of 1e-3."""
QUICK = {"lean-0.02", "lean-0.3-of-faced", "layers", "clamp", "rod-in-tube", "fluid-layer-on-bone", "folded-sheet"}
"""Scenes that run with the quick tests."""
SCENES = [
    pytest.param(scene, id=name, marks=() if name.rsplit("-", 1)[0] in QUICK else pytest.mark.slow)
    for name, scene in facing.scenes().items()
]


@dataclass(frozen=True)
class Outcome:
    """What a run found: the force on the upper body, the pressures of nodes, and how hard it was."""

    force: np.ndarray
    pressure: np.ndarray
    report: Report


def outcome(scene: FacingScene, folder, *, whole: bool) -> Outcome:
    folder.mkdir()
    model = folder / "model.feb"
    model.write_text(scene.document(whole=whole).text())
    report = febio_runs.run(model, plugin=engine.required_plugin()).report
    nodes = table(folder / "nodes.txt")[-1]
    return Outcome(scene.force(nodes), nodes[:, 6:], report)


@pytest.mark.parametrize("scene", SCENES)
def test_whole_outsides_give_what_the_facing_sides_give(runner, tmp_path, scene):
    whole, alone = (outcome(scene, tmp_path / kind, whole=kind == "whole") for kind in ("whole", "facing"))
    assert np.linalg.norm(whole.force - alone.force) <= BAR * np.linalg.norm(alone.force)
    if scene.porous:
        assert np.abs(whole.pressure - alone.pressure).max() <= BAR * np.abs(alone.pressure).max()
    assert whole.report.retries <= alone.report.retries


@pytest.mark.parametrize("name", ["lean-0.1-segments", "layers-gauss", "rim-sharp-segments", "fluid-layers-segments"])
def test_automatic_penalties_of_edges_change_little(runner, tmp_path, name):
    scene = facing.scenes(penalties="")[name]
    whole, alone = (outcome(scene, tmp_path / kind, whole=kind == "whole") for kind in ("whole", "facing"))
    assert np.linalg.norm(whole.force - alone.force) <= BY_DEFAULT * np.linalg.norm(alone.force)
    assert whole.report.retries <= alone.report.retries
