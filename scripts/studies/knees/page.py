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
mesh alone, which does not resolve the pressure. No conforming reference says which pressure is right."""


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    runs = files.read_csv(DATA / SOURCE, KneeRun)
    return {"headline": headline(runs), "runs": table(runs), "compartments": compartments(runs), "limits": _LIMITS}


def headline(runs: Sequence[KneeRun]) -> str:
    """Who completes, and how much it takes."""
    ours, theirs = ([run for run in runs if (run.contact == _OURS) is mine] for mine in (True, False))
    done = f"`sliding-mixture` completes {_done(ours)} of {len(ours)} runs, FEBio's interface {_done(theirs)} of "
    compared = [_compared(mine, theirs) for mine in ours if mine.ended]
    return f"{done}{len(theirs)} with three factors of its penalty. {' '.join(compared)}"


def _done(runs: Sequence[KneeRun]) -> int:
    return sum(run.ended for run in runs)


def _compared(mine: KneeRun, theirs: Sequence[KneeRun]) -> str:
    """The plugin's run of a load beside two of FEBio's that complete: the fastest and the one that overlaps least."""
    rivals = [run for run in theirs if run.ended and run.load == mine.load]
    if not rivals:
        return f"In {mine.load}, no run of FEBio's completes."
    fastest = min(rivals, key=lambda run: run.iterations)
    tightest = min(rivals, key=lambda run: run.overlap)
    return (
        f"In {mine.load}, `sliding-mixture` takes {_times(mine, fastest)} the run of FEBio's with the fewest "
        f"iterations, and {_times(mine, tightest)} the run of FEBio's with the least overlap. It leaves "
        f"{mine.overlap / fastest.overlap:.1g} and {mine.overlap / tightest.overlap:.1g} times as much overlap."
    )


def _times(mine: KneeRun, other: KneeRun) -> str:
    return (
        f"{mine.iterations / other.iterations:.2f} times the iterations, {mine.seconds / other.seconds:.2f} times the "
        f"time and {mine.memory / other.memory:.2f} times the memory of"
    )


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
