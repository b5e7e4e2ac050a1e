"""What contacts write about their times at the end of a run, and what is made of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import pairs

from harness.errors import DataFileError
from harness.models.interface import InterfaceType
from studies.price import joints, page, paired_runs, table
from studies.price.scenes import Kind, Scene, effects_added

LOG = """
sliding-mixture "a joint": time in the contact [s]
                        shared    traction     solvent    solute 2         all  of it host
    search           4.000e-03   0.000e+00   0.000e+00   0.000e+00   4.000e-03   0.000e+00
    residual         1.100e-02   0.000e+00   0.000e+00   0.000e+00   1.100e-02   1.000e-03
    stiffness        2.500e-02   4.000e-02   1.200e-02   3.000e-03   8.000e-02   5.000e-02
    augmentation     3.000e-03   0.000e+00   0.000e+00   0.000e+00   3.000e-03   0.000e+00
    output           2.000e-03   0.000e+00   0.000e+00   0.000e+00   2.000e-03   0.000e+00
    all              4.500e-02   4.000e-02   1.200e-02   3.000e-03   1.000e-01   5.100e-02
    share of the run: 8 percent of 1.25 s
    memory: 345 bytes for each of 1024 integration points

 N O R M A L   T E R M I N A T I O N
"""


def test_the_table_of_a_log_is_read():
    (times,) = table.read(LOG)
    assert times.seconds["stiffness"]["solvent"] == 1.2e-2
    assert list(times.effects) == ["shared", "traction", "solvent", "solute 2"]
    assert times.effects["traction"] == pytest.approx(4e-2)
    assert times.share == pytest.approx(0.08)
    assert (times.points, times.memory) == (1024, 345)


@pytest.mark.parametrize("wrong", [("2.500e-02", "many"), ("augmentation", "augury"), ("share", "part")])
def test_a_table_that_is_none_is_refused(wrong):
    with pytest.raises(DataFileError, match="a joint"):
        table.read(LOG.replace(*wrong))


def test_a_log_without_a_table_has_no_times():
    assert table.read("sliding-mixture: stopped") == []


@pytest.mark.parametrize("name", effects_added())
def test_a_scene_lists_its_effects_and_their_times(name, runner):
    scene = effects_added(section=3)[name]
    (times,) = table.read(runner(scene.model()).log)
    wanted = [] if scene.kind is Kind.ELASTIC else ["solvent", *(f"solute {k + 1}" for k in range(scene.solutes))]
    assert list(times.effects) == ["shared", "traction", *wanted]
    assert all(seconds >= 0.0 for task in times.seconds.values() for seconds in task.values())
    assert all(times.seconds["stiffness"][effect] > 0.0 for effect in times.effects)
    assert 0.0 < times.share < 1.0
    # Bodies with fluid widen differently, and each facet is cut by the edges of those beside the one opposite.
    differ = scene.kind is not Kind.ELASTIC and not scene.fixed
    pieces = (2 * scene.section - 1) ** 2 if differ else scene.section**2
    assert times.points == 4 * pieces


def test_contacts_are_compared_on_the_same_model():
    scenes = paired_runs.compared(Scene(Kind.BIPHASIC))
    assert [scene.contact for scene in scenes.values()] == [
        "conforming",
        InterfaceType.MIXTURE.value,
        InterfaceType.MIXTURE.value,
        "sliding-biphasic",
        "sliding-biphasic",
    ]
    with_predictor = [scene.name for scene in scenes.values() if scene.settings == paired_runs.PREDICTING]
    assert len(with_predictor) == 1
    assert len({scene.model().mesh.nodes.shape for scene in scenes.values() if scene.contact != "conforming"}) == 1


def test_memory_does_not_know_of_solutes_that_are_not_shared(runner):
    def memory(above: tuple[int, ...]) -> int:
        lower, upper = pairs.mixture(pairs.Kind.MULTIPHASIC, (1,)), pairs.mixture(pairs.Kind.MULTIPHASIC, above)
        uncharged = [replace(body, fixed_charge=0.0) for body in (lower, upper)]
        name = f"memory-{len(above)}-solutes"
        (times,) = table.read(runner(pairs.Pair(*uncharged, "multiphasic", name, charges=(0, 0, 0)).model()).log)
        return times.memory

    assert memory((1,)) == memory((1, 2, 3)) > 0


def test_costs_are_those_of_the_run_with_the_median_share(tmp_path):
    less, more = LOG.replace("of 1.25 s", "of 2.5 s"), LOG.replace("of 1.25 s", "of 1 s")
    costs = table.costs("solid", [more, LOG, less])
    assert [cost.effect for cost in costs] == ["shared", "traction", "solvent", "solute 2"]
    assert sum(cost.part for cost in costs) == pytest.approx(costs[0].share) == pytest.approx(0.08)
    assert (costs[0].share_low, costs[0].share_high) == pytest.approx((0.04, 0.1))
    assert "<svg" in page.draw(costs, tmp_path / "price.svg").read_text()


def test_the_table_says_where_febio_adds_less():
    def price(kind: str, factor: float, added: float, *, ended: bool = True) -> paired_runs.Price:
        return paired_runs.Price("biphasic", kind, factor, ended, False, 10, added, added, added, 500, 9000)

    ours = price("sliding-mixture", 0.0, 0.5)
    predicted = price("sliding-mixture-predictor", 0.0, 0.1)
    theirs = [price("sliding-biphasic", 1.0, 0.4), price("sliding-biphasic", 10.0, 0.6)]
    rows = page.comparison_table([ours, predicted, *theirs]).splitlines()[3:]
    assert [row.split(" | ")[-1].strip() for row in rows] == ["|", "`sliding-biphasic` |", "`sliding-mixture` |"]
    assert "`sliding-mixture`, `predictor` 1" in rows[0]
    failed = page.comparison_table([ours, price("sliding-biphasic", 1.0, 0.4, ended=False)])
    assert "| fails |" in failed
    assert failed.endswith("`sliding-mixture` |")


def test_a_table_of_joints_names_the_run_that_takes_less_time():
    def price(kind: str, ratio: float, *, ended: bool = True) -> joints.JointPrice:
        counts = {joints.OURS: (60, 0, 60), joints.PREDICTED: (45, 2, 45)}.get(kind, (50, 1, 40))
        return joints.JointPrice("knee", kind, ended, *counts, 2.0, ratio, 1.0, 1.5, 0.2, 600, 100, 500, 9000)

    def row(*prices: joints.JointPrice) -> str:
        return joints.joints_table(joints.arranged(prices)).splitlines()[2]

    ours, predicted, theirs = price(joints.OURS, 1.25), price(joints.PREDICTED, 1.1), price("sliding-elastic", 1.0)
    default = "| knee | 60, 50 | 0, 1 | 60, 40 | 1.25 (1.00 to 1.50) | 20 % | 6.0 | 1.00 | `sliding-elastic` |"
    assert row(ours, predicted, theirs) == default
    assert "| `sliding-mixture` |" in row(price(joints.OURS, 0.8), predicted, theirs)
    failed = row(ours, predicted, price("sliding-elastic", 1.0, ended=False))
    assert "60, fails" in failed
    assert failed.endswith("| `sliding-mixture` |")
    with pytest.raises(DataFileError, match="'knee' is not there with all contacts"):
        joints.arranged([ours, theirs])


def test_the_contacts_of_a_joint_have_the_same_mesh_and_conditions():
    for scene in joints.SCENES.values():
        ours, predicted, theirs = (one.model() for one in joints.contacts(scene).values())
        assert ours.contacts[0].kind == predicted.contacts[0].kind == "sliding-mixture" != theirs.contacts[0].kind
        assert [param.tag for param in predicted.contacts[0].params] == ["predictor"]
        assert replace(ours, contacts=(), header="", mesh=None) == replace(theirs, contacts=(), header="", mesh=None)
        np.testing.assert_array_equal(ours.mesh.nodes, theirs.mesh.nodes)
        assert ours.mesh.pairs == theirs.mesh.pairs
