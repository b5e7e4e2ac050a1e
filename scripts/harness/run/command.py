"""The command `run`."""

import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from harness.models.interface import InterfaceType
from harness.run import engine, febfile, hosts

console = Console(highlight=False, width=None if sys.stdout.isatty() else 132)


def run(
    model: Annotated[Path, typer.Argument(help="A .feb file.")],
    chosen: Annotated[
        hosts.Engine | None,
        typer.Option("--engine", help="Run the model with this engine; the default is febio4 if it is installed."),
    ] = None,
) -> None:
    """Run one model, with the plugin if the model has a contact of type 'sliding-mixture' or 'tied-mixture'."""
    file = febfile.inspect(model)
    contact = InterfaceType.ours_in(file.contacts)
    for host in hosts.engines(chosen, contact):
        _run_one(model, file, host, contact.needs_plugin)


def _run_one(model: Path, file: febfile.FebFile, host: engine.Host, needs_plugin: bool) -> None:
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(model.name, total=file.end or None)
        command = host.command(model, needs_plugin)
        finished = engine.execute(
            command, model.resolve().parent, progress=lambda time: bar.update(task, completed=time)
        )
    report = finished.report
    console.print(
        f"{model.name}, run by {host.name}: normal termination, {report.steps} steps, {report.iterations} iterations, "
        f"{report.residuals} residuals, {report.reformations} reformations, {report.retries} retries, "
        f"{finished.wall:.1f} s"
    )
    for warning in report.warnings:
        console.print(f"[yellow]{host.name} warns:[/] {escape(warning)}")
