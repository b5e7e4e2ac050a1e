"""Reading what febio4 writes, and what the harness writes itself; no run is needed."""

from __future__ import annotations

import math
import sys

import numpy as np
import pytest

from harness.errors import DataFileError, EngineFailedError, EngineNotFoundError
from harness.post.compare import Measure, missed, observed_order
from harness.run import engine, febio_log, logdata
from harness.validate import figures, results

INFORMATION = """
 N O N L I N E A R   I T E R A T I O N   I N F O R M A T I O N

	Number of time steps completed .................... : {}

	Total number of equilibrium iterations ............ : {}

	Average number of equilibrium iterations .......... : 1.3025

	Total number of right hand evaluations ............ : {}

	Total number of stiffness reformations ............ : {}
"""
TOTAL = INFORMATION.replace("I N F O R M A T I O N", "S U M M A R Y").replace("INFORMATION", "SUMMARY")
NORMAL = "\n N O R M A L   T E R M I N A T I O N\n"
BOX = """
 *************************************************************************
 *                                {}                                  *
 * First line,                                                           *
 * second line.                                                          *
 *************************************************************************
"""


def test_counts_of_one_step():
    report = febio_log.parse(INFORMATION.format(400, 521, 921, 520) + NORMAL)
    assert (report.normal, report.steps, report.iterations) == (True, 400, 521)
    assert (report.residuals, report.reformations, report.retries) == (921, 520, 0)


def test_counts_of_several_steps_are_summed_once():
    text = INFORMATION.format(10, 20, 30, 40) + INFORMATION.format(1, 2, 3, 4) + TOTAL.format(11, 22, 33, 44)
    report = febio_log.parse(text)
    assert (report.steps, report.iterations, report.residuals, report.reformations) == (11, 22, 33, 44)


def test_a_run_that_was_broken_off():
    text = "\n------- converged at time : 20\n\nRetrying time step. Retry attempt 1 of max 5\n" + BOX.format("ERROR")
    report = febio_log.parse(text)
    assert (report.normal, report.steps, report.retries) == (False, 1, 1)
    assert report.errors == ("First line, second line.",)
    assert report.warnings == ()


def test_warnings_are_kept_once_and_fatal_errors_are_errors():
    report = febio_log.parse(BOX.format("WARNING") * 3 + "FATAL ERROR: no such tag\n")
    assert report.warnings == ("First line, second line.",)
    assert report.errors == ("no such tag",)


DATA = """*Step  = 0
*Time  = 0
*Data  = x;c1
1 0.5 0
2 1.5 1e-3
*Step  = 1
*Time  = 20
*Data  = x;c1
1 0.5 0.25
2 1.5 -2.5e-07
"""


def test_node_data(tmp_path):
    path = tmp_path / "nodes.txt"
    path.write_text(DATA)
    history = logdata.read_history(path, ("x", "c1"))
    assert history.values.shape == (2, 2, 2)
    np.testing.assert_array_equal(history["c1"], [[0.0, 1e-3], [0.25, -2.5e-7]])
    assert history.at(20.0) == 1
    with pytest.raises(DataFileError, match=r"no data at t = 10 s; the nearest is at"):
        history.at(10.0)
    with pytest.raises(KeyError, match="no data 'p'; there is x, c1"):
        history["p"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "holds no data"),
        ("1 2 3\n", r"line 1: data before the first '\*Time' line"),
        ("*Time = soon\n", r"line 1: expected '\*Time = <number>', found '\*Time = soon'"),
        (DATA + "3 0 0\n", "3 lines at t = 20 s, 2 at t = 0 s"),
        (DATA.replace("1 0.5 0\n", "1 0.5\n"), r"expected 3 numbers a line \(item, x, c1\)"),
        (DATA.replace("1e-3", "much"), "much"),
    ],
)
def test_bad_node_data_are_explained(tmp_path, text, message):
    path = tmp_path / "nodes.txt"
    path.write_text(text)
    with pytest.raises(DataFileError, match=message) as raised:
        logdata.read_history(path, ("x", "c1"))
    assert str(path) in str(raised.value)


def test_missing_data_are_explained(tmp_path):
    with pytest.raises(DataFileError, match="cannot read the data file"):
        logdata.read_history(tmp_path / "nodes.txt", ("x",))


def test_results_survive_writing_and_reading(tmp_path):
    measures = [Measure("a", 1.0, 2.0), Measure("b", 1.0, 2.0, lowest=0.5, note="n")]
    written = results.Results("sliding-mixture", {"check": measures}, {"other": "no febio4"})
    written.profiles.append(results.Profile(figures.CONVECTION, 1.0, [-1.0, 1.0], [1.0, 0.0]))
    assert results.read(written.write(tmp_path)) == written


def test_a_failed_run_is_kept_as_null(tmp_path):
    path = results.Results("sliding-mixture", {"check": [Measure("a", math.nan, 0.0)]}).write(tmp_path)
    assert "NaN" not in path.read_text()
    assert math.isnan(results.read(path).checks["check"][0].value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "line 1: is not JSON"),
        ("[]", "'format' must be 1"),
        ('{"format": 0}', "'format' must be 1"),
        ('{"format": 1, "checks": {}}', "an entry is missing or unknown"),
        ('{"format": 1, "checks": {"a": [{"colour": 1}]}}', "an entry is missing or unknown"),
    ],
)
def test_bad_results_are_explained(tmp_path, text, message):
    path = tmp_path / "validation.json"
    path.write_text(text)
    with pytest.raises(DataFileError, match=message) as raised:
        results.read(path)
    assert str(path) in str(raised.value)


def test_figures_are_drawn_without_a_simulation(tmp_path):
    for path in figures.draw([], tmp_path):
        assert path.read_bytes().startswith(b"\x89PNG")


def test_measures():
    assert Measure("a", 1.0, 1.0).passed
    assert not Measure("a", math.nan, 1.0).passed
    assert not Measure("a", 1.0, 2.0, lowest=1.5).passed
    assert missed([Measure("a", 1.0, 1.0), Measure("b", 3.0, 1.0)]) == ["b: 3, not within [-inf, 1] "]
    assert observed_order(4e-2, 1e-2) == pytest.approx(2.0)


def test_no_engine_is_explained(monkeypatch, tmp_path):
    for variable in ("FEBIO_ROOT", "HOME", "PATH"):
        monkeypatch.setenv(variable, str(tmp_path))
    with pytest.raises(EngineNotFoundError, match="Set FEBIO_ROOT") as raised:
        engine.find_engine()
    assert f"looked in {tmp_path}," in str(raised.value)


@pytest.mark.skipif(sys.platform != "linux", reason="other systems tell the larger one of a process and its parent")
def test_the_memory_of_a_run_is_not_that_of_its_parent(tmp_path):
    held = np.ones(40_000_000)
    said = "import time; print('------- converged at time : 1', flush=True); time.sleep(1)"
    run = engine.execute([sys.executable, "-c", said], tmp_path, check=False)
    assert 0.0 < run.memory < held.nbytes / 2e6


def test_a_failed_run_quotes_the_engine(tmp_path):
    script = tmp_path / "engine"
    script.write_text("#!/bin/sh\necho 'FATAL ERROR: unknown contact'\nexit 3\n")
    script.chmod(0o755)
    with pytest.raises(EngineFailedError, match=r"exit code 3(.|\n)*FEBio says: unknown contact"):
        engine.execute([str(script)], tmp_path)
