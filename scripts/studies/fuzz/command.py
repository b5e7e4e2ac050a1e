"""The command `fuzz`, and what one seed gives."""

import math
import re
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from harness.errors import DataFileError
from harness.models.document import Model
from harness.models.parts import text_of
from harness.paths import RESULTS
from harness.run.runner import Runner, RunResult
from studies import files, workflow
from studies.fuzz.draws import Kind, draw
from studies.hard_cases import invariants
from studies.options import Folder, Jobs, console

ENDED, GAVE_UP, REFUSED, TOO_LONG = "ended", "no convergence", "refused", "too long"
_TERMINATION = "E R R O R   T E R M I N A T I O N"


@dataclass(frozen=True)
class Trial:
    """A seed and what came of it."""

    kind: str
    seed: int
    result: str  # one of the four above; or what is wrong, after "FAULT: "

    @property
    def faulty(self) -> bool:
        """Whether this is a fault: a crash, NaN in the results, a violated balance, a refusal without a reason."""
        return self.result.startswith("FAULT")


def attempt(kind: Kind, seed: int, runner: Runner, *, integration: str | None = None) -> Trial:
    """Run a seed; as in `draw`."""
    model = draw(kind, seed, integration=integration)
    run = runner(model, check=False)
    return Trial(kind.value, seed, _judge(model, run, runner.timeout or math.inf))


def _judge(model: Model, run: RunResult, timeout: float) -> str:
    screen = (run.folder / "screen.txt").read_text(errors="replace")
    if run.report.normal:
        wrong = _wrong(run)
        return f"FAULT: {wrong}" if wrong else ENDED
    if run.wall >= timeout:
        return TOO_LONG
    refusal = _refusal(model, screen)
    if refusal:
        return refusal
    return GAVE_UP if _TERMINATION in screen else "FAULT: it ended without a word"


def _refusal(model: Model, screen: str) -> str:
    """Whether the model was refused before the first step, with a message that names what was set."""
    if "beginning time step" in screen:
        return ""
    named = [p.tag for contact in model.contacts for p in contact.params]
    if any(re.search(rf"\b{re.escape(name)}\b", screen) for name in named):
        return REFUSED
    values = ", ".join(f"{p.tag} = {text_of(p.value)!r}" for contact in model.contacts for p in contact.params)
    return f"FAULT: refused without naming any of {values}"


def _wrong(run: RunResult) -> str:
    """The first measure that a run which ended misses: numbers, and balances of both sides."""
    try:
        measures = [*invariants.finite_and_bounded(run, math.inf)[:1], *invariants.cancellation(run)]
    except DataFileError as error:
        return str(error)
    return "; ".join(f"{m.name} {m.value:.3g}" for m in measures if not m.passed)


CHUNK = 20  # seeds a job
TIMEOUT = 60.0  # s of wall time for one run


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
