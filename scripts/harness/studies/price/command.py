"""The command `price`: timings of the contact, by task and effect, and beside FEBio's own interfaces."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.errors import HarnessError
from harness.paths import RESULTS
from harness.run.runner import Runner
from harness.studies import files
from harness.studies.price import page, paired_runs, table
from harness.studies.price.scenes import Kind, Scene, effects_added

console = Console(highlight=False, soft_wrap=True)


class Part(str, Enum):
    """What there is to measure."""

    EFFECTS = "effects"
    """Times at the end of runs with more and more effects, as a bar chart."""
    COMPARISON = "comparison"
    """Iterations and times of the contact beside FEBio's own, on two blocks with many facets."""
    ADDED = "added"
    """Time added to the run of one body of 12 x 12 x 24 elements."""
    SHARE = "share"
    """Share of the contact in a run of 1e5 degrees of freedom."""


def price(
    logs: Annotated[list[Path] | None, typer.Argument(help="Logs of runs: draw their times, and run nothing.")] = None,
    only: Annotated[list[Part] | None, typer.Option(help="Measure this alone; may be repeated.")] = None,
    repetitions: Annotated[int, typer.Option(min=1, help="How often runs that are compared are repeated.")] = 5,
    folder: Annotated[Path, typer.Option(help="Where tables and pictures go.")] = RESULTS / "price",
) -> None:
    """Measure the timings of the contact, or draw the times that it wrote into the logs of runs.

    Runs that are compared alternate, and the medians of their ratios count. Nothing else should run meanwhile.
    """
    folder.mkdir(parents=True, exist_ok=True)
    if logs:
        _show_effects(_of_logs(logs), folder)
        return
    chosen = only or list(Part)
    if Part.EFFECTS in chosen:
        _show_effects(_effects(folder), folder)
    if Part.COMPARISON in chosen:
        _compare("comparison", [Scene(kind, solutes=_solutes(kind)) for kind in Kind], repetitions, folder)
    if Part.ADDED in chosen:
        scenes = [Scene(kind, solutes=1, section=12, through=12) for kind in (Kind.SOLUTE, Kind.MULTIPHASIC)]
        _compare("added", scenes, repetitions, folder)
    if Part.SHARE in chosen:
        scene = Scene(Kind.SOLUTE, solutes=1, section=21, through=20)
        name = f"{scene.degrees_of_freedom} degrees of freedom"
        _show({name: _times(scene, folder)}, folder / "share.md")


def _solutes(kind: Kind) -> int:
    return 1 if kind in (Kind.SOLUTE, Kind.MULTIPHASIC) else 0


def _effects(folder: Path) -> dict[str, table.Times]:
    return {name: _times(scene, folder) for name, scene in effects_added().items()}


def _times(scene: Scene, folder: Path) -> table.Times:
    console.print(f"running {scene.name}")
    (found,) = table.read(Runner(folder / "runs")(scene.model()).log)
    return found


def _of_logs(logs: list[Path]) -> dict[str, table.Times]:
    found: dict[str, table.Times] = {}
    for log in logs:
        if not log.is_file():
            raise HarnessError(f"there is no log {log}")
        tables = table.read(log.read_text(errors="replace"))
        if not tables:
            raise HarnessError(f"{log} holds no times of a contact: they come at the end of a run")
        for times in tables:
            found[f"{log.stem}: {times.contact}" if len(tables) > 1 or len(logs) > 1 else times.contact] = times
    return found


def _show_effects(scenes: dict[str, table.Times], folder: Path) -> None:
    console.print(f"Written: {page.draw(scenes, folder / 'effects.png')}")
    _show(scenes, folder / "effects.md")


def _show(scenes: dict[str, table.Times], path: Path) -> None:
    text = page.scenes_table(scenes)
    path.write_text(text + "\n")
    console.print(text, markup=False)
    console.print(f"Written: {path}")


def _compare(name: str, scenes: list[Scene], repetitions: int, folder: Path) -> None:
    found: list[paired_runs.Price] = []
    for scene in scenes:
        found += paired_runs.prices(scene, repetitions, lambda what: console.print(f"running {what}"))
        files.write_json(found, folder / f"{name}.json")
        (folder / f"{name}.md").write_text(page.comparison_table(found) + "\n")
    console.print(page.comparison_table(found), markup=False)
    console.print(f"Written: {folder / name}.md, {folder / name}.json")
