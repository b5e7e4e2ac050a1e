"""One answer at an edge of contact, however it is found, and in steps far below the time in which bodies drain."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from lxml import etree

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.run import engine, febio_log
from harness.run.logdata import History
from studies import feb
from studies.feb import Feb
from studies.one_answer.answers import ENFORCED, FULL, KEPT, SAME, WAYS, Answers, contact
from studies.one_answer.edge_scenes import SCENES
from studies.robustness import differences, execution, variations
from studies.robustness.execution import Way
from studies.robustness.sanitized import Plugin
from studies.robustness.trial import Trial

pytestmark = pytest.mark.mixture_only

QUICK = ("punch", "sphere-loaded", "sphere-slides", "tet10-slide", "crack")
JUMP = 5e-3
"""What default penalties leave: a thousandth of the drop across the adjoining elements, which is a few times the
pressure. A node of another status differs by all of the pressure."""
SHORT = 1e-6
"""s; an element drains in hundreds."""


@pytest.fixture(scope="module")
def way():
    try:
        engine.find_engine()
        return Way(Plugin(engine.required_plugin()), timeout=600.0)
    except (EngineNotFoundError, PluginNotFoundError) as error:
        pytest.skip(str(error))


def test_each_enforcement_is_compared_in_all_ways(monkeypatch, tmp_path):
    written = {}

    def run(model, folder, way, *, leaks=False):
        written[folder] = etree.tostring(model.root)
        nodes = 1 + np.arange(len(model.root.findall("Mesh/Nodes/node")))
        stopped = History(np.zeros(1), nodes, model.columns, np.zeros((1, len(nodes), len(model.columns))))
        return execution.Ended(folder, 0, febio_log.parse(""), (), stopped)

    monkeypatch.setattr(execution, "run", run)
    scene = replace(SCENES["punch"], steps=1).feb("punch")
    found = list(Answers(scene, Way(Plugin(tmp_path), timeout=1.0), tmp_path).all())
    for enforced in ENFORCED:
        for way in (*WAYS, "renumbered"):
            (answer,) = [each for each in found if each.way == f"{enforced}, {way}"]
            assert answer.across == (way == FULL)
    assert [answer.way for answer in found if answer.difference is None] == [f"{next(iter(ENFORCED))}, {FULL}"]
    assert all(answer.difference in (None, float("inf")) for answer in found)
    assert len(set(written.values())) == len(ENFORCED) * (len(WAYS) + 1 + len((FULL, KEPT)))


@pytest.mark.parametrize("name", QUICK)
def test_a_matrix_that_is_kept_leads_to_the_answer_of_full_newton(way, tmp_path, name):
    scene = variations.watched(SCENES[name].feb(name))
    runs = {method: execution.run(WAYS[method](scene), tmp_path / method, way) for method in (FULL, KEPT)}
    assert all(run.how == "normal" for run in runs.values())
    assert differences.largest(runs[KEPT].nodes, runs[FULL].nodes) <= SAME


@pytest.mark.parametrize("name", ["crack", "tet10-load"])
def test_all_enforcements_lead_to_one_answer(way, tmp_path, name):
    """At the tip of a crack, and where an augmentation begins with trials that pull."""
    scene = variations.watched(SCENES[name].feb(name))
    kept = {}
    for enforced, change in ENFORCED.items():
        runs = [
            execution.run(WAYS[method](change(scene)), tmp_path / enforced / method, way) for method in (FULL, KEPT)
        ]
        assert [run.how for run in runs] == ["normal", "normal"]
        assert differences.largest(runs[1].nodes, runs[0].nodes) <= SAME
        kept[enforced] = runs[1].nodes
    for nodes in kept.values():
        assert differences.largest(nodes, kept["LAGMULT"]) <= JUMP


def in_steps(model: Feb, size: float) -> Feb:
    """The same model with steps of this size, s, and the load curves in proportion."""
    made = model.copy()
    for control in made.controls:
        factor = size / feb.number(control, "step_size", 1.0)
        feb.put(control, "step_size", f"{size:.17g}")
    for point in made.root.iter("pt"):
        time, value = point.text.split(",")
        point.text = f"{float(time) * factor:.17g},{value}"
    return made


def test_steps_far_below_the_drainage_time_leave_no_jump_of_the_pressure(way, tmp_path):
    """Multipliers as unknowns have next to none; they converge with either of MKL's solvers."""
    scene = in_steps(variations.watched(replace(SCENES["punch"], steps=1).feb("short")), SHORT)
    exact = {
        solver: execution.run(ENFORCED["LAGMULT"](WAYS[solver](scene)), tmp_path / solver, way)
        for solver in (FULL, "mkl_dss")
    }
    penalty = execution.run(WAYS[FULL](scene), tmp_path / "penalty", way)
    assert all(run.how == "normal" for run in (*exact.values(), penalty))
    assert differences.largest(exact["mkl_dss"].nodes, exact[FULL].nodes) <= SAME
    assert np.abs(exact[FULL].nodes["p"]).max() > 0.0
    assert differences.largest(penalty.nodes, exact[FULL].nodes) <= JUMP


def test_a_tolerance_that_equals_the_gap_of_the_penalty_is_met_alike_in_a_restarted_run(way, tmp_path):
    """The default penalty leaves a thousandth of the drop, and rounding does not decide about another augmentation."""
    scene = contact(laugon="AUGLAG", tolerance=1e-3)(WAYS[KEPT](SCENES["sphere-slides"].feb("restarted")))
    found = {finding.variation: finding for finding in Trial(scene, way, tmp_path, 0).findings()}
    assert found["restarted"].faults == ()
