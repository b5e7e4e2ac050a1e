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
        In the contact for this effect: of the run with the least time in the contact, which other work disturbed least.
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


def _log(scene: Scene) -> str:
    return timing.execute(scene.model())[1]


def costs(scene: str, logs: Sequence[str]) -> list[EffectCost]:
    """What the logs of repeated runs say of each effect."""
    times: list[Times] = [one for log in logs for one in table.read(log)]
    best, worst = (choose(times, key=lambda one: one.total) for choose in (min, max))
    size = (best.share, best.memory, table.unknowns(logs[0]), table.entries(logs[0]))
    return [EffectCost(scene, name, spent, best.total, worst.total, *size) for name, spent in best.effects.items()]
