"""Runs that are timed: each by itself, and interleaved with those that they are compared with."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import TypeVar

from harness.models.document import Model
from harness.run import engine
from harness.run.runner import RunResult, needs_plugin

Key = TypeVar("Key")
Result = TypeVar("Result")
Announce = Callable[[Key, int], None]
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
    runs: Mapping[Key, Callable[[], Result]], repetitions: int, announce: Announce[Key] | None = None
) -> dict[Key, list[Result]]:
    """Make every run once, then every run again: what slows the machine for a while slows all of them.

    `announce` is told of each run and its number, from 1, before it begins.
    """
    found: dict[Key, list[Result]] = {key: [] for key in runs}
    for number in range(1, repetitions + 1):
        for key, run in runs.items():
            if announce is not None:
                announce(key, number)
            found[key].append(run())
    return found


def beside(model: Model, reference: Model, repetitions: int) -> list[tuple[engine.Run, engine.Run]]:
    """Runs of a model and of a reference, in turn."""
    runs = {name: partial(execute, each) for name, each in (("own", model), ("reference", reference))}
    own, other = interleave(runs, repetitions).values()
    return [(one, two) for (one, _), (two, _) in zip(own, other, strict=True)]


def in_turn(runs: Mapping[Key, RunResult], repetitions: int) -> dict[Key, list[float]]:
    """Processor times (s) of runs that are done, and of as many repetitions in turn of those that are short."""
    again = {key: partial(execute, run.model) for key, run in runs.items() if run.cpu < SHORT}
    repeated = interleave(again, repetitions - 1)
    return {key: [run.cpu, *(done.cpu for done, _ in repeated.get(key, []))] for key, run in runs.items()}


def spread(values: Sequence[float]) -> tuple[float, float, float]:
    """Median, least and largest."""
    return median(values), min(values), max(values)
