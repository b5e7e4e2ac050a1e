"""The command `real-models`: scenes of the breadth that users have, beside FEBio's interfaces."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from harness.paths import RESULTS
from harness.studies.real_models import comparison
from harness.studies.real_models.collection_of_scenes import SCENES

console = Console(highlight=False, soft_wrap=True)
TIMEOUT = 120.0
"""s of wall time for one run, the same for all interfaces."""


def real_models(
    only: Annotated[list[str] | None, typer.Option(help="Scenes whose names hold this; may be repeated.")] = None,
    folder: Annotated[Path, typer.Option(help="Where results go.")] = RESULTS / "real-models",
    jobs: Annotated[int, typer.Option(min=1, help="Runs at a time.")] = min(2, os.cpu_count() or 1),
    timeout: Annotated[float, typer.Option(help="s of wall time for each run.")] = TIMEOUT,
) -> None:
    """Run each scene with FEBio's interface, converted, and converted with the penalties deleted; write the table.

    Exit code 0: what FEBio's interface ends, sliding-mixture ends in both ways.
    """
    chosen = [name for name in SCENES if not only or any(part in name for part in only)]
    with ThreadPoolExecutor(jobs) as pool:
        done = pool.map(lambda name: comparison.compare(name, SCENES[name].model(name), folder, timeout), chosen)
        rows = list(track(done, "scenes", total=len(chosen), console=console))
    text = f"{comparison.summary(rows)}\n\n{comparison.table(rows)}\n"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "real-models.md").write_text(text)
    console.print(text, markup=False)
    console.print(f"Written: {folder / 'real-models.md'}")
    if any(row.febio.ended and not (row.converted.ended and row.defaults.ended) for row in rows):
        raise typer.Exit(1)
