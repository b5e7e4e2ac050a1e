"""What the data of `mixcontact cost` say; no run is needed."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from harness.errors import DataFileError
from harness.models.interface import InterfaceType
from harness.run import engine
from harness.run.runner import RunResult
from studies import files
from studies import timing as timing_of_runs
from studies.cost import command, pareto
from studies.cost.point_runs import Datum
from studies.cost.points import OWN, Problem, finest, points
from studies.stamps import LIMIT, Stamp, at_limit

BASE = Datum(
    "3.2", "sliding-mixture", "default", 0.0, True, 1e-6, 3e-4, 20, 24, 44, 0, 0.3, 0.2, 0.1, 0.3, 1.0, 0.0, 9.0
)
CHEAP = replace(BASE, parameter="penalty factor", value=10.0, contact_error=1e-2, iterations=22, ratio=0.9)
POOR = replace(BASE, parameter="AUGLAG tolerance", value=0.1, contact_error=1e-3, iterations=31, ratio=1.3)
FAILED = replace(BASE, parameter="penalty factor", value=1.0, ended=False, contact_error=math.nan, ratio=math.nan)
MESH = replace(BASE, parameter="elements", value=3.0, contact_error=1e-9, ratio=0.1)
DATA = [BASE, CHEAP, POOR, FAILED, MESH]


def test_the_front_holds_what_nothing_else_beats():
    assert pareto.pareto(pareto.comparable(DATA, Problem.CONVECTION)) == [CHEAP, BASE]


def test_runs_that_failed_and_other_meshes_are_not_compared():
    assert pareto.comparable(DATA, Problem.CONVECTION) == [BASE, CHEAP, POOR]
    assert pareto.comparable(DATA, Problem.DIFFUSION) == []
    assert pareto.comparable(DATA, Problem.CONVECTION, ended=False) == [FAILED]


def test_the_limit_ended_what_took_its_time():
    stopped = replace(FAILED, cpu=0.99 * LIMIT)
    crashed = replace(FAILED, iterations=0)
    found = [at_limit(datum.ended, datum.cpu) for datum in (BASE, FAILED, crashed, stopped)]
    assert found == [False, False, False, True]


@pytest.mark.parametrize("problem", list(Problem))
def test_runs_that_failed_stand_in_the_picture(tmp_path, problem):
    data = [replace(datum, problem=problem.value) for datum in DATA]
    drawn = pareto.draw(data, tmp_path / "cost.svg").read_text()
    assert drawn.count('id="failed sliding-mixture"') == 1
    assert "did not complete" in drawn


def test_the_answer_is_the_cheapest_that_is_good_enough():
    own = pareto.comparable(DATA, Problem.CONVECTION)
    assert pareto.cheapest(own, 1e-1) is CHEAP
    assert pareto.cheapest(own, 1e-3) is BASE
    assert pareto.cheapest(own, 1e-9) is None
    text = command.answer(DATA, 1e-1, [Problem.CONVECTION])
    assert "<penalty>10</penalty>" in text
    assert "sliding-biphasic-solute: no setting that was measured reaches it" in text
    assert "leave the defaults" in command.answer(DATA, 1e-3, [Problem.CONVECTION])


def test_a_table_is_read_back(tmp_path):
    files.write_csv(DATA, Datum, tmp_path / "cost.csv", Stamp("0.1.0", "abc", "FEBio 4.11.0"))
    found = files.read_csv(tmp_path / "cost.csv", Datum)
    assert [replace(d, contact_error=0.0, ratio=0.0) for d in found] == [
        replace(d, contact_error=0.0, ratio=0.0) for d in DATA
    ]
    (tmp_path / "bad.csv").write_text("problem,parameter\n3.1,default\n")
    with pytest.raises(DataFileError, match=r"bad\.csv is no table of Datum"):
        files.read_csv(tmp_path / "bad.csv", Datum)


def test_what_comes_with_the_documentation_can_be_asked():
    data = files.read_csv(command.DATA, Datum)
    measured = [problem for problem in Problem if any(d.problem == problem.value for d in data)]
    assert measured[:2] == [Problem.DIFFUSION, Problem.CONVECTION]
    for problem in measured:
        assert "leave the defaults" in command.answer(data, 1.0, [problem]) or "set " in command.answer(
            data, 1.0, [problem]
        )


def test_every_point_has_a_model_and_a_name_of_its_own():
    chosen = points(list(Problem))
    names = {point.name for point in chosen}
    assert len(names) == len(chosen)
    for point in chosen:
        assert point.model().contacts[0].kind == point.interface.value
    assert {p.interface for p in chosen if p.parameter in OWN} == {InterfaceType.MIXTURE}


def test_short_runs_alone_are_repeated_for_their_times(monkeypatch):
    asked: list[str] = []

    def execute(model):
        asked.append(model)
        return engine.Run(Path(), None, "", 0.0, 2.0 + len(asked)), ""

    monkeypatch.setattr(timing_of_runs, "execute", execute)
    runs = {name: RunResult(name, Path(), None, 0.0, cpu) for name, cpu in (("a", 1.0), ("long", 50.0), ("b", 2.0))}
    times = timing_of_runs.in_turn(runs, 3)
    assert asked == ["a", "b", "a", "b"]
    assert times == {"a": [1.0, 3.0, 5.0], "long": [50.0], "b": [2.0, 4.0, 6.0]}
    assert timing_of_runs.spread(times["a"]) == (3.0, 1.0, 5.0)


def test_the_picture_is_drawn(tmp_path):
    assert "<svg" in pareto.draw(DATA, tmp_path / "cost.svg").read_text()


def test_no_run_has_the_mesh_of_its_reference():
    """It would flatter that run: the mesh would not be in its error."""
    nodes = len(finest().mesh.nodes)
    own = [point for point in points([Problem.INDENTATION]) if point.interface is InterfaceType.MIXTURE]
    assert all(len(point.model().mesh.nodes) < nodes for point in own)
