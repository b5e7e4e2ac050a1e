"""The hard cases on the coarse mesh with sliding-mixture; `mixcontact hard-cases` runs all meshes and interfaces."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace

import numpy as np
import pytest

from harness.post.compare import missed
from harness.run import engine, logdata
from harness.studies.hard_cases import record, variants
from harness.studies.hard_cases.catalogue import CASES
from harness.studies.hard_cases.scene import Fineness, Interface

RETRIES = {"cutback-at-touch": 1}
"""Retries of a case: this one is forced."""


TOUCH = ("touch-gap-element", Fineness.FINE)
"""A step that ends with a gap of zero to rounding: the only one on the fine mesh."""
SLOW = (
    *("slide-20-facets", "1000-steps", "curved-1-to-8", "rotation-90", "curved-two-pass", "cutback-at-touch"),
    *("ten-cycles", "slide-off-edge", "corner-on-face", "permeability-1e8", "corner-two-pass"),
)
"""Cases of more than three seconds of processor time."""


def cases():
    slow = {name: [pytest.mark.slow] if name in SLOW else [] for name in CASES}
    return [*(pytest.param(name, Fineness.COARSE, marks=marks) for name, marks in slow.items()), TOUCH]


@pytest.mark.parametrize(("name", "mesh"), cases())
def test_it_ends_and_passes(runner, name, mesh):
    made = record.make(runner, name, mesh, Interface.MIXTURE)
    assert made.ended, made.failures
    assert made.retries == RETRIES.get(name, 0)
    assert missed(made.measures) == []


def _noticed(run):
    """What the log says of nodes that primary facets do not notice."""
    return re.findall(r".*have contact conditions of their own.*", (run.folder / "screen.txt").read_text())


@pytest.mark.parametrize("name", ["corner-on-face", "curved-1-to-8"])
def test_a_feature_that_primary_facets_miss_is_noticed(runner, name):
    swapped = variants.swapped(CASES[name].scene.model(Fineness.COARSE, Interface.MIXTURE))
    missed_by, surface = swapped.mesh.pairs["pair"]
    (said,) = _noticed(runner(swapped))
    assert f'secondary surface "{surface}" inside the body of "{missed_by}"' in said


@pytest.mark.parametrize("name", ["curved-1-to-8", "slide-off-edge", "curved-two-pass"])
def test_where_it_is_noticed_nothing_is_said(runner, name):
    run = runner(CASES[name].scene.model(Fineness.COARSE, Interface.MIXTURE))
    assert not [text for text in run.report.warnings if "without any load" in text]
    assert not _noticed(run)


def test_what_both_sides_leave_open_is_warned_of(runner):
    run = runner(CASES["corner-on-face"].scene.model(Fineness.COARSE, Interface.MIXTURE))
    assert len([text for text in run.report.warnings if "without any load" in text]) == 1


def test_restart_with_noticed_nodes(runner, tmp_path):
    """From the archive after 12 of 20 steps. febio4 cannot continue a run that logs data of surfaces or facets."""
    swapped = variants.swapped(CASES["curved-1-to-8"].scene.model(Fineness.COARSE, Interface.MIXTURE))
    model = replace(swapped, name="noticed-dump", surface_columns=(), facet_columns=(), plot=True)
    whole = runner(model, options=("-dump=1", "-dump_stride=12"))
    folder = shutil.copytree(whole.folder, tmp_path / "continued")
    (folder / model.node_file).unlink()
    again = engine.restart(folder / f"{model.name}.dmp", plugin=engine.required_plugin())
    assert "have contact conditions of their own" not in again.output  # known from the archive
    part = logdata.read_history(folder / model.node_file, model.node_columns)
    np.testing.assert_allclose(part.values, whole.nodes.values[13:], atol=1e-10, rtol=0.0)


def test_a_run_that_was_ended_by_its_limit_is_no_failure_of_its_own():
    """FEBio writes no number of iterations then; one that fails by itself has them."""
    made = [
        record.Record("touch-gap-element", mesh, "febio-1", False, 0.3, 5, iterations, 0, 2, "", [])
        for mesh, iterations in (("coarse", 0), ("fine", 30))
    ]
    assert "| FEBio, factor 1 | 2 | 0 | 1 | 1 | 0 | 4 |" in record.summary(made)
    assert "ended by its limit, 5 / - / 2" in record.table(made)
    assert "fails, 5 / 30 / 2" in record.table(made)
