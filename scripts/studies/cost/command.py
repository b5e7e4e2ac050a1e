"""The command `cost`: measures what accuracy costs, or answers from what was measured."""

import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from harness.models.interface import InterfaceType
from harness.paths import DOCS, RESULTS
from harness.run.runner import Runner
from studies import files, stamps, workflow
from studies.cost import page, pareto, point_runs
from studies.cost.point_runs import Datum
from studies.cost.points import INTERFACES, Parameter, Problem, points
from studies.options import Docs, Snakemake, console
from studies.pages.evidence import DATA as RESULTS_OF_THE_PAGES
from studies.stamps import LIMIT

DATA = RESULTS_OF_THE_PAGES / "cost.csv"  # what was measured, as it comes with the documentation


def cost(
    error: Annotated[
        float | None, typer.Option(min=0.0, help="Name settings for this error instead of a measurement.")
    ] = None,
    problem: Annotated[
        list[Problem] | None, typer.Option(help="Measure only this problem. The option may be repeated.")
    ] = None,
    data: Annotated[Path, typer.Option(help="Read answers from this file.")] = DATA,
    folder: Annotated[Path, typer.Option(help="Write measurements and pictures to this folder.")] = RESULTS / "cost",
    jobs: Annotated[
        int, typer.Option(min=1, help="Number of simultaneous runs; more than one distorts the times.")
    ] = 1,
    docs: Docs = False,
    snakemake: Snakemake = None,
) -> None:
    """Measure error and time for all parameters, problems and interfaces, or name settings for an error (--error).

    The measurement takes some hundreds of runs. The command continues with the missing runs after an interruption.
    """
    chosen = problem or list(Problem)
    if error is not None:
        console.print(answer(files.read_csv(data, Datum), error, chosen), markup=False)
        return
    if not _sweep(chosen, folder, jobs, snakemake or ()):
        raise typer.Exit(1)
    if docs:
        _write_docs(folder)


def _write_docs(folder: Path) -> None:
    """The page of the documentation, with what the sweep left in `folder`."""
    shutil.copy(folder / DATA.name, DATA)
    pareto.draw(files.read_csv(DATA, Datum), DOCS / page.PICTURE)
    console.print(f"Written: {DATA}, {DOCS / page.PICTURE}, {page.PAGE.write()}")


def _sweep(chosen: list[Problem], folder: Path, jobs: int, options: Sequence[str]) -> bool:
    """Make all runs, write what they give, and return whether no run is missing."""
    sweeps = dict.fromkeys((point.problem, point.interface, point.parameter) for point in points(chosen))
    wanted = {
        f"{problem.value}-{interface.slug}-{parameter.name.lower()}": ("cost-sweep", *(part.value for part in sweep))
        for sweep in sweeps
        for problem, interface, parameter in [sweep]
    }
    paths = workflow.run(wanted, folder.resolve(), cores=jobs, options=options)
    found = [datum for path in paths for datum in files.read_json(path, Datum)]
    files.write_csv(found, Datum, folder / "cost.csv", stamps.stamp(LIMIT))
    written = [folder / "cost.csv", pareto.draw(found, folder / "cost.svg")]
    console.print(pareto.comparison(found), markup=False)
    console.print("Written: " + ", ".join(map(str, written)))
    return len(paths) == len(sweeps)


def cost_sweep(
    problem: Problem,
    interface: InterfaceType,
    parameter: Parameter,
    out: Annotated[Path, typer.Option(help="Write the data to this file, as JSON.")] = Path("sweep.json"),
) -> None:
    """Measure one problem with one interface for several values of one parameter."""
    runner = Runner(RESULTS / "cost" / "runs", processor_limit=LIMIT)
    chosen = [point for point in points([problem]) if (point.interface, point.parameter) == (interface, parameter)]
    files.write_json(point_runs.measure(chosen, runner), out)


def answer(data: list[Datum], error: float, problems: list[Problem]) -> str:
    """What to set for an error, and what it costs, for each problem and interface."""
    lines = []
    for problem in problems:
        own = pareto.comparable(data, problem)
        other = "finest run" if problem is Problem.INDENTATION else "conforming reference"
        lines.append(f"Problem {problem.value}, difference from the {other} at most {error:g}:")
        for interface in INTERFACES:
            best = pareto.cheapest([d for d in own if d.interface == interface.value], error)
            lines.append(
                f"  {interface.value}: {_setting(best) if best else 'no setting that was measured reaches it'}"
            )
    return "\n".join(lines)


def _setting(datum: Datum) -> str:
    unit = "s" if datum.problem == Problem.INDENTATION.value else "times the conforming reference's time"
    parameters = " ".join(f"<{p.tag}>{_text(p.value)}</{p.tag}>" for p in point_runs.settings_of(datum))
    if datum.parameter == Parameter.NEWTON.value:
        parameters += f" and dtol, ptol, ctol {datum.value:g} in the solver"
    what = "leave the defaults" if not parameters else f"set {parameters.strip()}"
    return (
        f"{what}: error {pareto.error_of(datum):.1e}, {datum.iterations} iterations, {datum.residuals} residuals, "
        f"{pareto.cost_of(datum):.2f} {unit}"
    )


def _text(value: object) -> str:
    return str(int(value)) if isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else str(value)
