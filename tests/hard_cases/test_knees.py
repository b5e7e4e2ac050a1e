"""The table and the headline of the page of the knee."""

from __future__ import annotations

from dataclasses import replace

from harness.models.interface import InterfaceType
from studies.knees import page
from studies.knees.knee_run import KneeRun, Way

OURS = KneeRun(
    bodies="elastic",
    load="stance",
    size="small",
    contact=InterfaceType.MIXTURE.value,
    factor=0.0,
    ended=True,
    limited=False,
    reached=0.2,
    steps=10,
    iterations=60,
    retries=0,
    seconds=80.0,
    memory=300.0,
    force_medial=400.0,
    force_lateral=300.0,
    area_medial=700.0,
    area_lateral=600.0,
    peak_medial=5.0,
    peak_lateral=3.0,
    overlap=0.001,
)
THEIRS = replace(
    OURS, contact=InterfaceType.ELASTIC.value, factor=1.0, iterations=40, seconds=40.0, memory=200.0, overlap=0.1
)


def test_the_table_compares_with_the_runs_of_fewest_iterations_and_of_least_overlap() -> None:
    tight = replace(THEIRS, factor=100.0, iterations=120, seconds=160.0, overlap=0.01)
    runs = [OURS, THEIRS, tight]
    assert "completes 1 of 1 runs. FEBio's interfaces complete 2 of 2" in page.headline(runs)
    fewest, least = page.compared(runs).splitlines()[2:]
    assert fewest == "| stance, small | fewest iterations | 1.50 | 2.00 | 1.50 | 0.01 |"
    assert least.startswith("| stance, small | least overlap | 0.50 | 0.50 |")
    assert least.endswith("| 0.1 |")


def test_the_table_compares_nothing_where_a_run_fails() -> None:
    runs = [OURS, replace(THEIRS, ended=False)]
    assert "FEBio's interfaces complete 0 of 1" in page.headline(runs)
    assert page.compared(runs).splitlines()[2:] == ["| stance, small | none completes | - | - | - | - |"]


def test_the_fluid_bears_a_part_of_the_load_on_porous_knees() -> None:
    biphasic = replace(OURS, bodies="biphasic", fluid_most=0.96, fluid_last=0.9)
    assert page.compartments([biphasic]).endswith("| 0.0010 | 0.960, 0.900 |")


def test_tables_have_a_row_for_each_run() -> None:
    runs = [OURS, replace(THEIRS, ended=False, limited=True), replace(THEIRS, ended=False)]
    rows = page.table(runs).splitlines()[2:]
    assert rows[0] == "| stance, small | `sliding-mixture` | yes | 0.2 | 10 | 60 | 0 | 80 | 300 |"
    assert "no, at the limit of time" in rows[1]
    assert "| `sliding-elastic` × 1 | no |" in rows[2]
    assert page.compartments(runs).splitlines()[2].endswith("| 400, 300 | 700, 600 | 5.00, 3.00 | 0.0010 | - |")


def test_answers_have_their_differences_from_the_defaults() -> None:
    other = replace(OURS, iterations=70, force_medial=404.0, peak_lateral=2.97)
    defaults, augmented = page.answers({Way.DEFAULTS: OURS, Way.AUGLAG: other}).splitlines()[2:]
    assert defaults == "| defaults | 60 | 0 | 400.0, 300.0 | 0.00, 0.00 | 5.00, 3.00 | 0.00, 0.00 |"
    assert augmented == "| `AUGLAG` | 70 | 0 | 404.0, 300.0 | 1.00, 0.00 | 5.00, 2.97 | 0.00, -1.00 |"
