"""The command that writes the verification report."""

from pathlib import Path
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import DOCS, RESULTS
from harness.run.runner import Runner
from harness.validate import figures
from harness.validate.checks import CHECKS, Context
from studies import stamps
from studies.options import console
from studies.pages import verification


def verification_report(
    only: Annotated[list[str] | None, typer.Option(help="Make only this check. The option may be repeated.")] = None,
    folder: Annotated[Path, typer.Option(help="Write page and numbers to this folder.")] = DOCS,
) -> None:
    """Make all checks of `validate` one after the other, and write the verification report and figures 3.2 and 3.3."""
    known = {check.name: check for check in CHECKS}
    sections = []
    for section in verification.make(RESULTS / "runs", [known[name] for name in chosen(only, known)]):
        sections.append(section)
        missed = sum(not measure.passed for measure in section.measures)
        console.print(f"{section.name}: {len(section.measures)} figures, {missed} missed")
    written = verification.write(folder, verification.Report(stamps.stamp(), sections))
    if not only:
        written += _pictures(folder / "images")
    console.print("Written: " + ", ".join(str(path) for path in written))
    if any(not measure.passed for section in sections for measure in section.measures):
        raise typer.Exit(1)


def _pictures(folder: Path) -> list[Path]:
    """Figures 3.2 and 3.3, of the runs behind the report."""
    context = Context(Runner(RESULTS / "runs"))
    return figures.draw([*figures.diffusion_profiles(context), *figures.convection_profiles(context)], folder)
