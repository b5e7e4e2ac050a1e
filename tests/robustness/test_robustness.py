"""The command `robustness`: what it makes of a model, what it catches, and what it calls a fault."""

from __future__ import annotations

import threading
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.paths import MODELS
from harness.run import engine
from harness.run.logdata import History
from harness.user_commands import commands
from studies import feb
from studies.cli import COMMANDS
from studies.robustness import archives, differences, sanitized, solvers, trial, variations
from studies.robustness.execution import Way
from studies.robustness.sanitized import Plugin
from studies.robustness.trial import Trial

STEPS = 4


@pytest.fixture(scope="module")
def way():
    """The plugin of the build: what the command does with it does not depend on its being sanitized."""
    try:
        engine.find_engine()
        return Way(Plugin(engine.required_plugin()), timeout=120.0)
    except (EngineNotFoundError, PluginNotFoundError) as error:
        pytest.skip(str(error))


def history(values, times=(0.0, 1.0)):
    table = np.asarray(values, dtype=float).reshape(len(times), 1, 4)
    return History(np.array(times), np.array([1]), ("ux", "uy", "uz", "p"), table)


def test_a_model_in_all_variations(way, tmp_path):
    findings = list(Trial(feb.read(MODELS / "confined-creep.feb"), way, tmp_path / "runs", STEPS).findings())
    assert [found.variation for found in findings] == ["as it is", "2 threads", "restarted", "cut back", "few matrices"]
    assert [found.faults for found in findings] == [()] * 5
    restarted, cut_back = findings[2], findings[3]
    assert restarted.note == "1 times"
    assert cut_back.retries >= 1
    assert all(found.difference is not None for found in findings[1:])


def test_a_run_that_does_not_end_is_a_fault(way, tmp_path):
    short = replace(way, timeout=0.001)
    (found,) = Trial(feb.read(MODELS / "confined-creep.feb"), short, tmp_path / "runs", STEPS).findings()
    assert found.ended == "took too long"
    assert not found.passed


def test_another_solution_is_a_fault(way, tmp_path, monkeypatch):
    """Where the steps of the second run are others, its states are, too."""
    moved = lambda model, times: variations.shortened(model, 0.5 * times[-1])  # noqa: E731
    monkeypatch.setattr(trial.variations, "with_times", moved)
    findings = list(Trial(feb.read(MODELS / "confined-creep.feb"), way, tmp_path / "runs", STEPS).findings())
    assert [found.variation for found in findings if found.faults] == ["cut back", "few matrices"]


@pytest.mark.parametrize("solver", solvers.SOLVERS)
def test_each_solver_reads_the_elastic_scene(way, tmp_path, solver):
    """febio4 takes the model; how far it gets is for the command to say."""
    run = trial.execution.run(solvers.solved_by(solvers.elastic(), solver), tmp_path, way)
    screen = (run.folder / sanitized.SCREEN).read_text(errors="replace")
    assert "elastic.feb ...SUCCESS!" in screen


def test_differences_are_relative_to_the_largest_component_of_a_vector():
    old = history([[0, 0, 0, 0], [1e-9, 0, 2.0, 0.5]])
    new = history([[0, 0, 0, 0], [3e-9, 0, 2.0, 0.5]])
    assert differences.largest(new, old) == pytest.approx(1e-9)


def test_a_variable_that_is_zero_to_rounding_does_not_count():
    old = history([[0, 0, 1.0, 1e-18], [0, 0, 1.0, 0]])
    new = history([[0, 0, 1.0, 0], [0, 0, 1.0, -1e-18]])
    assert differences.largest(new, old) < 1e-11


def test_other_times_and_numbers_that_are_none_are_infinitely_far():
    old = history([[0, 0, 0, 0], [0, 0, 1.0, 0]])
    assert differences.largest(history(old.values, (0.0, 0.9)), old) == float("inf")
    assert differences.largest(history([[0, 0, 0, 0], [0, 0, np.nan, 0]]), old) == float("inf")


def test_each_third_step_is_to_fail_once():
    made = variations.cut_back(feb.read(MODELS / "confined-creep.feb"), 20.0)
    points = [text.split(",") for text in made.root.xpath("//load_controller[last()]//pt/text()")]
    none = sorted({round(float(time)) for time, value in points if float(value) < 1.0})
    assert none[:2] == [20, 70]  # 20 fails, then 10, 30, 50; 70 fails


def test_a_model_is_shortened_to_a_time():
    made = variations.shortened(feb.read(MODELS / "confined-creep.feb"), 60.0)
    assert variations.end_of(made) == 60.0


def test_the_first_archive_is_caught_and_later_ones_do_not_block(tmp_path):
    path = tmp_path / "model.dmp"

    def dump():
        for content in (b"first" * 50_000, b"second"):
            path.write_bytes(content)

    with archives.first_archive(path) as caught:
        writer = threading.Thread(target=dump)
        writer.start()
        writer.join(timeout=10.0)
    assert not writer.is_alive()
    assert caught[0].startswith(b"first" * 50_000)


def test_reports_of_the_sanitizers_are_found(tmp_path):
    (tmp_path / "sanitizer.1").write_text("==1==ERROR\nSUMMARY: AddressSanitizer: heap-buffer-overflow x.cpp:1 in f\n")
    (tmp_path / sanitized.SCREEN).write_text("x.cpp:2:3: runtime error: division by zero\n")
    assert sanitized.reports(tmp_path) == ("heap-buffer-overflow x.cpp:1 in f", "division by zero")


def test_leaks_of_febio_are_not_those_of_the_plugin(tmp_path):
    leak = "Direct leak of {} byte(s) in 1 object(s) allocated from:\n    #0 new\n    #1 f (/x/{}+0x1)\n\n"
    leaks = leak.format(24, "libFEBioMixtureContact.so") + leak.format(80, "libfecore.so")
    (tmp_path / "sanitizer.1").write_text(f"{leaks}SUMMARY: AddressSanitizer: 104 byte(s) leaked in 2 allocation(s).\n")
    (tmp_path / sanitized.SCREEN).write_text("")
    assert sanitized.lost_bytes(tmp_path) == 24
    assert sanitized.reports(tmp_path) == ()


def test_an_unknown_model_is_named():
    done = CliRunner().invoke(commands(COMMANDS), ["robustness", "--only", "no-such-model"])
    assert done.exit_code != 0
    assert "no-such-model" in done.output
