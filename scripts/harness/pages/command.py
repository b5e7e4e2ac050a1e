"""The commands that write what is generated: pages of the documentation, the report, the collection in models/."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.errors import HarnessError
from harness.pages import (
    collection,
    linear_solver_results,
    plugin_parameters,
    scene_results,
    sketches,
    verification,
)
from harness.pages.gallery import page as gallery
from harness.paths import DOCS, MODELS, RESULTS
from harness.run import provenance
from harness.validate.checks import CHECKS

console = Console(highlight=False, soft_wrap=True)
MISSED = 1
"""Exit code where a tolerance is missed."""

PAGES: dict[str, Callable[[], str]] = {
    plugin_parameters.PAGE: plugin_parameters.page,
    gallery.PAGE: lambda: gallery.page(gallery.read(DOCS)),
    verification.PAGE: lambda: verification.page(verification.read(DOCS)),
    scene_results.PAGE: lambda: scene_results.page(scene_results.read(DOCS / scene_results.DATA)),
    scene_results.ALL: lambda: scene_results.all_scenes(scene_results.read(DOCS / scene_results.DATA)),
    linear_solver_results.PAGE: lambda: linear_solver_results.page(
        linear_solver_results.read(DOCS / linear_solver_results.DATA)
    ),
}
"""Generated pages, from code or from results in docs/data, without a run. `harness.cli` adds those of studies."""


def pages(
    check: Annotated[bool, typer.Option("--check", help="Write nothing; fail where a page is not up to date.")] = False,
) -> None:
    """Write the generated pages of the documentation anew, from the code and from the results in docs/data."""
    for name, text in PAGES.items():
        path = DOCS / name
        made = text()
        if not check:
            path.write_text(made, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != made:
            raise HarnessError(f"{path} is not what `pages` writes; it writes it anew")
    if not check:
        sketches.draw(DOCS)


def report(
    only: Annotated[list[str] | None, typer.Option(help="Make this check alone; may be repeated.")] = None,
    folder: Annotated[Path, typer.Option(help="Where page and numbers go.")] = DOCS,
) -> None:
    """Make all checks of `validate` one after the other, and write the verification report."""
    known = {check.name: check for check in CHECKS}
    for name in only or []:
        if name not in known:
            raise typer.BadParameter(f"'{name}' is not one of {', '.join(known)}", param_hint="--only")
    sections = []
    for section in verification.make(RESULTS / "runs", [known[name] for name in only] if only else CHECKS):
        sections.append(section)
        missed = sum(not measure.passed for measure in section.measures)
        console.print(f"{section.name}: {len(section.measures)} figures, {missed} missed")
    written = verification.write(folder, verification.Report(provenance.stamp(), sections))
    console.print("Written: " + ", ".join(str(path) for path in written))
    if any(not measure.passed for section in sections for measure in section.measures):
        raise typer.Exit(MISSED)


def models(
    folder: Annotated[Path, typer.Option(help="Where the .feb files go.")] = MODELS,
    check: Annotated[bool, typer.Option("--check", help="Write nothing; fail where a file is not up to date.")] = False,
) -> None:
    """Write the .feb files of the collection."""
    if check:
        old = collection.outdated(folder)
        if old:
            raise HarnessError(
                f"not what the generator writes: {', '.join(old)} in {folder}; `models` writes them anew"
            )
        return
    for path in collection.write(folder):
        console.print(str(path))
