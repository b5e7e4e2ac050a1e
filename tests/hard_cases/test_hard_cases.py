"""The hard cases on the coarse mesh with sliding-mixture; `mixcontact hard-cases` runs all meshes and interfaces."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace

import febio_runs
import numpy as np
import pytest

from harness.post.compare import missed
from harness.run import engine, logdata
from studies import files
from studies.hard_cases import heat_map, outcomes, page, record, variants
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.outcomes import Outcome
from studies.hard_cases.scene import Fineness, Interface
from studies.pages.evidence import DATA

RETRIES = {"cutback-at-touch": 1}
"""Retries of a case: this one is forced."""


TOUCH = ("touch-gap-element", Fineness.FINE)
"""A step that ends with a gap of zero to rounding: the only one on the fine mesh."""
SLOW = (
    *("slide-20-facets", "1000-steps", "curved-1-to-8", "rotation-90", "curved-two-pass", "cutback-at-touch"),
    *("ten-cycles", "slide-off-edge", "corner-on-face", "permeability-1e8", "corner-two-pass"),
    *("diffusivity-1e6", "lost-and-regained", "peclet-1e4"),
)
"""Cases of more than three seconds of processor time."""


def cases():
    slow = {name: [pytest.mark.slow] if name in SLOW else [] for name in CASES}
    coarse = (pytest.param(name, Fineness.COARSE, marks=marks) for name, marks in slow.items())
    return [*coarse, pytest.param(*TOUCH, marks=pytest.mark.slow)]


@pytest.mark.parametrize(("name", "mesh"), cases())
def test_it_ends_and_passes(runner, name, mesh):
    made = record.make(runner, name, mesh, Interface.MIXTURE)
    assert made.ended, made.failures
    assert made.retries == RETRIES.get(name, 0)
    assert missed(made.measures) == []


@pytest.mark.parametrize("name", ["edge-on-face", "three-bodies", "penalty-1e3"])
@pytest.mark.parametrize("interface", [Interface.MIXTURE, Interface.PREDICTED], ids=lambda each: each.value)
def test_the_data_of_the_page_are_what_the_code_gives(runner, name, interface):
    """Where this fails on purpose: `scripts/mixcontact hard-cases --docs`."""
    run = runner(CASES[name].scene.model(Fineness.COARSE, interface), check=False)
    written = outcomes.arranged(files.read_csv(DATA / page.SOURCE, Outcome))[name, Fineness.COARSE.value]
    report = run.report
    assert (report.steps, report.iterations, report.retries) == (
        written[interface.value].steps,
        written[interface.value].iterations,
        written[interface.value].retries,
    )


def _said_of_penetration(run):
    """What the log says of nodes that primary facets do not resolve."""
    return re.findall(r".*have contact conditions of their own.*", (run.folder / "screen.txt").read_text())


@pytest.mark.parametrize("name", ["corner-on-face", "curved-1-to-8"])
def test_a_feature_that_primary_facets_do_not_resolve_is_reported(runner, name):
    swapped = variants.swapped(CASES[name].scene.model(Fineness.COARSE, Interface.MIXTURE))
    missed_by, surface = swapped.mesh.pairs["pair"]
    (said,) = _said_of_penetration(runner(swapped))
    assert f'secondary surface "{surface}" inside the body of "{missed_by}"' in said


@pytest.mark.slow
@pytest.mark.parametrize("name", ["curved-1-to-8", "slide-off-edge", "curved-two-pass"])
def test_where_it_is_resolved_nothing_is_said(runner, name):
    run = runner(CASES[name].scene.model(Fineness.COARSE, Interface.MIXTURE))
    assert not [text for text in run.report.warnings if "without any load" in text]
    assert not _said_of_penetration(run)


def test_what_both_sides_leave_open_is_warned_of(runner):
    run = runner(CASES["corner-on-face"].scene.model(Fineness.COARSE, Interface.MIXTURE))
    assert len([text for text in run.report.warnings if "without any load" in text]) == 1


@pytest.mark.slow
def test_restart_with_penetration_check_nodes(runner, tmp_path):
    """From the archive after 12 of 20 steps. febio4 cannot continue a run that logs data of surfaces or facets."""
    swapped = variants.swapped(CASES["curved-1-to-8"].scene.model(Fineness.COARSE, Interface.MIXTURE))
    model = replace(swapped, name="penetration-dump", surface_columns=(), facet_columns=(), plot=True)
    whole = runner(model, options=("-dump=1", "-dump_stride=12"))
    folder = shutil.copytree(whole.folder, tmp_path / "continued")
    (folder / model.node_file).unlink()
    again = febio_runs.restart(folder / f"{model.name}.dmp", plugin=engine.required_plugin())
    assert "have contact conditions of their own" not in again.output  # known from the archive
    part = logdata.read_history(folder / model.node_file, model.node_columns)
    np.testing.assert_allclose(part.values, whole.nodes.values[13:], atol=1e-10, rtol=0.0)


def outcome(interface: str, iterations: int, *, ended: bool = True, limited: bool = False, **more) -> Outcome:
    found = {"steps": 5, "residuals": 0, "retries": 0, "missed": "", "reached": 1.0 if ended else 0.3} | more
    about = {"case": "edge-on-face", "mesh": "coarse", "interface": interface}
    return Outcome(**about, ended=ended, limited=limited, iterations=iterations, **found)


def test_a_run_that_was_ended_by_its_limit_has_a_column_of_its_own():
    """That there is no number of iterations says nothing: FEBio writes none where it crashes, either."""
    made = [outcome("febio-1", 0, ended=False, limited=True), outcome("febio-1", 0, ended=False, retries=4)]
    assert "| FEBio, factor 1 | 2 | 0 | 0 | 1 | 1 | 4 |" in outcomes.summary(made)
    assert "limit: to 30 %" in outcomes.table(made[:1], {"edge-on-face": "edge"})
    assert [one.counts for one in made] == ["limit at 30 %", "fails at 30 %"]
    assert "fails: to 30 %" in outcomes.table(made[1:], {"edge-on-face": "edge"})


def test_where_febio_is_better_the_same_line_says_so():
    ours = outcome("sliding-mixture", 40)
    assert "| 40 | not run | 39 | not run | 39 with factor 1 |" in table_of(ours, outcome("febio-1", 39))
    for worse in (outcome("febio-1", 41), outcome("febio-1", 39, missed="force"), outcome("febio-1", 0, ended=False)):
        assert table_of(ours, worse).endswith("|  |")
    lost = replace(ours, ended=False, iterations=9)
    assert "99 with factor 1000 |" in table_of(lost, outcome("febio-1000", 99))


def table_of(*runs: Outcome) -> str:
    return outcomes.table(runs, {"edge-on-face": "edge"})


def test_the_picture_is_drawn(tmp_path):
    made = [outcome("sliding-mixture", 40), outcome("febio-1", 0, ended=False)]
    text = heat_map.draw(made, tmp_path / "heat.svg").read_text()
    assert "<svg" in text


def test_every_case_has_one_group_in_the_picture():
    grouped = [case for cases in heat_map.GROUPS.values() for case in cases]
    assert sorted(grouped) == sorted(CASES)


def test_rows_with_failures_come_first():
    fails = outcome("febio-1000", 0, ended=False)
    rows = {("curved-1-to-8", "coarse"): {}, ("edge-on-face", "coarse"): {"febio-1000": fails}}
    assert list(heat_map.ordered(rows)) == ["edges, corners, large motion", "meshes"]
