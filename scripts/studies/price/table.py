"""The table of times that each contact writes at the end of a run, and what each effect costs by it."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from harness.errors import DataFileError
from studies import timing
from studies.price.scenes import Scene
from studies.stamps import LIMIT
from studies.timing import Announce

_TITLE = re.compile(r'^sliding-mixture "(?P<name>.*)": time in the contact \[s\]$')
_SHARE = re.compile(r"^ +share of the run: [-\d.e+]+ percent of (?P<run>[-\d.e+]+) s$")
_MEMORY = re.compile(r"^ +memory: (?P<bytes>\d+) bytes for each of (?P<points>\d+) integration points$")
_UNKNOWNS = re.compile(r"Nr of equations \.+ : (\d+)")
_ENTRIES = re.compile(r"Nr of nonzeroes in stiffness matrix \.+ : (\d+)")
_COLUMNS = re.compile(r" {2,}")
TASKS = ("search", "residual", "stiffness", "augmentation", "output")


@dataclass(frozen=True)
class Times:
    """What one contact cost in one run."""

    seconds: dict[str, dict[str, float]]
    """By task, one of `TASKS`, and then by effect: ``shared``, ``traction``, ``solvent``, ``solute 1`` and so on."""
    run: float  # s, of the whole run
    points: int  # integration points that see the other surface; 0 where there was no contact
    memory: int  # bytes that the contact keeps for each of them

    @property
    def effects(self) -> dict[str, float]:
        """Seconds by effect, over all tasks."""
        names = self.seconds[TASKS[0]]
        return {name: sum(task[name] for task in self.seconds.values()) for name in names}

    @property
    def share(self) -> float:
        """Part of the run's time that the contact takes."""
        return sum(self.effects.values()) / self.run


def unknowns(log: str) -> int:
    """Equations of a run; 0 where none were solved."""
    return max(map(int, _UNKNOWNS.findall(log)), default=0)


def entries(log: str) -> int:
    """The most entries of the matrix in a run."""
    return max(map(int, _ENTRIES.findall(log)), default=0)


def read(log: str) -> list[Times]:
    """The tables of a log, one per contact; none for a run that was ended before its time.

    Raises DataFileError where a table is incomplete or not one of numbers.
    """
    lines = log.splitlines()
    return [_table(match["name"], lines[i + 1 :]) for i, line in enumerate(lines) if (match := _TITLE.match(line))]


def _table(name: str, lines: list[str]) -> Times:
    try:
        effects = _COLUMNS.split(lines[0].strip())[:-2]
        rows = [_COLUMNS.split(line.strip()) for line in lines[1 : len(TASKS) + 1]]
        seconds = {row[0]: dict(zip(effects, map(float, row[1:-2]), strict=True)) for row in rows}
        share = _SHARE.match(lines[len(TASKS) + 2])
        kept = _MEMORY.match(lines[len(TASKS) + 3])
        points, memory = (int(kept["points"]), int(kept["bytes"])) if kept else (0, 0)
        if tuple(seconds) != TASKS or not share:
            raise ValueError(f"tasks {', '.join(seconds)}")
        return Times(seconds, float(share["run"]), points, memory)
    except (IndexError, ValueError) as error:
        raise DataFileError(f'the log\'s table of times of the contact "{name}" is not one ({error})') from error


@dataclass(frozen=True)
class EffectCost:
    """One effect of one scene."""

    scene: str
    effect: str  # ``shared`` is what all effects need
    part: float  # part of the run's time that the contact takes for this effect, of the run whose share is the median
    # Part of all effects: median, least and largest.
    share: float
    share_low: float
    share_high: float
    bytes: int  # memory for each integration point
    # Equations of the run, and the most entries of its matrix.
    unknowns: int
    entries: int


def measure(scenes: Mapping[str, Scene], repetitions: int, announce: Announce) -> list[EffectCost]:
    """Run all scenes in turn, `repetitions` times."""
    models = {name: scene.model() for name, scene in scenes.items()}
    runs = timing.interleave(models, repetitions, announce, processor_limit=LIMIT)
    return [cost for name, found in runs.items() for cost in costs(name, [log for _, log in found])]


def costs(scene: str, logs: Sequence[str]) -> list[EffectCost]:
    """What the logs of repeated runs say of each effect.

    Other work stretches the time of the contact and of the run alike, so that the part of the one in the other stays.
    """
    found = sorted((one for log in logs for one in read(log)), key=lambda times: times.share)
    middle = found[len(found) // 2]
    shares = (middle.share, found[0].share, found[-1].share)
    size = (middle.memory, unknowns(logs[0]), entries(logs[0]))
    return [EffectCost(scene, name, spent / middle.run, *shares, *size) for name, spent in middle.effects.items()]
