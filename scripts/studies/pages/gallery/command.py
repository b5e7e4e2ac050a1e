"""The command that runs the gallery and writes its page."""

from pathlib import Path
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import RESULTS
from harness.run.runner import Runner
from studies import stamps
from studies.options import console
from studies.pages.gallery import cycle, entries, figures, friction, page


def gallery(
    only: Annotated[list[str] | None, typer.Option(help="Run only this model. The option may be repeated.")] = None,
    small: Annotated[bool, typer.Option(help="Use fewer elements and steps, for a run of a minute.")] = False,
    folder: Annotated[
        Path, typer.Option(help="Write page, numbers and pictures to this folder; `docs` for the site.")
    ] = RESULTS / "gallery",
) -> None:
    """Run the models of the gallery, and write their page with pictures, curves and run times.

    The page keeps the other models with --only if the same plugin and FEBio made their results.
    """
    known = {entry.model.name: entry for entry in entries.ENTRIES}
    names = chosen(only, known)
    runner, stamp = Runner(RESULTS / "gallery" / "runs"), stamps.stamp()
    records = page.made_alike(folder, stamp)
    for name in names:
        entry = known[name]
        result = runner(entry.small if small else entry.model)
        curves = entries.curves(entry, result)
        figures.draw(entry, result, curves, folder / page.IMAGES)
        if name == cycle.MODEL and not small:
            cycle.draw(entry, result, curves, folder / page.IMAGES / cycle.PICTURE)
        records[name] = page.record(result)
        taken = records[name]
        console.print(f"{name}: {taken.steps} steps, {taken.iterations} iterations, {taken.cpu:g} s", markup=False)
    if not only and not small:
        friction.draw(runner, folder / page.IMAGES)
    written = page.write(folder, page.Results(stamp, records))
    console.print("Written: " + ", ".join(str(path) for path in written))
