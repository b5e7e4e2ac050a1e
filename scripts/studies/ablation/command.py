"""The command `ablation`."""

from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import RESULTS
from studies import files, stamps
from studies.ablation import ablated_runs, page
from studies.ablation.ablated_runs import Ablated
from studies.ablation.ablated_scenes import SCENES
from studies.options import Folder, Limit, console
from studies.pages.evidence import DATA
from studies.stamps import LIMIT


def ablation(
    only: Annotated[
        list[str] | None, typer.Option(help="Run scenes whose names contain this text. The option may be repeated.")
    ] = None,
    device: Annotated[
        list[str] | None, typer.Option(help="Switch off only this device. The option may be repeated.")
    ] = None,
    folder: Folder = RESULTS / "ablation",
    limit: Limit = LIMIT,
    docs: Annotated[bool, typer.Option("--docs", help="Write the page of the documentation, too.")] = False,
) -> None:
    """Run scenes with all devices of the solver, and again without each device that acts in the scene.

    The command writes iterations, retries, matrices, entries and times to ablation.csv.
    """
    devices = chosen(device, ablated_runs.devices(), "--device")
    scenes = [name for name in SCENES if not only or any(part in name for part in only)]
    rows: list[Ablated] = []
    for name in scenes:
        found = ablated_runs.ablate(name, SCENES[name], devices, folder.resolve() / "runs", limit)
        rows += found
        console.print("\n".join(_line(row) for row in found), markup=False)
        files.write_csv(rows, Ablated, folder / "ablation.csv", stamps.stamp(limit))
    console.print(page.summary(page.pairs(rows)), markup=False)
    console.print(f"Written: {folder / 'ablation.csv'}")
    if docs:
        files.write_csv(rows, Ablated, DATA / page.SOURCE, stamps.stamp(limit))
        console.print(f"Written: {page.PAGE.write()}")


def _line(row: Ablated) -> str:
    end = "" if row.ended else " FAILED"
    return (
        f"{row.scene}, without {row.without}: {row.iterations} iterations, {row.retries} retries, "
        f"{row.matrices} matrices, {row.entries} entries{end}"
    )
