"""Runs that are timed: each by itself, and interleaved with those that they are compared with."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

from harness.models.document import Model
from harness.run import engine
from harness.run.runner import RunResult, needs_plugin

Key = TypeVar("Key")
Announce = Callable[[str], None]  # told of each run before it begins
Timed = tuple[engine.Run, str]  # a run, and its log
SHORT = 10.0  # s of processor time of a run that is short enough to be repeated for its time alone


def execute(model: Model, *, check: bool = True, processor_limit: float | None = None) -> Timed:
    """Run a model by itself, and keep nothing but what febio4 said and its log.

    processor_limit: s of processor time after which the run is ended.
    Raises EngineNotFoundError, PluginNotFoundError, EngineFailedError: see `harness.run.engine`.
    """
    with TemporaryDirectory() as folder:
        path = model.write(Path(folder))
        command = engine.limited(engine.Febio4().command(path, needs_plugin(model)), processor_limit)
        done = engine.execute(command, Path(folder), check=check)
        return done, path.with_suffix(".log").read_text(errors="replace")


def interleave(
    models: Mapping[Key, Model], repetitions: int, announce: Announce = lambda _: None, **options: Any
) -> dict[Key, list[Timed]]:
    """Run every model once, then every model again: what slows the machine for a while slows all of them.

    options: those of `execute`.
    """
    found: dict[Key, list[Timed]] = {key: [] for key in models}
    for number in range(1, repetitions + 1):
        for key, model in models.items():
            announce(f"{key} ({number} of {repetitions})")
            found[key].append(execute(model, **options))
    return found


def ratios(runs: Sequence[Timed], reference: Sequence[Timed]) -> list[float]:
    """Processor times of runs over those of the reference, run in turn."""
    return [one.cpu / other.cpu for (one, _), (other, _) in zip(runs, reference, strict=True)]


def in_turn(runs: Mapping[Key, RunResult], repetitions: int) -> dict[Key, list[float]]:
    """Processor times (s) of runs that are done, and of as many repetitions in turn of those that are short."""
    again = {key: run.model for key, run in runs.items() if run.cpu < SHORT}
    repeated = interleave(again, repetitions - 1)
    return {key: [run.cpu, *(done.cpu for done, _ in repeated.get(key, []))] for key, run in runs.items()}


def spread(values: Sequence[float]) -> tuple[float, float, float]:
    """Median, least and largest."""
    return median(values), min(values), max(values)
