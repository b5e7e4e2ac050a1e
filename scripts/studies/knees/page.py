"""The page of the knee: docs/evidence/knee.md, from docs/data/knee.csv."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from harness.models.interface import InterfaceType
from studies import files, tables
from studies.knees.knee_run import KneeRun
from studies.pages.evidence import DATA, EvidencePage

LIMIT = 900.0
"""s of processor time for one run."""
SOURCE, PICTURE = "knee.csv", "knee.png"
_OURS = InterfaceType.MIXTURE.value
_LIMITS = """\
Cartilage and menisci are elastic here. The sizes `medium` and `large` are not among these runs. Gait runs on the coarse
mesh alone, which does not resolve the pressure. No conforming reference decides between the pressures."""


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    runs = files.read_csv(DATA / SOURCE, KneeRun)
    return {
        "headline": headline(runs),
        "compared": compared(runs),
        "runs": table(runs),
        "compartments": compartments(runs),
        "limits": _LIMITS,
    }


def headline(runs: Sequence[KneeRun]) -> str:
    """Who completes."""
    ours, theirs = _sides(runs)
    return (
        f"`sliding-mixture` completes {_done(ours)} of {len(ours)} runs. FEBio's interface completes "
        f"{_done(theirs)} of {len(theirs)} with three factors of its penalty."
    )


def _sides(runs: Sequence[KneeRun]) -> tuple[list[KneeRun], list[KneeRun]]:
    """Runs with the plugin, and with FEBio's interface."""
    return [run for run in runs if run.contact == _OURS], [run for run in runs if run.contact != _OURS]


def compared(runs: Sequence[KneeRun]) -> str:
    """`sliding-mixture` over two runs of FEBio's interface for each load: the fastest, and the one that overlaps least.

    Only runs that complete are compared.
    """
    ours, theirs = _sides(runs)
    rows = [row for mine in ours if mine.ended for row in _compared(mine, theirs)]
    return tables.markdown(("load", "run of FEBio's interface", "iterations", "time", "memory", "overlap"), rows)


def _done(runs: Sequence[KneeRun]) -> int:
    return sum(run.ended for run in runs)


def _compared(mine: KneeRun, theirs: Sequence[KneeRun]) -> list[tuple[str, ...]]:
    """Two rows, or none if no run of FEBio's completes."""
    rivals = [run for run in theirs if run.ended and run.load == mine.load]
    if not rivals:
        return []
    fastest = min(rivals, key=lambda run: run.iterations)
    tightest = min(rivals, key=lambda run: run.overlap)
    return [
        (mine.load, "fewest iterations", *_times(mine, fastest)),
        (mine.load, "least overlap", *_times(mine, tightest)),
    ]


def _times(mine: KneeRun, other: KneeRun) -> tuple[str, ...]:
    """Iterations, time, memory and overlap over those of another run."""
    ratios = (mine.iterations / other.iterations, mine.seconds / other.seconds, mine.memory / other.memory)
    return (*(f"{ratio:.2f}" for ratio in ratios), f"{mine.overlap / other.overlap:.1g}")


def _name(run: KneeRun) -> tuple[str, str]:
    return f"{run.load}, {run.size}", f"`{run.contact}`" + (f" × {run.factor:g}" if run.factor else "")


def table(runs: Sequence[KneeRun]) -> str:
    """How the runs went."""
    heads = ("completes", "until [s]", "steps", "iterations", "retries", "time [s]", "memory [MB]")
    rows = []
    for run in runs:
        counts = (run.steps, run.iterations, run.retries, f"{run.seconds:.0f}", f"{run.memory:.0f}")
        rows.append((*_name(run), _outcome(run), f"{run.reached:.3g}", *counts))
    return tables.markdown(("load, size", "contact", *heads), rows)


def _outcome(run: KneeRun) -> str:
    return "yes" if run.ended else "no, at the limit of time" if run.limited else "no"


def compartments(runs: Sequence[KneeRun]) -> str:
    """Force, area and largest pressure."""
    heads = ("load, size", "contact", "force [N]", "area [mm²]", "largest pressure [MPa]", "largest overlap [mm]")
    return tables.markdown(heads, ((*_name(run), *_passing(run), f"{run.overlap:.4f}") for run in runs))


def _passing(run: KneeRun) -> list[str]:
    """Force, area and largest pressure, medial and lateral."""
    force, area = (run.force_medial, run.force_lateral), (run.area_medial, run.area_lateral)
    numbers = ((force, ".0f"), (area, ".0f"), ((run.peak_medial, run.peak_lateral), ".2f"))
    return [", ".join(f"{value:{form}}" for value in values) for values, form in numbers]


PAGE = EvidencePage("evidence/knee.md", (SOURCE,), Path(__file__).with_name("page.md"), figures)
