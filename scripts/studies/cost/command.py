"""The command `cost`: measures what accuracy costs, or answers from what was measured."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.errors import HarnessError
from harness.models.interface import InterfaceType
from harness.paths import DOCS, RESULTS
from harness.run.runner import Runner
from studies import files, stamps, workflow
from studies.cost import interleaved, page, pareto, point_runs
from studies.cost.interleaved import Timing
from studies.cost.point_runs import Datum
from studies.cost.points import INTERFACES, Parameter, Problem, points
from studies.pages.evidence import DATA as RESULTS_OF_THE_PAGES
from studies.stamps import LIMIT

console = Console(highlight=False, soft_wrap=True)
DATA = RESULTS_OF_THE_PAGES / "cost.csv"
"""What was measured, as it comes with the documentation."""


class Part(str, Enum):
    """What there is to measure."""

    SWEEP = "sweep"
    """Error and cost over all parameters."""
    INTERLEAVED = "interleaved"
    """Longer runs of 3.1 and 3.2 by all interfaces in turn, with the settings that reach each error at least cost."""


def cost(
    error: Annotated[
        float | None, typer.Option(min=0.0, help="Name settings for this error instead of a measurement.")
    ] = None,
    problem: Annotated[
        list[Problem] | None, typer.Option(help="Measure only this problem. The option may be repeated.")
    ] = None,
    data: Annotated[
        Path, typer.Option(help="Read answers from this file, and the settings that the command times in turn.")
    ] = DATA,
    only: Annotated[list[Part] | None, typer.Option(help="Measure only this part. The option may be repeated.")] = None,
    number: Annotated[
        int, typer.Option("--rounds", min=1, help="Number of rounds in which the command times all interfaces in turn.")
    ] = 9,
    folder: Annotated[Path, typer.Option(help="Write measurements and pictures to this folder.")] = RESULTS / "cost",
    jobs: Annotated[
        int, typer.Option(min=1, help="Number of simultaneous runs; more than one distorts the times.")
    ] = 1,
    docs: Annotated[bool, typer.Option("--docs", help="Also write the page of the documentation.")] = False,
    snakemake: Annotated[list[str] | None, typer.Argument(help="Options for Snakemake, after --.")] = None,
) -> None:
    """Measure error and time for all parameters, problems and interfaces, or name settings for an error (--error).

    The measurement takes some hundreds of runs. After an interruption, the command continues with the missing runs.
    """
    chosen = problem or list(Problem)
    if error is not None:
        console.print(answer(files.read_csv(data, Datum), error, chosen), markup=False)
        return
    start = partial(workflow.run, folder=folder.resolve(), cores=jobs, options=snakemake or ())
    if only is None or Part.SWEEP in only:
        _sweep(chosen, folder, start)
        if docs:
            _write_docs(folder)
    if only is None or Part.INTERLEAVED in only:
        _interleaved(chosen, number, data.resolve(), folder, start)


Start = Callable[[Mapping[str, Sequence[str]]], list[Path]]
"""Does jobs of the harness, by their names, and returns the files that they wrote."""


def _write_docs(folder: Path) -> None:
    """The page of the documentation, with what the sweep left in `folder`."""
    shutil.copy(folder / DATA.name, DATA)
    pareto.draw(files.read_csv(DATA, Datum), DOCS / page.PICTURE)
    (DOCS / page.PAGE.name).write_text(page.PAGE(), encoding="utf-8")
    console.print(f"Written: {DATA}, {DOCS / page.PICTURE}, {DOCS / page.PAGE.name}")


def _sweep(chosen: list[Problem], folder: Path, start: Start) -> None:
    sweeps = dict.fromkeys((point.problem, point.interface, point.parameter) for point in points(chosen))
    paths = start(
        {
            f"{problem.value}-{interface.slug}-{parameter.name.lower()}": (
                "cost-sweep",
                problem.value,
                interface.value,
                parameter.value,
            )
            for problem, interface, parameter in sweeps
        }
    )
    found = [datum for path in paths for datum in files.read_json(path, Datum)]
    files.write_csv(found, Datum, folder / "cost.csv", stamps.stamp(LIMIT))
    (folder / "cost.md").write_text(f"{pareto.comparison(found)}\n\n{pareto.table(found)}\n")
    written = [folder / "cost.csv", folder / "cost.md", pareto.draw(found, folder / "cost.svg")]
    console.print(pareto.comparison(found), markup=False)
    _finish(written, len(paths) == len(sweeps))


def _interleaved(chosen: list[Problem], number: int, data: Path, folder: Path, start: Start) -> None:
    wanted = {
        f"interleaved-{problem.value}-{kind.value}-{round_number}": (
            "cost-interleaved",
            problem.value,
            kind.value,
            str(round_number),
            "--data",
            str(data),
        )
        for kind in interleaved.Kind
        for problem in interleaved.PROBLEMS
        if problem in chosen
        for round_number in (range(1, number + 1) if kind is not interleaved.Kind.SHORT else (0,))
    }
    paths = start(wanted)
    found = [timing for path in paths for timing in files.read_json(path, Timing)]
    files.write_csv(found, Timing, folder / "cost-interleaved.csv", stamps.stamp(LIMIT))
    text = interleaved.ratio_table(found)
    (folder / "cost-interleaved.md").write_text(text + "\n")
    console.print(text, markup=False)
    _finish([folder / "cost-interleaved.csv", folder / "cost-interleaved.md"], len(paths) == len(wanted))


def _finish(written: list[Path], complete: bool) -> None:
    console.print("Written: " + ", ".join(map(str, written)))
    if not complete:
        raise typer.Exit(1)


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


def cost_interleaved(
    problem: Problem,
    kind: Annotated[
        interleaved.Kind, typer.Argument(help="Size of the model; the command counts instructions for the short one.")
    ],
    number: Annotated[int, typer.Argument(min=0, help="Number of the round.")],
    data: Annotated[Path, typer.Option(help="Read settings from this file.")] = DATA,
    out: Annotated[Path, typer.Option(help="Write the times to this file, as JSON.")] = Path("interleaved.json"),
) -> None:
    """Time the interfaces once, one after the other, on one of the problems 3.1 and 3.2."""
    if problem not in interleaved.PROBLEMS:
        raise HarnessError(f"problem {problem.value} is not timed in turn; {', '.join(interleaved.PROBLEMS)} are")
    runner = Runner(RESULTS / "cost" / "runs", processor_limit=LIMIT)
    chosen = interleaved.contenders(files.read_csv(data, Datum), problem)
    short = kind is interleaved.Kind.SHORT
    files.write_json(
        interleaved.count(chosen, runner) if short else interleaved.one_round(chosen, kind, number, runner), out
    )


def answer(data: list[Datum], error: float, problems: list[Problem]) -> str:
    """What to set for an error, and what it costs, for each problem and interface."""
    lines = []
    for problem in problems:
        own = pareto.comparable(data, problem)
        what = (
            "difference from the finest run"
            if problem is Problem.INDENTATION
            else "difference from the conforming reference"
        )
        lines.append(f"Problem {problem.value}, {what} at most {error:g}:")
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
