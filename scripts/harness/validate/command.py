"""The commands `validate` and `plot`."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeElapsedColumn
from rich.table import Table

from harness import choice
from harness.models.interface import InterfaceType
from harness.paths import RESULTS
from harness.post.compare import Measure
from harness.run import hosts
from harness.run.runner import Announce, Runner
from harness.validate import figures, results, validation
from harness.validate.checks import CHECKS, Check, Context

MISSED, LEFT_OUT = 1, 3  # exit codes: a tolerance was missed; none was missed, but checks were left out
console = Console(highlight=False, width=None if sys.stdout.isatty() else 132)


def validate(
    interface: Annotated[
        InterfaceType, typer.Option(help="Join the bodies by this interface.")
    ] = InterfaceType.MIXTURE,
    only: Annotated[list[str] | None, typer.Option(help="Make only this check. The option may be repeated.")] = None,
    folder: Annotated[Path, typer.Option(help="Write results and pictures to this folder.")] = RESULTS,
    jobs: Annotated[int, typer.Option(min=1, help="Number of simultaneous runs.")] = min(2, os.cpu_count() or 1),
    chosen: Annotated[
        hosts.Engine | None,
        typer.Option("--engine", help="Run the models with this engine; the default is febio4 if it is installed."),
    ] = None,
) -> None:
    """Run the article's problems, compare the results with closed forms, and draw figures 3.2 to 3.4.

    The embedded engine runs the models if febio4 is not installed. The exit code is 0 if the results meet all
    tolerances, and 1 if they miss one. It is 3 if they miss none, but the command could not make all checks.
    """
    if interface is InterfaceType.CONFORMING:
        raise typer.BadParameter("'conforming' is the reference of the others", param_hint="--interface")
    known = {check.name: check for check in CHECKS}
    checks = [known[name] for name in choice.chosen(only, known)]
    engines = hosts.engines(chosen, interface)
    if chosen is None and engines == (hosts.STANDALONE,):
        console.print(f"[yellow]The embedded engine runs the models:[/] {escape(hosts.why_not_febio(interface))}")
    found = {}
    for host in engines:
        own = folder / host.name if host is hosts.STANDALONE else folder
        with _progress(checks) as (announce, finished):
            context = Context(Runner(own / "runs", announce, host=host), interface)
            found[host.name] = validation.validate(context, checks, jobs=jobs, finished=finished)
        written = [found[host.name].write(own), *validation.draw(context, found[host.name], own)]
        console.print("Written: " + ", ".join(str(path) for path in written))
    console.print(_table(found))
    _conclude(list(found.values()))


@contextmanager
def _progress(checks: list[Check]) -> Iterator[tuple[Announce, validation.Finished]]:
    """Bars of all checks and of each run: what to call as a run goes on, and when a check is done."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        overall = progress.add_task("checks", total=len(checks))
        tasks: dict[str, TaskID] = {}

        def announce(name: str, fraction: float) -> None:
            if name not in tasks:
                tasks[name] = progress.add_task(name, total=100)
            progress.update(tasks[name], completed=round(100 * fraction), visible=fraction < 1.0)

        yield announce, lambda _: progress.advance(overall)


def _table(found: dict[str, results.Results]) -> Table:
    """Measures of each engine, side by side with their difference where there are two."""
    first, *others = found.values()
    table = Table(title=f"Contact type: {first.interface}; run by {' and '.join(found)}", title_justify="left")
    table.add_column("measure")
    for name in found:
        table.add_column(name, justify="right")
    if others:
        table.add_column("difference", justify="right")
    table.add_column("tolerance", justify="right")
    table.add_column("")
    table.add_column("note", overflow="fold")
    for check, measures in first.checks.items():
        for place, m in enumerate(measures):
            twins = [twin for other in others for twin in other.checks.get(check, [])[place : place + 1]]
            table.add_row(*_row(m, twins, len(others)))
        table.add_section()
    return table


def _row(m: Measure, twins: list[Measure], columns: int) -> list[str]:
    tolerance = f"<= {m.tolerance:.4g}" if m.lowest == -float("inf") else f"{m.lowest:.4g} to {m.tolerance:.4g}"
    mark = "[green]met[/]" if all(each.passed for each in (m, *twins)) else "[bold red]missed[/]"
    values = [f"{each.value:.4g}" for each in (m, *twins)]
    if columns:
        values += [f"{twins[0].value - m.value:.1e}"] if twins else ["-", "-"]
    return [escape(m.name), *values, tolerance, mark, escape(m.note)]


def _conclude(found: list[results.Results]) -> None:
    left_out = {name: why for one in found for name, why in one.left_out.items()}
    missed = sum(len(one.missed) for one in found)
    if left_out:
        reasons = " ".join(dict.fromkeys(left_out.values()))
        console.print(
            f"[bold yellow]Left out:[/] {', '.join(left_out)}. The reason: {escape(reasons)} "
            "The command has checked the closed forms, and the figures show these alone."
        )
    if missed:
        console.print(f"[bold red]{missed} results miss their tolerances.[/]")
        raise typer.Exit(MISSED)
    if left_out:
        raise typer.Exit(LEFT_OUT)
    console.print("[bold green]Every tolerance is met.[/]")


def plot(
    file: Annotated[Path, typer.Argument(help="Read this file of `validate`.")] = RESULTS / results.FILE_NAME,
    folder: Annotated[
        Path | None, typer.Option(help="Write pictures to this folder; the default is the folder of the file.")
    ] = None,
) -> None:
    """Draw the pictures of `validate` again."""
    for path in figures.draw(results.read(file).profiles, folder or file.parent):
        console.print(str(path))
