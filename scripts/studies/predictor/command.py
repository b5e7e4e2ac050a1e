"""The command `predictor`: every model and every hard case without and with it."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from harness.paths import RESULTS
from harness.run.runner import Runner
from studies import files, stamps
from studies.hard_cases.scene import Fineness
from studies.pages.evidence import DATA
from studies.predictor import page, paired_models, summary_table
from studies.predictor.paired_models import Took
from studies.stamps import LIMIT

console = Console(highlight=False, soft_wrap=True)


def predictor(
    only: Annotated[
        list[str] | None, typer.Option(help="Run models whose names contain this text. The option may be repeated.")
    ] = None,
    mesh: Annotated[list[Fineness] | None, typer.Option(help="Run hard cases only on this mesh.")] = None,
    folder: Annotated[Path, typer.Option(help="Write results to this folder.")] = RESULTS / "predictor",
    jobs: Annotated[int, typer.Option(min=1, help="Number of simultaneous runs.")] = min(2, os.cpu_count() or 1),
    limit: Annotated[float, typer.Option(help="Limit each run to this processor time [s].")] = LIMIT,
    docs: Annotated[bool, typer.Option("--docs", help="Also write the page of the documentation.")] = False,
) -> None:
    """Run every model and every hard case without and with the predictor, and write the table.

    The command keeps completed runs.
    """
    runner = Runner(folder / "runs", processor_limit=limit)
    chosen = [known for known in paired_models.known_models(mesh or list(Fineness)) if _wanted(known[0], only)]
    with ThreadPoolExecutor(jobs) as pool:
        done = pool.map(lambda known: paired_models.run(known[0], known[1], runner), chosen)
        found = list(track(done, "models", total=len(chosen), console=console))
    text = f"{summary_table.summary(found)}\n\n{summary_table.table(found)}\n"
    (folder / "predictor.md").write_text(text)
    console.print(text, markup=False)
    console.print(f"Written: {folder / 'predictor.md'}")
    if docs:
        files.write_csv(paired_models.runs(found), Took, DATA / page.SOURCE, stamps.stamp(limit))
        console.print(f"Written: {page.PAGE.write()}")


def _wanted(name: str, only: list[str] | None) -> bool:
    return not only or any(part in name for part in only)
