"""Runs ours, FEBio's own contact and the conforming reference in turn, and compares iterations and times."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from harness.models.interface import ContactSettings, InterfaceType
from studies import timing
from studies.hard_cases.scene import Interface
from studies.models.pieces import PREDICTOR
from studies.price import joints, table
from studies.price.scenes import Kind, Scene, penalties
from studies.stamps import at_limit
from studies.timing import Announce, Timed

PREDICTING = ContactSettings(extra=(PREDICTOR,))
FACTORS = (1000.0, 1.0)  # factors of FEBio's automatic penalties that it is timed with: accurate, and as FEBio proposes


@dataclass(frozen=True)
class Price:
    """What one contact costs on one scene, from several runs."""

    kind: str
    type: str  # type of the contact, as `Interface` has it for ours with the predictor
    factor: float  # penalty factor; 0 for our defaults
    ended: bool
    limited: bool  # whether the limit ended a run
    iterations: int  # Newton iterations
    added: float
    added_low: float
    added_high: float
    """Median, least and largest of (processor time of the run)/(that of the conforming reference, run in turn) - 1."""
    # Equations, and the most entries of the matrix.
    unknowns: int
    entries: int


def compared(scene: Scene) -> dict[tuple[str, float], Scene]:
    """The scene with each contact that is compared, by its type and penalty factor; the conforming reference first."""
    found = {
        (InterfaceType.CONFORMING.value, 0.0): replace(scene, contact=InterfaceType.CONFORMING.value),
        (Interface.MIXTURE.value, 0.0): scene,
        (Interface.PREDICTED.value, 0.0): replace(scene, settings=PREDICTING),
    }
    for factor in FACTORS:
        rival = scene.kind.rival
        found[rival, factor] = replace(scene, contact=rival, settings=penalties(scene.kind, factor))
    return found


def prices(scene: Scene, repetitions: int, announce: Announce) -> list[Price]:
    """Compare the contacts on one scene; all are run in turn, `repetitions` times."""
    models = {key: one.model() for key, one in compared(scene).items()}
    runs = joints.run(models, repetitions, lambda told: announce(f"{scene.kind.value}: {told}"))
    reference = runs.pop((InterfaceType.CONFORMING.value, 0.0))
    return [_price(scene.kind, key, found, reference) for key, found in runs.items()]


def _price(kind: Kind, key: tuple[str, float], runs: Sequence[Timed], reference: Sequence[Timed]) -> Price:
    first, log = runs[0]
    ended = all(one.report.normal for one, _ in runs)
    limited = any(at_limit(one.report.normal, one.cpu) for one, _ in runs)
    added = [ratio - 1.0 for ratio in timing.ratios(runs, reference)] if ended else [math.nan]
    size = (table.unknowns(log), table.entries(log))
    return Price(kind.value, *key, ended, limited, first.report.iterations, *timing.spread(added), *size)
