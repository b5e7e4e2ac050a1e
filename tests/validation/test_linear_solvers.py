"""FEBio's linear solvers do what the documentation says of them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from harness.models.interface import ContactSettings
from harness.paths import DOCS
from harness.run import engine
from harness.run.febio_log import Report
from studies.linear_solvers.command import MODELS, SYMMETRIC_ONLY, outcome, trials
from studies.pages import linear_solver_results
from studies.pages.linear_solver_results import ENFORCEMENTS, SCENES, SOLVERS, Outcome, Results, Solver, Trial, renewed
from studies.stamps import Stamp

MEASURED = {trial.cell: trial.outcome for trial in linear_solver_results.read(DOCS / linear_solver_results.DATA).rows}
QUICK = ("creep", "LAGMULT")


def test_every_cell_of_the_table_is_measured():
    cells = {(s, e, solver.type, solver.preconditioner) for s in SCENES for e in ENFORCEMENTS for solver in SOLVERS}
    assert set(MEASURED) == cells
    assert set(MODELS) == set(SCENES)


@pytest.mark.mixture_only
@pytest.mark.parametrize(
    ("scene", "enforcement"),
    [
        pytest.param(scene, enforcement, marks=() if (scene, enforcement) == QUICK else pytest.mark.slow)
        for scene in SCENES
        for enforcement in ENFORCEMENTS
    ],
)
def test_solvers_end_as_in_the_table(scene, enforcement, runner, tmp_path):
    """Those that this FEBio was built with; the log warns of a solver for symmetric matrices.

    Incomplete factorisations of matrices with zeros on the diagonal depend on rounding, and so on the machine: they
    either solve the model as the others do, or fail.
    """
    for trial, run in trials(scene, enforcement, tmp_path):
        if trial.outcome != Outcome.UNAVAILABLE:
            expected = MEASURED[scene, enforcement, trial.solver, trial.preconditioner]
            name = f"{trial.solver} {trial.preconditioner}"
            if enforcement == "LAGMULT" and trial.preconditioner:
                assert trial.outcome != Outcome.OTHER_RESULT, name
            else:
                assert trial.outcome == expected, name
        warned = "solves symmetric matrices only" in run.output
        assert warned == (trial.solver in SYMMETRIC_ONLY)


@pytest.mark.mixture_only
def test_the_log_judges_the_solver_that_febio_takes_by_default(runner, tmp_path):
    model = replace(MODELS["creep"], settings=ContactSettings(laugon="PENALTY")).model().write(tmp_path)
    settings = tmp_path / "febio.xml"
    settings.write_text(
        '<?xml version="1.0" encoding="ISO-8859-1"?>\n<febio_config version="3.0">\n'
        '<default_linear_solver type="skyline"></default_linear_solver>\n</febio_config>\n'
    )
    command = engine.command(model, engine.required_plugin(), ["-config", settings.name])
    assert (
        "the linear solver 'skyline' solves symmetric matrices only"
        in engine.execute(command, tmp_path, check=False).output
    )


def test_rows_stay_where_this_febio_lacks_the_solver():
    old = Trial("creep", "superlu_mt", "", "LAGMULT", Outcome.SOLVED.value, 1e-9, "FEBio with SuperLU_MT", "abc1234")
    lacking = replace(old, outcome=Outcome.UNAVAILABLE.value, febio="FEBio 4.11.0", commit="def5678")
    solved = replace(lacking, outcome=Outcome.SOLVED.value)
    assert renewed([old], [lacking]) == [old]
    assert renewed([old], [solved]) == [solved]
    assert renewed([], [lacking]) == [lacking]
    told = linear_solver_results.page(Results(Stamp("0.1.0", "def5678", "FEBio 4.11.0"), [old]))
    assert "Some rows used other programs: `superlu_mt` with FEBio with SuperLU_MT, plugin at commit abc1234." in told


def ended(output: str, normal: bool = False) -> engine.Run:
    return engine.Run(DOCS, Report(normal, 0, 0, 0, 0, 0, 0), output, 0.0, 0.0)


def test_ends_are_told_apart():
    unsupported = "The selected linear solver does not support the requested matrix"
    assert outcome(ended("", normal=True), Solver("pardiso"), 1e-9) == Outcome.SOLVED
    assert outcome(ended("", normal=True), Solver("pardiso"), 1e-2) == Outcome.OTHER_RESULT
    assert outcome(ended(unsupported), Solver("superlu_mt"), 0) == Outcome.UNAVAILABLE
    assert outcome(ended(unsupported), Solver("skyline"), 0) == Outcome.SYMMETRIC_ONLY
    assert outcome(ended("Linear solver failed to find solution"), Solver("fgmres"), 0) == Outcome.NO_SOLUTION
    assert outcome(ended("Max nr of reformations"), Solver("fgmres"), 0) == Outcome.NOT_CONVERGED
