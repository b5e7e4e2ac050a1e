"""The command `linear-solvers`, and its runs."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from lxml import etree

from harness.choice import chosen
from harness.models.confined import Confined
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.interface import ContactSettings
from harness.models.parts import Control
from harness.paths import RESULTS
from harness.run import engine, logdata, provenance
from studies import feb, files, stamps
from studies.options import console
from studies.pages import linear_solver_results
from studies.pages.linear_solver_results import ENFORCEMENTS, SCENES, SOLVERS, Outcome, Solver, Trial

TOLERANCE = 1e-3
"""Of the last state, relative to the largest value of each kind: FEBio's tolerance on the change of a step."""
TIMEOUT = 120.0  # s of wall time for one run
REFERENCE = SOLVERS[0]
SYMMETRIC_ONLY = frozenset({"skyline"})  # types that take no other matrix in any build
MODELS: Mapping[str, Diffusion | Confined] = {
    "diffusion": Diffusion(elements=3, control=Control(3, 200.0)),
    "creep": Confined(elements=3, control=Control(3, 10.0)),
}
"""Two cubes through which a solute diffuses (3.1), a biphasic layer under a load."""


def write(model: str, solver: Solver, folder: Path) -> Path:
    """Write the text of a model with this solver."""
    made = feb.parsed("model", model)
    for tag in made.root.iter("solver"):
        chosen = etree.SubElement(tag, "linear_solver", type=solver.type)
        if solver.preconditioner:
            etree.SubElement(chosen, "pc_left", type=solver.preconditioner)
    return made.write(folder)


def outcome(run: engine.Run, solver: Solver, difference: float) -> Outcome:
    """How a run ended, by what FEBio said."""
    if run.report.normal:
        return Outcome.SOLVED if difference <= TOLERANCE else Outcome.OTHER_RESULT
    if "does not support the requested matrix" in run.output:
        return Outcome.SYMMETRIC_ONLY if solver.type in SYMMETRIC_ONLY else Outcome.UNAVAILABLE
    return Outcome.NO_SOLUTION if "Linear solver failed to find solution" in run.output else Outcome.NOT_CONVERGED


def trials(
    scene: str, enforcement: str, folder: Path, solvers: tuple[Solver, ...] = SOLVERS
) -> Iterator[tuple[Trial, engine.Run]]:
    """Solve a scene by each solver, after the reference."""
    model = replace(MODELS[scene], settings=ContactSettings(laugon=enforcement)).model()
    expected = _run(model, REFERENCE, folder / REFERENCE.type)[1]
    for solver in solvers:
        run, found = _run(model, solver, folder / f"{solver.type}-{solver.preconditioner}")
        difference = _difference(found, expected)
        ended = outcome(run, solver, difference)
        made = (provenance.engine_version(run.output), stamps.plugin_commit())
        kind = (scene, solver.type, solver.preconditioner, enforcement)
        yield Trial(*kind, ended.value, difference if run.report.normal else math.nan, *made), run


def _run(model: Model, solver: Solver, folder: Path) -> tuple[engine.Run, np.ndarray | None]:
    """A run, and its last state where it ended normally."""
    path = write(model.text(), solver, folder)
    command = engine.command(path, engine.required_plugin())
    run = engine.execute(command, folder, check=False, timeout=TIMEOUT)
    if not run.report.normal:
        return run, None
    history = logdata.read_history(folder / model.node_file, model.node_columns)
    return run, np.stack([history[name][-1] for name in model.node_columns])


def _difference(found: np.ndarray | None, expected: np.ndarray | None) -> float:
    """The largest, of all kinds of values, relative to the largest of its kind."""
    if found is None or expected is None:
        return math.nan
    largest = np.abs(expected).max(axis=1, keepdims=True)
    return float((np.abs(found - expected) / np.where(largest > 0, largest, 1.0)).max())


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
    files.write_stamped(results, data)
    console.print(linear_solver_results.table(results.rows), markup=False)
    console.print(f"Written: {data}")
