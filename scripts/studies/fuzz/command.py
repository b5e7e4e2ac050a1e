"""The command `fuzz`."""

import time
from collections import Counter
from pathlib import Path
from typing import Annotated

import typer

from harness.paths import RESULTS
from harness.run.runner import Runner
from studies import files, workflow
from studies.fuzz.draws import Kind
from studies.fuzz.seed_trial import Trial, attempt
from studies.options import Folder, Jobs, console

CHUNK = 20
"""Seeds a job."""
TIMEOUT = 60.0
"""s of wall time for one run."""


def fuzz(
    kind: Annotated[list[Kind] | None, typer.Option(help="Draw only this kind; the default draws both kinds.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="First seed of the random numbers.")] = 0,
    count: Annotated[int, typer.Option(min=1, help="Largest number of seeds of each kind.")] = 1000,
    minutes: Annotated[float, typer.Option(min=0.0, help="Wall time in minutes; the next call continues.")] = 60.0,
    folder: Folder = RESULTS / "fuzz",
    jobs: Jobs = 1,
) -> None:
    """Run random scenes and random parameters for a given time; the exit code is 1 if the command finds a fault.

    A fault is a crash, NaN in the results of a completed run, or forces or flows of the two sides that do not cancel.
    An error without a message that names its cause is also a fault. `fuzz --seed N --count 1` repeats the fault of the
    seed N.
    """
    deadline = time.time() + 60.0 * minutes
    chunks = [(first, min(CHUNK, seed + count - first)) for first in range(seed, seed + count, CHUNK)]
    wanted = {
        f"{each.value}-{first}-{size}": ("fuzz-seeds", each.value, str(first), str(size), f"{deadline:.0f}")
        for first, size in chunks
        for each in kind or Kind
    }
    paths = workflow.run(wanted, folder.resolve(), cores=jobs)
    trials = [trial for path in paths for trial in files.read_json(path, Trial)]
    for each in kind or Kind:
        own = [trial for trial in trials if trial.kind == each.value]
        counts = Counter("fault" if trial.faulty else trial.result for trial in own)
        console.print(f"{each.value}: {len(own)} seeds; " + ", ".join(f"{n} {what}" for what, n in counts.items()))
    faults = [trial for trial in trials if trial.faulty]
    for trial in faults:
        console.print(f"  {trial.kind} seed {trial.seed}: {trial.result}", markup=False)
    if faults:
        raise typer.Exit(1)


def fuzz_seeds(
    kind: Kind,
    first: int,
    count: int,
    deadline: Annotated[float, typer.Argument(help="Time (s since 1970) after which the command starts no run.")],
    out: Annotated[Path, typer.Option(help="Write the outcomes to this file, as JSON.")] = Path("fuzz.json"),
) -> None:
    """Run some seeds, and write no result if the time is over before the end."""
    runner = Runner(RESULTS / "fuzz" / "runs", timeout=TIMEOUT)
    trials: list[Trial] = []
    for seed in range(first, first + count):
        if time.time() > deadline:
            raise typer.Exit(1)
        trials.append(attempt(kind, seed, runner))
    files.write_json(trials, out)
