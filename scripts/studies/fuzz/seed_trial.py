"""Runs what a seed stands for and says whether anything is wrong with it."""

import math
import re
from dataclasses import dataclass

from harness.errors import DataFileError
from harness.models.document import Model
from harness.models.parts import text_of
from harness.run.runner import Runner, RunResult
from studies.fuzz.draws import Kind, draw
from studies.hard_cases import invariants

ENDED, GAVE_UP, REFUSED, TOO_LONG = "ended", "no convergence", "refused", "too long"
_TERMINATION = "E R R O R   T E R M I N A T I O N"


@dataclass(frozen=True)
class Trial:
    """A seed and what came of it."""

    kind: str
    seed: int
    result: str
    """One of the four above; or what is wrong, after "FAULT: "."""

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
