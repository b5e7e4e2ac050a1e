"""The command `knee`."""

from importlib import import_module
from typing import Annotated

import typer

from harness.errors import HarnessError
from harness.paths import DOCS, RESULTS
from harness.run.runner import Runner, RunResult
from studies import files, stamps
from studies.knees import page
from studies.knees.knee_run import Kind, KneeRun
from studies.options import Folder, Limit, console
from studies.pages.evidence import DATA


def knee(
    kind: Annotated[Kind, typer.Option(help="Run knees of this kind.")] = Kind.ELASTIC,
    only: Annotated[str, typer.Option(help="Run knees whose names contain this text.")] = "",
    folder: Folder = RESULTS / "knee",
    limit: Limit = page.LIMIT,
    docs: Annotated[
        bool, typer.Option("--docs", help="Also write data, pages and pictures of the documentation.")
    ] = False,
) -> None:
    """Run knees with sliding-mixture and with FEBio's interfaces, and draw the pressure of both.

    The command keeps completed runs.
    """
    if docs and (only or kind is not Kind.ELASTIC):
        raise typer.BadParameter("the documentation has all elastic knees, and no others", param_hint="--docs")
    try:
        compared, figures = (import_module(f"studies.knees.{name}") for name in ("compared_knees", "figures"))
    except ImportError as error:
        raise HarnessError(f"`knee` needs pyfebio and PyVista, and Python 3.11 or newer ({error})") from error
    runner = Runner(folder / "runs", processor_limit=limit)
    if kind is Kind.WAYS:
        console.print(page.answers(compared.answers(runner)), markup=False)
        return
    done: list[tuple[KneeRun, RunResult]] = []
    for model, factor in compared.knees(kind, only):
        console.print(model.name)
        done.append(compared.run(model, factor, runner))
    found = [measured for measured, _ in done]
    console.print(page.table(found), page.compartments(found), sep="\n\n", markup=False)
    for path in figures.draw_all(done, DOCS / "images" if docs else folder):
        console.print(str(path))
    if docs:
        files.write_csv(found, KneeRun, DATA / page.SOURCE, stamps.stamp(limit))
        for each in page.PAGES:
            each.write()
        figures.draw_converted(runner, DOCS / "images")
