"""What each effect costs in scenes that exchange more and more: times, unknowns, entries of the matrix."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from studies import timing
from studies.price import table
from studies.price.scenes import Scene
from studies.stamps import LIMIT


@dataclass(frozen=True)
class EffectCost:
    """One effect of one scene."""

    scene: str
    effect: str
    """``shared`` is what all effects need."""
    part: float
    """Part of the run's time that the contact takes for this effect, of the run whose share is the median."""
    share: float
    share_low: float
    share_high: float
    """Part of all effects: median, least and largest."""
    bytes: int
    """Memory for each integration point."""
    unknowns: int
    entries: int
    """Equations of the run, and the most entries of its matrix."""


def measure(scenes: Mapping[str, Scene], repetitions: int, announce: Callable[[str], None]) -> list[EffectCost]:
    """Run all scenes in turn, `repetitions` times."""
    runs = timing.interleave(
        {name: partial(timing.execute, scene.model(), processor_limit=LIMIT) for name, scene in scenes.items()},
        repetitions,
        lambda name, number: announce(f"{name} ({number} of {repetitions})"),
    )
    return [cost for name, found in runs.items() for cost in costs(name, [log for _, log in found])]


def costs(scene: str, logs: Sequence[str]) -> list[EffectCost]:
    """What the logs of repeated runs say of each effect.

    Other work stretches the time of the contact and of the run alike, so that the part of the one in the other stays.
    """
    found = sorted((one for log in logs for one in table.read(log)), key=lambda times: times.share)
    middle = found[len(found) // 2]
    shares = (middle.share, found[0].share, found[-1].share)
    size = (middle.memory, table.unknowns(logs[0]), table.entries(logs[0]))
    return [EffectCost(scene, name, spent / middle.run, *shares, *size) for name, spent in middle.effects.items()]
