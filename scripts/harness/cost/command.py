"""The command `cost`: measures what accuracy costs, or answers from what was measured."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness import workflow
from harness.cost import measure, report
from harness.cost.measure import Datum
from harness.cost.points import INTERFACES, Knob, Problem, points
from harness.models.interface import Join
from harness.paths import REPOSITORY, RESULTS
from harness.runner import Runner

console = Console(highlight=False, soft_wrap=True)
DATA = REPOSITORY / "docs" / "data" / "cost.csv"
"""What was measured, as it comes with the documentation."""
TIMEOUT = 120.0
"""s of wall time for one run."""


def cost(
    error: Annotated[float | None, typer.Option(min=0.0, help="Answer for this error instead of measuring.")] = None,
    problem: Annotated[list[Problem] | None, typer.Option(help="This problem alone; may be repeated.")] = None,
    data: Annotated[Path, typer.Option(help="Where answers come from.")] = DATA,
    folder: Annotated[Path, typer.Option(help="Where measurements and pictures go.")] = RESULTS / "cost",
    jobs: Annotated[int, typer.Option(min=1, help="Runs at a time; more than one disturbs the times.")] = 1,
    snakemake: Annotated[list[str] | None, typer.Argument(help="Further options of Snakemake, after --.")] = None,
) -> None:
    """Measure error and cost over all knobs, problems and interfaces; or, with --error, say what to set at what cost.

    The measurement is some two hundred runs; one that was interrupted goes on where it was.
    """
    chosen = problem or list(Problem)
    if error is not None:
        console.print(answer(measure.read_csv(data), error, chosen), markup=False)
        return
    sweeps = dict.fromkeys((point.problem, point.interface, point.knob) for point in points(chosen))
    wanted = {
        f"{problem.value}-{interface.slug}-{knob.name.lower()}": (
            "cost-sweep",
            problem.value,
            interface.value,
            knob.value,
        )
        for problem, interface, knob in sweeps
    }
    paths = workflow.run(wanted, folder.resolve(), cores=jobs, options=snakemake or ())
    found = [datum for path in paths for datum in measure.read_json(path)]
    comment = "FEBio 4.11, one thread; scripts/mixcontact cost; columns are explained in docs/cost.md"
    measure.write_csv(found, folder / "cost.csv", comment)
    (folder / "cost.md").write_text(f"{report.comparison(found)}\n\n{report.table(found)}\n")
    written = [folder / "cost.csv", folder / "cost.md", *report.draw(found, folder)]
    console.print(report.comparison(found), markup=False)
    console.print("Written: " + ", ".join(map(str, written)))
    if len(paths) < len(wanted):
        raise typer.Exit(1)


def cost_sweep(
    problem: Problem,
    interface: Join,
    knob: Knob,
    out: Annotated[Path, typer.Option(help="Where the data go, as JSON.")] = Path("sweep.json"),
) -> None:
    """Measure one problem with one interface, one knob varied."""
    runner = Runner(RESULTS / "cost" / "runs", timeout=TIMEOUT)
    chosen = [point for point in points([problem]) if (point.interface, point.knob) == (interface, knob)]
    measure.write_json([measure.measure(point, runner) for point in chosen], out)


def answer(data: list[Datum], error: float, problems: list[Problem]) -> str:
    """What to set for an error, and what it costs, for each problem and interface."""
    lines = []
    for problem in problems:
        own = report.comparable(data, problem)
        what = "difference from the finest run" if problem is Problem.INDENTATION else "difference from the uncut body"
        lines.append(f"Problem {problem.value}, {what} at most {error:g}:")
        for interface in INTERFACES:
            best = report.cheapest([d for d in own if d.interface == interface.value], error)
            lines.append(
                f"  {interface.value}: {_setting(best) if best else 'no setting that was measured reaches it'}"
            )
    return "\n".join(lines)


def _setting(datum: Datum) -> str:
    unit = "s" if datum.problem == Problem.INDENTATION.value else "times the uncut body's time"
    parameters = " ".join(f"<{p.tag}>{_text(p.value)}</{p.tag}>" for p in measure.settings_of(datum))
    if datum.knob == Knob.NEWTON.value:
        parameters += f" and dtol, ptol, ctol {datum.value:g} in the solver"
    what = "leave the defaults" if not parameters else f"set {parameters.strip()}"
    return (
        f"{what}: error {report.error_of(datum):.1e}, {datum.iterations} iterations, {datum.residuals} residuals, "
        f"{report.cost_of(datum):.2f} {unit}"
    )


def _text(value: object) -> str:
    return str(int(value)) if isinstance(value, bool) else f"{value:g}" if isinstance(value, float) else str(value)
