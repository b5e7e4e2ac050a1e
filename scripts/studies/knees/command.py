"""The command `knee`."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.errors import HarnessError
from harness.models.knee.bearing import Load
from harness.models.knee.whole_mesh import Size
from harness.paths import DOCS, RESULTS
from harness.run.runner import Runner
from studies import files, stamps
from studies.knees import page
from studies.knees.knee_run import KneeRun
from studies.pages.evidence import DATA

console = Console(highlight=False, soft_wrap=True)


def knee(
    stance: Annotated[Size, typer.Option(help="Size of the knee in stance.")] = Size.SMALL,
    gait: Annotated[Size, typer.Option(help="Size of the knee in gait.")] = Size.COARSE,
    folder: Annotated[Path, typer.Option(help="Write results to this folder.")] = RESULTS / "knee",
    limit: Annotated[float, typer.Option(help="Limit each run to this processor time [s].")] = page.LIMIT,
    docs: Annotated[
        bool, typer.Option("--docs", help="Also write data, page and picture of the documentation.")
    ] = False,
) -> None:
    """Run the elastic knee with sliding-mixture and with FEBio's interface, and draw the pressure of both.

    The command keeps completed runs.
    """
    try:
        compared, figures = (import_module(f"studies.knees.{name}") for name in ("compared_knees", "figures"))
    except ImportError as error:
        raise HarnessError(f"`knee` needs pyfebio and PyVista, and Python 3.11 or newer ({error})") from error
    runner = Runner(folder / "runs", processor_limit=limit)
    found: list[KneeRun] = []
    drawn = []
    for load, size in ((Load.STANCE, stance), (Load.GAIT, gait)):
        for model, factor in compared.knees(load, size):
            console.print(model.name)
            measured, result = compared.run(model, factor, runner)
            found.append(measured)
            if load is Load.STANCE and factor in figures.FACTORS:
                drawn.append((measured, result))
    console.print(page.table(found), markup=False)
    console.print(str(figures.draw(drawn, folder / page.PICTURE)))
    if docs:
        files.write_csv(found, KneeRun, DATA / page.SOURCE, stamps.stamp(limit))
        (DOCS / page.PAGE.name).write_text(page.PAGE(), encoding="utf-8")
        console.print(str(figures.draw(drawn, DOCS / "images" / page.PICTURE)))
