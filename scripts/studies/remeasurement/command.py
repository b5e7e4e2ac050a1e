"""The command `evidence`."""

from __future__ import annotations

import subprocess
import sys
import time
from datetime import timedelta
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from harness.errors import HarnessError
from harness.paths import REPOSITORY, RESULTS
from harness.run import provenance
from studies.remeasurement.steps import STEPS, Step

console = Console(highlight=False, soft_wrap=True)
DONE, DOES_NOT_HOLD = 0, 1
"""Exit codes of a step that came to its end."""


def evidence(
    only: Annotated[
        list[str] | None, typer.Option(help="Do this step alone, done or not; may be repeated.", metavar="STEP")
    ] = None,
) -> None:
    """Measure all comparisons and all other evidence of the documentation again, one step after the other.

    Each run has one thread and, where it is compared with FEBio's interfaces, the same limit. A step whose files in
    docs/data were made with the plugin's present commit and that limit is left out, so that a run that was interrupted
    goes on. Nothing else should run meanwhile: some steps are timed.
    """
    steps = _chosen(only)
    commit = committed()
    folder = RESULTS / "evidence" / commit
    folder.mkdir(parents=True, exist_ok=True)
    failed = _all([step for step in steps if only or not step.is_done(commit)], commit, folder)
    for step in steps:
        console.print(f"{step.name}: {'FAILED' if step in failed else 'done'} at commit {commit}", markup=False)
    if failed:
        raise HarnessError(f"not done: {', '.join(step.name for step in failed)}; their logs are in {folder}")


def _chosen(only: list[str] | None) -> list[Step]:
    known = {step.name: step for step in STEPS}
    for name in only or []:
        if name not in known:
            raise typer.BadParameter(f"'{name}' is not one of {', '.join(known)}", param_hint="--only")
    return [known[name] for name in only or known]


def committed() -> str:
    """The commit of the plugin's sources.

    Raises
    ------
    HarnessError
        Where they were changed since.
    """
    commit = provenance.plugin_commit()
    if commit.endswith("+"):
        raise HarnessError(
            f"{', '.join(provenance.SOURCES)} have changes that are not committed: commit them first, because results "
            "name the commit that they were made with."
        )
    return commit


def _all(steps: list[Step], commit: str, folder: Path) -> list[Step]:
    """Do the steps, tell how long each takes, and return those that did not come to their end."""
    failed = []
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console) as progress:
        task = progress.add_task("evidence", total=len(steps))
        for step in steps:
            progress.update(task, description=step.name)
            start = time.monotonic()
            ended = _do(step, folder) and (step.is_done(commit) or not step.files)
            taken = timedelta(seconds=round(time.monotonic() - start))
            progress.console.print(f"{step.name}: {'done' if ended else 'FAILED'} in {taken}", markup=False)
            failed += [] if ended else [step]
            progress.advance(task)
    return failed


def _do(step: Step, folder: Path) -> bool:
    """Do a step, with what it says in a file; whether all of its commands came to their ends."""
    with (folder / f"{step.name}.log").open("w", encoding="utf-8") as log:
        for arguments in step.commands_in(folder):
            command = [sys.executable, "-m", "studies", *arguments]
            done = subprocess.run(command, cwd=REPOSITORY, stdout=log, stderr=subprocess.STDOUT, check=False)
            if done.returncode not in (DONE, DOES_NOT_HOLD):
                return False
    return True
