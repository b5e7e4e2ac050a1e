"""The command `evidence`."""

from typing import Annotated

import typer

from harness.choice import chosen
from harness.errors import HarnessError
from harness.paths import RESULTS
from studies import stamps, workflow
from studies.evidence.steps import STEPS
from studies.options import console


def evidence(
    only: Annotated[
        list[str] | None,
        typer.Option(
            help="Do only this step, even if its results are up to date. The option may be repeated.", metavar="STEP"
        ),
    ] = None,
) -> None:
    """Measure all comparisons and all other evidence of the documentation again, one step at a time.

    Each run has one thread. All runs of a comparison with FEBio's interfaces have the same limit. The command skips a
    step if the present commit of the plugin made its files in docs/data with this limit. It therefore continues after
    an interruption. Nothing else should run at the same time, because some steps measure times.
    """
    known = {step.name: step for step in STEPS}
    steps = [known[name] for name in chosen(only, known)]
    commit = committed()
    folder = RESULTS / "evidence" / commit
    wanted = [step for step in steps if only or not step.is_done(commit)]
    done = workflow.in_turn({step.name: step.commands_in(folder) for step in wanted}, folder)
    failed = [step for step in wanted if step.name not in done or (step.files and not step.is_done(commit))]
    for step in steps:
        console.print(f"{step.name}: {'FAILED' if step in failed else 'done'} at commit {commit}", markup=False)
    if failed:
        raise HarnessError(f"not done: {', '.join(step.name for step in failed)}; their logs are in {folder}")


def committed() -> str:
    """The commit of the plugin's sources. Raises HarnessError where they were changed since."""
    commit = stamps.plugin_commit()
    if commit.endswith("+"):
        raise HarnessError(
            f"{', '.join(stamps.SOURCES)} have changes that are not committed: commit them first, because results "
            "name the commit that they were made with."
        )
    return commit
