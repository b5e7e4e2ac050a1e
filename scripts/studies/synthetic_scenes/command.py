"""The command `synthetic-scenes`: scenes written here of what models of users hold, beside FEBio's interfaces."""

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import track

from harness.paths import DOCS, PLUGIN_VARIABLE, RESULTS
from studies import files, stamps
from studies.options import TWO_AT_MOST, Docs, Folder, Jobs, Limit, console
from studies.pages import scene_results
from studies.pages.scene_results import Row
from studies.stamps import LIMIT
from studies.synthetic_scenes import comparison
from studies.synthetic_scenes.collections_of_scenes import STUDIES, Collection, Study


def synthetic_scenes(
    collection: Annotated[Collection, typer.Option(help="Collection of scenes.")] = Collection.BLOCKS,
    only: Annotated[
        list[str] | None, typer.Option(help="Run scenes whose names contain this text. The option may be repeated.")
    ] = None,
    folder: Folder = RESULTS / "synthetic-scenes",
    jobs: Jobs = TWO_AT_MOST,
    limit: Limit = LIMIT,
    plugin: Annotated[
        Path | None, typer.Option(help=f"Load this plugin, not ${PLUGIN_VARIABLE} or that of the build.")
    ] = None,
    docs: Docs = False,
) -> None:
    """Run each scene with FEBio's interface, converted, and with the penalties deleted.

    The command also runs the scenes `blocks` with the predictor. The scenes `varied` and `bodies` are random;
    `--only seed-01` runs the ten scenes seed-010 to seed-019. The command keeps runs of the same model, programs and
    limit that are already in the folder, and therefore continues after an interruption.

    The exit code is 0 if sliding-mixture completes all runs of the scenes that FEBio's interface completes.
    """
    study = STUDIES[collection]
    chosen = [name for name in study.scenes if not only or any(part in name for part in only)]
    if docs and (only or study.data is None):
        raise typer.BadParameter("--docs needs all scenes of blocks or reported; leave --only out")
    if plugin is not None:
        os.environ[PLUGIN_VARIABLE] = str(plugin.resolve())

    def compare(name: str) -> Row:
        return comparison.compare(name, study.scenes[name], folder / collection.value, limit, study.ways)

    with ThreadPoolExecutor(jobs) as pool:
        rows = list(track(pool.map(compare, chosen), "scenes", total=len(chosen), console=console))
    _write(study, scene_results.Results(stamps.stamp(limit), rows), folder / f"{collection.value}.md", docs)
    if any(row.febio.ended and not (row.converted.ended and row.defaults.ended) for row in rows):
        raise typer.Exit(1)


def _write(study: Study, results: scene_results.Results, path: Path, docs: bool) -> None:
    text = f"{study.summary(results.rows)}\n\n{study.table(results.rows)}\n"
    path.write_text(text)
    console.print(text, markup=False)
    console.print(f"Written: {path}")
    if docs and study.data is not None:
        files.write_stamped(results, DOCS / study.data)
        for name, page in study.pages.items():
            (DOCS / name).write_text(page(results), encoding="utf-8")
        console.print(f"Written: {', '.join(map(str, (*study.pages, study.data)))} below {DOCS}")
