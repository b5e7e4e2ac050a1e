"""The command `robustness`."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import MODELS, RESULTS
from studies import feb
from studies.feb import Feb
from studies.options import TWO_AT_MOST, Folder, Timeout, console
from studies.robustness import sanitized, solvers, trial
from studies.robustness.execution import Way
from studies.robustness.trial import Finding, Trial

QUICK_MODELS = ("elastic", "confined-creep", "platens")
"""All solvers and facets that do not match; two bodies; three bodies of which one passes nothing."""
QUICK_STEPS, STEPS = 7, 12


def robustness(
    files: Annotated[list[Path] | None, typer.Argument(help="Additional .feb files.")] = None,
    only: Annotated[
        list[str] | None, typer.Option(help="Run only the model of this name. The option may be repeated.")
    ] = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="Run a few models and steps in less than three minutes.")
    ] = False,
    steps: Annotated[
        int | None, typer.Option(min=0, help="Number of time steps of each run; 0: all steps of the model.")
    ] = None,
    timeout: Timeout = 600.0,
    folder: Folder = RESULTS / "robustness",
    jobs: Annotated[int, typer.Option(min=1, help="Number of simultaneous models.")] = TWO_AT_MOST,
) -> None:
    """Run models with a sanitized plugin: unchanged, with two threads, restarts, repeated steps, and other solvers.

    The exit code is 0 without a crash, a report of a sanitizer, a growing leak, or a difference beyond rounding.
    """
    known = [solvers.elastic(), *(feb.read(path) for path in [*sorted(MODELS.glob("*.feb")), *(files or [])])]
    names = chosen(only or (QUICK_MODELS if quick else None), [model.name for model in known])
    models = [model for model in known if model.name in names]
    way = Way(sanitized.build(), timeout)
    made = steps if steps is not None else QUICK_STEPS if quick else STEPS
    findings = _all(models, way, folder.resolve() / "runs", made, jobs)
    console.print(f"{trial.table(findings)}\n\n{trial.summary(findings)}", markup=False)
    console.print(f"Written: {', '.join(map(str, trial.write(findings, folder)))}")
    if not all(found.passed for found in findings):
        raise typer.Exit(1)


def _all(models: list[Feb], way: Way, folder: Path, steps: int, jobs: int) -> list[Finding]:
    def findings(model: Feb) -> list[Finding]:
        found = list(Trial(model, way, folder / model.name, steps).findings())
        console.print(f"{model.name}: {trial.summary(found)}", markup=False)
        return found

    with ThreadPoolExecutor(jobs) as pool:
        return [found for each in pool.map(findings, models) for found in each]
