"""The command `linear-solvers`."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import RESULTS
from studies import stamps
from studies.linear_solvers.trials import trials
from studies.options import console
from studies.pages import linear_solver_results, stamped_rows
from studies.pages.linear_solver_results import ENFORCEMENTS, SCENES, SOLVERS


def linear_solvers(
    only: Annotated[
        list[str] | None, typer.Option(help="Run only solvers of this type. The option may be repeated.")
    ] = None,
    data: Annotated[Path, typer.Option(help="Replace the rows of this file.")] = RESULTS / "linear-solvers.json",
    build: Annotated[str, typer.Option(help="Add this text to the version of FEBio, e.g. 'with SuperLU_MT'.")] = "",
) -> None:
    """Run small models with each of FEBio's linear solvers and each enforcement, and write the table.

    `--data docs/data/linear-solvers.json` measures for the documentation, and `pages` then writes its page.
    """
    types = chosen(only, sorted({solver.type for solver in SOLVERS}))
    solvers = tuple(solver for solver in SOLVERS if solver.type in types)
    stamp = stamps.stamp()
    made = [
        replace(trial, febio=f"{trial.febio} {build}".strip())
        for scene in SCENES
        for enforcement in ENFORCEMENTS
        for trial, _ in trials(scene, enforcement, RESULTS / "linear-solvers" / scene / enforcement, solvers)
    ]
    known_rows = linear_solver_results.read(data).rows if data.is_file() else []
    results = linear_solver_results.Results(stamp, linear_solver_results.renewed(known_rows, made))
    stamped_rows.write(results, data)
    console.print(linear_solver_results.table(results.rows), markup=False)
    console.print(f"Written: {data}")
