"""The command that runs the hard cases of friction."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.paths import RESULTS
from harness.run.runner import Runner
from harness.studies.hard_cases import rubbing_record
from harness.studies.hard_cases.command import LIMIT
from harness.studies.hard_cases.rubbing import CASES
from harness.studies.hard_cases.scene import Fineness, Interface

console = Console(highlight=False, soft_wrap=True)


def friction_cases(
    only: Annotated[list[str] | None, typer.Option(help="Run this case alone; may be repeated.")] = None,
    mesh: Annotated[list[Fineness] | None, typer.Option(help="On this mesh alone.")] = None,
    febio: Annotated[bool, typer.Option(help="FEBio's friction beside it, with two factors on its penalties.")] = True,
    folder: Annotated[Path, typer.Option(help="Where results go.")] = RESULTS / "friction-cases",
    limit: Annotated[float, typer.Option(help="s of processor time for each run.")] = LIMIT,
) -> None:
    """Run the hard cases of friction on two meshes, with friction and without, and write the table.

    Exit code 0: all end, and all checks are met.
    """
    for name in only or []:
        if name not in CASES:
            raise typer.BadParameter(f"'{name}' is not one of {', '.join(CASES)}")
    runner = Runner(folder / "runs", processor_limit=limit)
    others = (Interface.FEBIO_1, Interface.FEBIO_1000) if febio else ()
    records = []
    for name in only or CASES:
        for each in mesh or Fineness:
            records.append(rubbing_record.make(runner, name, each, others))
            console.print(rubbing_record.line(records[-1]), markup=False)
    (folder / "friction-cases.md").write_text(f"{rubbing_record.table(records)}\n")
    console.print(f"Written: {folder / 'friction-cases.md'}")
    if not all(record.passed for record in records):
        raise typer.Exit(1)
