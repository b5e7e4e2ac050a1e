"""Runs ours, FEBio's own contact and the conforming reference in turn, and compares iterations and times."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from statistics import median

from harness.models.interface import ContactSettings, InterfaceType
from studies import timing
from studies.hard_cases.scene import Interface
from studies.models.pieces import PREDICTOR
from studies.price import table
from studies.price.scenes import Kind, Scene, penalties
from studies.stamps import LIMIT, at_limit

Announce = Callable[[str], None]
"""Told what is being run."""

_TIMER = re.compile(r"^\s*([a-z ]+?) \.+ : \d+:\d\d:\d\d \(([-\d.e+]+) sec\)", re.MULTILINE)
PREDICTING = ContactSettings(extra=(PREDICTOR,))
FACTORS = (1000.0, 1.0)
"""Factors of FEBio's automatic penalties that it is timed with: accurate, and as FEBio proposes."""


def timers(log: str) -> dict[str, float]:
    """FEBio's own timers (s of wall time) by its names of them; the last analysis step's where there are several."""
    return {name: float(seconds) for name, seconds in _TIMER.findall(log)}


@dataclass(frozen=True)
class Timed:
    """One run.

    Attributes
    ----------
    ended : bool
    iterations, residuals : int
    cpu : float
        Processor time of the run, s.
    update, profile, stiffness, residual : float
        FEBio's timers of model update, of forming the matrix profile, and of evaluating stiffness and residual, s.
    unknowns, entries : int
        Equations, and the most entries of the matrix.
    """

    ended: bool
    iterations: int
    residuals: int
    cpu: float
    update: float
    profile: float
    stiffness: float
    residual: float
    unknowns: int
    entries: int


def run(scene: Scene) -> Timed:
    """Run a scene once, with one thread unless ``OMP_NUM_THREADS`` says otherwise.

    Raises
    ------
    EngineNotFoundError, PluginNotFoundError
        Without febio4 or the plugin.
    """
    done, log = timing.execute(scene.model(), check=False, processor_limit=LIMIT)
    spent = timers(log)
    report = done.report
    parts = ("model update", "reforming stiffness", "evaluating stiffness", "evaluating residual")
    update, profile, stiffness, residual = (spent.get(part, math.nan) for part in parts)
    return Timed(
        report.normal,
        report.iterations,
        report.residuals,
        done.cpu,
        update,
        profile,
        stiffness,
        residual,
        table.unknowns(log),
        table.entries(log),
    )


def contact_time(with_contact: Timed, reference: Timed) -> float:
    """Seconds that a contact takes in updates, matrix profile, stiffness and residual of one run.

    What the bodies take is known from the reference's run: its stiffness per iteration, its update and residual per
    evaluation. All of the profile is the contact's, since without one it is formed once.
    """
    iterations, residuals = with_contact.iterations / reference.iterations, with_contact.residuals / reference.residuals
    return (
        with_contact.profile
        + (with_contact.stiffness - iterations * reference.stiffness)
        + (with_contact.update + with_contact.residual - residuals * (reference.update + reference.residual))
    )


@dataclass(frozen=True)
class Price:
    """What one contact costs on one scene, from several runs.

    Attributes
    ----------
    kind : str
    type : str
        Type of the contact, as `Interface` has it for ours with the predictor.
    factor : float
        Penalty factor; 0 for our defaults.
    ended : bool
    limited : bool
        Whether the limit ended a run.
    iterations, reference_iterations : int
        Newton iterations with this contact and of the conforming reference.
    contact : float
        Median of `contact_time`, s.
    added, added_low, added_high : float
        Median, least and largest of (processor time of the run)/(that of the conforming reference, run in turn) - 1.
    unknowns, entries : int
        Equations, and the most entries of the matrix.
    """

    kind: str
    type: str
    factor: float
    ended: bool
    limited: bool
    iterations: int
    reference_iterations: int
    contact: float
    added: float
    added_low: float
    added_high: float
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
    scenes = compared(scene)
    runs = timing.interleave(
        {key: partial(run, one) for key, one in scenes.items()},
        repetitions,
        lambda key, number: announce(f"{scenes[key].name} ({number} of {repetitions})"),
    )
    reference = runs.pop((InterfaceType.CONFORMING.value, 0.0))
    return [_price(scene.kind, key, found, reference) for key, found in runs.items()]


def _price(kind: Kind, key: tuple[str, float], runs: Sequence[Timed], reference: Sequence[Timed]) -> Price:
    pairs = list(zip(runs, reference, strict=True))
    ended = all(one.ended for one in runs)
    contact = median(contact_time(one, other) for one, other in pairs) if ended else math.nan
    added = [one.cpu / other.cpu - 1.0 for one, other in pairs] if ended else [math.nan]
    counts = (runs[0].unknowns, runs[0].entries)
    limited = any(at_limit(one.ended, one.cpu) for one in runs)
    return Price(
        kind.value,
        *key,
        ended,
        limited,
        runs[0].iterations,
        reference[0].iterations,
        contact,
        *timing.spread(added),
        *counts,
    )
