"""What the pages of the synthetic test scenes say of runs that did not end. Needs no run."""

from __future__ import annotations

from studies import files
from studies.pages import scene_results
from studies.pages.scene_results import AT_LIMIT, UNAVAILABLE, Row, Took
from studies.stamps import Stamp

FEBIO = Took(True, 10, 30, 0, difference=0.0)
ENDED = Took(True, 10, 28, 1, difference=0.01)
STOPPED = Took(False, 4, why=AT_LIMIT)
FAILED = Took(False, 4, 90, 6, why="Max nr of reformations reached.")
RIGID = Took(False, 0, why=f"predictor is {UNAVAILABLE}; set it to 0.")
ROWS = [Row("one", "one body", FEBIO, ENDED, STOPPED, FAILED), Row("two", "two bodies", FEBIO, ENDED, ENDED, RIGID)]


def test_a_run_that_the_limit_ended_is_told_from_one_that_failed():
    one, two = scene_results.table(ROWS).splitlines()[2:]
    assert "| 28 (1) | 1.0e-02 |  | limit after 4 steps | fails after 4 steps (6) |" in one
    assert "| 28 (1) | not available |" in two
    assert scene_results.summary(ROWS).endswith("The limit stopped runs: penalties deleted 1.")


def test_the_predictor_is_compared_where_both_runs_end():
    predicted = Took(True, 10, 20, 0, difference=0.01)
    told = scene_results.summary([*ROWS, Row("three", "three bodies", FEBIO, ENDED, ENDED, predicted)])
    assert (
        "is available in 2 scenes. 1 of these complete. The 1 scenes that complete in both ways take 20 iterations"
        in told
    )


def test_results_are_read_as_they_were_written(tmp_path):
    made = scene_results.Results(Stamp("0.1.0", "abc1234", "FEBio 4.11.0", 600.0), [ROWS[0]])
    files.write_stamped(made, tmp_path / "real.json")
    read = scene_results.read(tmp_path / "real.json")
    assert read.stamp == made.stamp
    assert [repr(row) for row in read.rows] == [repr(row) for row in made.rows]
