"""The command `price`: timings of the contact, by task and effect, and beside FEBio's own interfaces."""

import shutil
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from harness.paths import DOCS, RESULTS
from studies import files, stamps
from studies.options import Docs, console
from studies.pages.evidence import DATA
from studies.price import febio_matrices, joints, page, paired_runs, table
from studies.price.scenes import Kind, Scene, effects_added
from studies.price.table import EffectCost
from studies.stamps import LIMIT


class Part(str, Enum):
    """What there is to measure."""

    JOINTS = "joints"  # a ball in its socket, of tetrahedra, and blocks with many facets, beside FEBio's own interface
    EFFECTS = "effects"  # times at the end of runs with more and more effects, as a bar chart
    COMPARISON = "comparison"  # iterations and times of the contact beside FEBio's own, on two blocks with many facets
    MATRICES = "matrices"
    """FEBio's interface on the joints with its default matrix, which is symmetric, beside a non-symmetric one."""


def price(
    only: Annotated[list[Part] | None, typer.Option(help="Measure only this part. The option may be repeated.")] = None,
    repetitions: Annotated[int, typer.Option(min=1, help="Number of repetitions of each comparison.")] = 3,
    folder: Annotated[Path, typer.Option(help="Write tables and pictures to this folder.")] = RESULTS / "price",
    docs: Docs = False,
) -> None:
    """Measure the times of the contact.

    The command alternates the runs that it compares, and takes the medians of their ratios. Nothing else should run at
    the same time.
    """
    chosen = only or list(Part)
    stamp = stamps.stamp(LIMIT)
    tell = partial(console.print, markup=False)
    if Part.JOINTS in chosen:
        found = joints.measure(joints.SCENES, repetitions, tell)
        files.write_csv(found, joints.JointPrice, folder / page.JOINTS, stamp)
    if Part.MATRICES in chosen:
        rows = febio_matrices.measure(joints.SCENES, repetitions, tell)
        files.write_csv(rows, febio_matrices.Matrix, folder / page.MATRICES, stamp)
    if Part.EFFECTS in chosen:
        costs = table.measure(effects_added(), repetitions, tell)
        files.write_csv(costs, EffectCost, folder / page.EFFECTS, stamp)
    if Part.COMPARISON in chosen:
        scenes = (Scene(kind, solutes=int(kind in (Kind.SOLUTE, Kind.MULTIPHASIC))) for kind in Kind)
        prices = [price for scene in scenes for price in paired_runs.prices(scene, repetitions, tell)]
        files.write_csv(prices, paired_runs.Price, folder / page.COMPARISON, stamp)
    console.print(f"Written: {folder}")
    if docs:
        _write_docs(folder)


def _write_docs(folder: Path) -> None:
    """The page of the documentation, with what was measured into `folder`."""
    for name in (*page.PAGE.sources, page.MATRICES):
        if (folder / name).is_file():
            shutil.copy(folder / name, DATA / name)
    page.draw(files.read_csv(DATA / page.EFFECTS, EffectCost), DOCS / page.PICTURE)
    console.print(f"Written: {page.PAGE.write()}, {DOCS / page.PICTURE}")
