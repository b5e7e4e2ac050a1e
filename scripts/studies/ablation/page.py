"""The page of devices that are left out one at a time: docs/reference/ablation.md, from docs/data/ablation.csv."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from studies import files, tables
from studies.ablation.ablated_runs import Ablated
from studies.ablation.ablated_scenes import SCENES
from studies.pages.evidence import DATA, EvidencePage

SOURCE = "ablation.csv"
BETTER = 0.02
"""Part of the iterations that a run without a device saves, at least, where the scene is better without it."""
_HEADS = (
    *("scenes", "device", "acts in", "iterations", "matrices", "entries", "time"),
    *("better without it", "worse without it"),
)


@dataclass(frozen=True)
class Pair:
    """A scene with all devices, and without one of them that acted."""

    whole: Ablated
    without: Ablated

    @property
    def is_complete(self) -> bool:
        """Whether both runs complete."""
        return self.whole.ended and self.without.ended

    @property
    def is_better(self) -> bool:
        """Whether the run without the device is better."""
        return _beats(self.without, self.whole)

    @property
    def is_worse(self) -> bool:
        """Whether the run with all devices is better."""
        return _beats(self.whole, self.without)

    def ratio(self, figure: str) -> float:
        """A figure without the device over that with all devices."""
        return float(getattr(self.without, figure) / max(getattr(self.whole, figure), 1e-9))


def _beats(one: Ablated, other: Ablated) -> bool:
    """Whether a run completes where the other does not, has fewer retries, or clearly fewer iterations."""
    if one.ended != other.ended:
        return one.ended
    if one.retries != other.retries:
        return one.retries < other.retries
    return one.iterations <= (1 - BETTER) * other.iterations


def pairs(rows: Sequence[Ablated]) -> list[Pair]:
    """Pairs of runs with all devices and without one that acted, in the order of the data."""
    return [pair for pair in _pairs(rows) if pair.without.without in pair.whole.acted]


def pairs_without_any(rows: Sequence[Ablated]) -> list[Pair]:
    """Pairs of runs with all devices and without any, of scenes in which some acted."""
    return [pair for pair in _pairs(rows) if pair.without.without == "any" and pair.whole.acted]


def _pairs(rows: Sequence[Ablated]) -> Iterator[Pair]:
    whole = {row.scene: row for row in rows if row.without == "nothing"}
    return (Pair(whole[row.scene], row) for row in rows if row.without != "nothing")


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    rows = files.read_csv(DATA / SOURCE, Ablated)
    found = pairs(rows)
    return {
        "summary": summary(found),
        "table": tables.markdown(_HEADS, _lines([*found, *pairs_without_any(rows)])),
        "least": f"{BETTER:.0%}".replace("%", " %"),
        "better": tables.markdown(
            ("scene", "device", "with all devices", "without it", "time without the device / time with all devices"),
            _better(found),
        ),
        "scope": _scope(rows),
    }


def summary(found: Sequence[Pair]) -> str:
    """How often the devices help and harm."""
    better = sum(pair.is_better for pair in found)
    worse = sum(pair.is_worse for pair in found)
    return (
        f"The scene is worse without the device in {worse} of {len(found)} comparisons of all devices with all but "
        f"one. It is better without the device in {better}."
    )


def _lines(found: Sequence[Pair]) -> Iterator[tuple[str, ...]]:
    for kind in dict.fromkeys(pair.whole.kind for pair in found):
        of_kind = [pair for pair in found if pair.whole.kind == kind]
        for device in dict.fromkeys(pair.without.without for pair in of_kind):
            yield _line(kind, device, [pair for pair in of_kind if pair.without.without == device])


def _line(kind: str, device: str, found: Sequence[Pair]) -> tuple[str, ...]:
    complete = [pair for pair in found if pair.is_complete]
    figures = ("iterations", "matrices", "entries", "time")
    medians = (f"{median(pair.ratio(each) for pair in complete):.2f}" if complete else "" for each in figures)
    counts = (sum(pair.is_better for pair in found), sum(pair.is_worse for pair in found))
    name = "all of them" if device == "any" else f"`{device}`"
    return f"{kind}s", name, str(len(found)), *medians, *map(str, counts)


def _better(found: Sequence[Pair]) -> Iterator[tuple[str, ...]]:
    for pair in found:
        if pair.is_better:
            time = f"{pair.ratio('time'):.2f}" if pair.is_complete else ""
            yield pair.whole.scene, f"`{pair.without.without}`", _cell(pair.whole), _cell(pair.without), time


def _cell(row: Ablated) -> str:
    retries = f" ({row.retries})" if row.retries else ""
    return f"{row.iterations}{retries}" if row.ended else "fails"


def _scope(rows: Sequence[Ablated]) -> str:
    measured = {row.scene: row.kind for row in rows}
    known = [scene.kind for scene in SCENES.values()]
    parts = [f"{list(measured.values()).count(kind)} of {known.count(kind)} {kind}s" for kind in dict.fromkeys(known)]
    return f"The data have {', '.join(parts[:-1])} and {parts[-1]}."


PAGE = EvidencePage("reference/ablation.md", (SOURCE,), Path(__file__).with_name("page.md"), figures)
