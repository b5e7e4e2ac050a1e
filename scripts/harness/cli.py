"""The command line of the harness."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TaskID, TextColumn, TimeElapsedColumn
from rich.table import Table

from harness import catalogue, engine, febfile, figures, indentation_command, results, validation
from harness.checks import CHECKS, Check, Context
from harness.errors import HarnessError
from harness.models.interface import Join
from harness.paths import MODELS, RESULTS
from harness.runner import Runner

MISSED, BAD_INPUT, LEFT_OUT = 1, 2, 3
"""Exit codes: a bar was missed; the input cannot be used; nothing was missed, but checks were left out."""

_ABOUT = "Make, run and check models of contact between mixtures."
app = typer.Typer(add_completion=False, no_args_is_help=True, help=_ABOUT)
app.command()(indentation_command.indentation)
app.command("indentation-study")(indentation_command.indentation_study_command)
console = Console(highlight=False, width=None if sys.stdout.isatty() else 132)


def main() -> None:
    """Run the command line; an error that concerns the user is one paragraph, not a traceback."""
    try:
        app()
    except HarnessError as error:
        Console(stderr=True, highlight=False).print(f"[bold red]error:[/] {_plain(str(error))}")
        sys.exit(BAD_INPUT)


def _plain(text: str) -> str:
    return text.replace("[", r"\[")


def _selected(names: list[str] | None) -> list[Check]:
    known = {check.name: check for check in CHECKS}
    for name in names or []:
        if name not in known:
            raise typer.BadParameter(f"'{name}' is not one of {', '.join(known)}")
    return [known[name] for name in names] if names else list(CHECKS)


@app.command()
def validate(
    interface: Annotated[Join, typer.Option(help="What joins the bodies.")] = Join.MIXTURE,
    only: Annotated[list[str] | None, typer.Option(help="Make this check alone; may be repeated.")] = None,
    folder: Annotated[Path, typer.Option(help="Where results and pictures go.")] = RESULTS,
    jobs: Annotated[int, typer.Option(min=1, help="Runs at a time.")] = min(2, os.cpu_count() or 1),
) -> None:
    """Run the paper's problems through febio4, compare with the closed forms, and draw figures 3.2 and 3.3.

    Exit code 0: every bar is met; 1: one is missed; 3: none is missed, but febio4 or the plugin is not there.
    """
    if interface is Join.UNSPLIT:
        raise typer.BadParameter("'unsplit' is what the others are compared with", param_hint="--interface")
    checks = _selected(only)
    found = _with_progress(checks, interface, folder, jobs)
    console.print(_table(found))
    written = [found.write(folder), *figures.draw(found.profiles, folder)]
    console.print("Written: " + ", ".join(str(path) for path in written))
    _conclude(found)


def _with_progress(checks: list[Check], interface: Join, folder: Path, jobs: int) -> results.Results:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as progress:
        overall = progress.add_task("checks", total=len(checks))
        tasks: dict[str, TaskID] = {}

        def announce(name: str, fraction: float) -> None:
            if name not in tasks:
                tasks[name] = progress.add_task(name, total=100)
            progress.update(tasks[name], completed=round(100 * fraction), visible=fraction < 1.0)

        context = Context(Runner(folder / "runs", announce), interface)
        return validation.validate(context, checks, jobs=jobs, finished=lambda _: progress.advance(overall))


def _table(found: results.Results) -> Table:
    table = Table(title=f"Contact type: {found.interface}", title_justify="left")
    table.add_column("measure")
    table.add_column("measured", justify="right")
    table.add_column("bar", justify="right")
    table.add_column("")
    table.add_column("note", overflow="fold")
    for measures in found.checks.values():
        for m in measures:
            bar = f"<= {m.bar:.4g}" if m.lowest == -float("inf") else f"{m.lowest:.4g} to {m.bar:.4g}"
            mark = "[green]met[/]" if m.passed else "[bold red]missed[/]"
            table.add_row(_plain(m.name), f"{m.value:.4g}", bar, mark, _plain(m.note))
        table.add_section()
    return table


def _conclude(found: results.Results) -> None:
    if found.left_out:
        reasons = " ".join(dict.fromkeys(found.left_out.values()))
        console.print(
            f"[bold yellow]Left out:[/] {', '.join(found.left_out)}. The reason: {_plain(reasons)} "
            "What needs no run was done: the closed forms were checked, and the figures show them alone."
        )
    if found.missed:
        console.print(f"[bold red]{len(found.missed)} of the bars are missed.[/]")
        raise typer.Exit(MISSED)
    if found.left_out:
        raise typer.Exit(LEFT_OUT)
    console.print("[bold green]Every bar is met.[/]")


@app.command()
def run(
    model: Annotated[Path, typer.Argument(help="A .feb file.")],
) -> None:
    """Run one model; the plugin is loaded where the model has a contact of type 'sliding-mixture'."""
    file = febfile.inspect(model)
    plugin = engine.required_plugin() if Join.MIXTURE.value in file.contacts else None
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(model.name, total=file.end or None)
        finished = engine.run(model, plugin=plugin, progress=lambda time: bar.update(task, completed=time))
    report = finished.report
    console.print(
        f"{model.name}: normal termination, {report.steps} steps, {report.iterations} iterations, "
        f"{report.residuals} residuals, {report.reformations} reformations, {report.retries} retries, "
        f"{finished.wall:.1f} s"
    )
    for warning in report.warnings:
        console.print(f"[yellow]FEBio warns:[/] {_plain(warning)}")


@app.command()
def plot(
    file: Annotated[Path, typer.Argument(help="What `validate` wrote.")] = RESULTS / results.FILE_NAME,
    folder: Annotated[Path | None, typer.Option(help="Where pictures go; next to the file by default.")] = None,
) -> None:
    """Draw the pictures again."""
    for path in figures.draw(results.read(file).profiles, folder or file.parent):
        console.print(str(path))


@app.command()
def models(
    folder: Annotated[Path, typer.Option(help="Where the .feb files go.")] = MODELS,
    check: Annotated[bool, typer.Option("--check", help="Write nothing; fail where a file is not up to date.")] = False,
) -> None:
    """Write the .feb files of the collection."""
    if check:
        old = catalogue.outdated(folder)
        if old:
            raise HarnessError(
                f"not what the generator writes: {', '.join(old)} in {folder}; `models` writes them anew"
            )
        return
    for path in catalogue.write(folder):
        console.print(str(path))
