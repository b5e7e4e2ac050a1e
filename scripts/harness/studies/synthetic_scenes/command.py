"""The command `synthetic-scenes`: scenes written here of what models of users hold, beside FEBio's interfaces."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from harness.pages import scene_results
from harness.pages.scene_results import Row
from harness.paths import DOCS, RESULTS
from harness.run import provenance
from harness.studies.limit import LIMIT
from harness.studies.synthetic_scenes import comparison
from harness.studies.synthetic_scenes.all_scenes import SCENES

console = Console(highlight=False, soft_wrap=True)


def synthetic_scenes(
    only: Annotated[list[str] | None, typer.Option(help="Scenes whose names hold this; may be repeated.")] = None,
    folder: Annotated[Path, typer.Option(help="Where results go.")] = RESULTS / "synthetic-scenes",
    jobs: Annotated[int, typer.Option(min=1, help="Runs at a time.")] = min(2, os.cpu_count() or 1),
    limit: Annotated[float, typer.Option(help="s of processor time for each run.")] = LIMIT,
    docs: Annotated[bool, typer.Option("--docs", help="Write the page of the documentation, too.")] = False,
) -> None:
    """Run each scene with FEBio's interface, converted, with the penalties deleted, and so with the predictor.

    Exit code 0: what FEBio's interface ends, sliding-mixture ends in both ways.
    """
    chosen = [name for name in SCENES if not only or any(part in name for part in only)]
    if docs and only:
        raise typer.BadParameter("--docs needs all scenes; leave --only out")

    def compare(name: str) -> Row:
        return comparison.compare(name, SCENES[name], folder, limit)

    with ThreadPoolExecutor(jobs) as pool:
        rows = list(track(pool.map(compare, chosen), "scenes", total=len(chosen), console=console))
    _write(scene_results.Results(provenance.stamp(limit), rows), folder, docs)
    if any(row.febio.ended and not (row.converted.ended and row.defaults.ended) for row in rows):
        raise typer.Exit(1)


def _write(results: scene_results.Results, folder: Path, docs: bool) -> None:
    text = f"{scene_results.summary(results.rows)}\n\n{scene_results.table(results.rows)}\n"
    (folder / "synthetic-scenes.md").write_text(text)
    console.print(text, markup=False)
    console.print(f"Written: {folder / 'synthetic-scenes.md'}")
    if docs:
        scene_results.write(results, DOCS / scene_results.DATA)
        for name, page in ((scene_results.PAGE, scene_results.page), (scene_results.ALL, scene_results.all_scenes)):
            (DOCS / name).write_text(page(results), encoding="utf-8")
        console.print(f"Written: {DOCS / scene_results.PAGE}, {DOCS / scene_results.ALL}, {DOCS / scene_results.DATA}")
