"""What each effect costs in scenes that exchange more and more: times, unknowns, entries of the matrix."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from harness.studies import timing
from harness.studies.price import table
from harness.studies.price.scenes import Scene
from harness.studies.price.table import Times


@dataclass(frozen=True)
class EffectCost:
    """One effect of one scene.

    Attributes
    ----------
    scene : str
    effect : str
        ``shared`` is what all effects need.
    seconds : float
        Processor time in the contact for this effect: its part of the run's wall time, times the run's processor time,
        of the run with the least time in the contact.
    least, most : float
        s of all effects in the runs with the least and the most time in the contact.
    share : float
        Part of the run's time that the contact takes.
    bytes : int
        Memory for each integration point.
    unknowns, entries : int
        Equations of the run, and the most entries of its matrix.
    """

    scene: str
    effect: str
    seconds: float
    least: float
    most: float
    share: float
    bytes: int
    unknowns: int
    entries: int


def measure(scenes: Mapping[str, Scene], repetitions: int, announce: Callable[[str], None]) -> list[EffectCost]:
    """Run all scenes in turn, `repetitions` times."""
    runs = timing.interleave(
        {name: partial(_log, scene) for name, scene in scenes.items()},
        repetitions,
        lambda name, number: announce(f"{name} ({number} of {repetitions})"),
    )
    return [cost for name, logs in runs.items() for cost in costs(name, logs)]


def _log(scene: Scene) -> tuple[str, float]:
    """Log and processor time (s) of a run."""
    done, log = timing.execute(scene.model())
    return log, done.cpu


def costs(scene: str, runs: Sequence[tuple[str, float]]) -> list[EffectCost]:
    """What the logs and processor times of repeated runs say of each effect.

    Other work stretches the wall time of the contact and of the run alike, so that the part of the one in the other
    stays.
    """
    shares: list[tuple[Times, float]] = [(one, cpu) for log, cpu in runs for one in table.read(log)]
    spent = [times.share * cpu for times, cpu in shares]
    best, cpu = shares[spent.index(min(spent))]
    log = runs[0][0]
    size = (min(spent), max(spent), best.share, best.memory, table.unknowns(log), table.entries(log))
    return [EffectCost(scene, name, wall / best.run * cpu, *size) for name, wall in best.effects.items()]
