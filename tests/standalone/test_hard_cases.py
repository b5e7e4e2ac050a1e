"""Hard cases in the embedded engine; `.ci/run` repeats them with its sanitizers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from harness.errors import EngineNotFoundError
from harness.post.compare import missed
from harness.run.hosts import STANDALONE
from harness.run.runner import Runner
from studies.hard_cases import invariants, variants
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.scene import Fineness, Interface

SELECTED = (
    "touch-gap-1e-12",
    "overlap-tenth",
    "lost-and-regained",
    "edge-on-face",
    "corner-two-pass",
    "slide-off-edge",
    "warped-quads",
    "slivers",
    "stiffness-1e6",
    "diffusivity-1e6",
    "ten-decades",
    "penalty-1e6",
    "three-bodies",
    "one-closes-one-opens",
    "dropped",
)
"""Contact found, lost, at edges and on bad facets; extreme properties; several bodies. Each is quick."""


@pytest.fixture(scope="module")
def runner(tmp_path_factory: pytest.TempPathFactory) -> Runner:
    """Runs models with the embedded engine."""
    try:
        STANDALONE.binaries(plugin=True)
    except EngineNotFoundError as error:
        pytest.skip(str(error))
    return Runner(Path(tmp_path_factory.mktemp("runs")), host=STANDALONE)


@pytest.mark.parametrize("name", SELECTED)
def test_it_ends_balanced_and_with_nothing_undefined(runner, name):
    case = CASES[name]
    model = replace(case.scene.model(Fineness.COARSE, Interface.MIXTURE), surface_columns=(), facet_columns=())
    run = runner(model)
    assert missed([*invariants.finite_and_bounded(run, case.undershoot), *invariants.mass(run)]) == []
    said = (run.folder / "screen.txt").read_text()
    assert "runtime error" not in said
    assert "Sanitizer" not in said


def test_a_feature_that_primary_facets_do_not_resolve_is_reported(runner):
    made = CASES["corner-on-face"].scene.model(Fineness.COARSE, Interface.MIXTURE)
    runs = [runner(replace(m, surface_columns=(), facet_columns=())) for m in (made, variants.swapped(made))]
    sharp, blunt = (float(np.abs(run.nodes["Rz"][-1]).sum()) for run in runs)
    assert blunt == pytest.approx(sharp, rel=0.05)
    assert (runs[1].folder / "screen.txt").read_text().count("have contact conditions of their own") == 1
