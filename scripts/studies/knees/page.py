"""The page of the elastic knee, that of its runs, and tables of knees of all kinds."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from harness.models.interface import InterfaceType
from harness.models.knee.whole_mesh import Size
from studies import files, tables
from studies.knees.knee_run import Kind, KneeRun, Way
from studies.pages.evidence import DATA, EvidencePage

LIMIT = 900.0  # s of processor time for one run
SOURCE = "knee.csv"
_OURS = InterfaceType.MIXTURE.value
_LIMITS = "The coarse mesh does not resolve the pressure. No conforming reference decides between the pressures."


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    runs = _runs()
    return {"headline": headline(runs), "compared": compared(runs), "limits": limits(runs)}


def figures_of_tables() -> Mapping[str, str]:
    """The tables with a row for each run."""
    runs = _runs()
    return {"runs": table(runs), "compartments": compartments(runs)}


def _runs() -> list[KneeRun]:
    return files.read_csv(DATA / SOURCE, KneeRun)


def limits(runs: Sequence[KneeRun]) -> str:
    """Which sizes were not run, and what the others do not show."""
    missing = [f"`{size.value}`" for size in Size if size.value not in {run.size for run in runs}]
    return f"No run has the {'size' if len(missing) == 1 else 'sizes'} {', '.join(missing)}. {_LIMITS}"


def headline(runs: Sequence[KneeRun]) -> str:
    """Who completes."""
    ours, theirs = _sides(runs)
    return (
        f"`sliding-mixture` completes {_done(ours)} of {len(ours)} runs. FEBio's interfaces complete "
        f"{_done(theirs)} of {len(theirs)} with {len({run.factor for run in theirs})} factors of their penalties."
    )


def _sides(runs: Sequence[KneeRun]) -> tuple[list[KneeRun], list[KneeRun]]:
    """Runs with the plugin, and with FEBio's interface."""
    return [run for run in runs if run.contact == _OURS], [run for run in runs if run.contact != _OURS]


def compared(runs: Sequence[KneeRun]) -> str:
    """`sliding-mixture` over two runs of FEBio's interface: the fastest of a scene, and the one that overlaps least.

    Only runs that complete are compared.
    """
    ours, theirs = _sides(runs)
    rows = [row for mine in ours if mine.ended for row in _compared(mine, theirs)]
    return tables.markdown(("knee", "run of FEBio's interface", "iterations", "time", "memory", "overlap"), rows)


def _done(runs: Sequence[KneeRun]) -> int:
    return sum(run.ended for run in runs)


def _compared(mine: KneeRun, theirs: Sequence[KneeRun]) -> list[tuple[str, ...]]:
    """Two rows, or one if no run of FEBio's completes."""
    rivals = [run for run in theirs if run.ended and run.scene == mine.scene]
    if not rivals:
        return [(_scene(mine), "none completes", "-", "-", "-", "-")]
    fastest = min(rivals, key=lambda run: run.iterations)
    tightest = min(rivals, key=lambda run: run.overlap)
    return [
        (_scene(mine), "fewest iterations", *_times(mine, fastest)),
        (_scene(mine), "least overlap", *_times(mine, tightest)),
    ]


def _times(mine: KneeRun, other: KneeRun) -> tuple[str, ...]:
    """Iterations, time, memory and overlap over those of another run."""
    ratios = (mine.iterations / other.iterations, mine.seconds / other.seconds, mine.memory / other.memory)
    return (*(f"{ratio:.2f}" for ratio in ratios), f"{mine.overlap / other.overlap:.1g}")


def _scene(run: KneeRun) -> str:
    return ", ".join(run.scene[1 if run.bodies == Kind.ELASTIC.value else 0 :])


def _name(run: KneeRun) -> tuple[str, str]:
    return _scene(run), f"`{run.contact}`" + (f" × {run.factor:g}" if run.factor else "")


def table(runs: Sequence[KneeRun]) -> str:
    """How the runs went."""
    heads = ("completes", "until [s]", "steps", "iterations", "retries", "time [s]", "memory [MB]")
    rows = []
    for run in runs:
        counts = (run.steps, run.iterations, run.retries, f"{run.seconds:.0f}", f"{run.memory:.0f}")
        outcome = "yes" if run.ended else "no, at the limit of time" if run.limited else "no"
        rows.append((*_name(run), outcome, f"{run.reached:.3g}", *counts))
    return tables.markdown(("knee", "contact", *heads), rows)


def compartments(runs: Sequence[KneeRun]) -> str:
    """Force, area, largest pressure, and the load that the fluid bears."""
    heads = ("knee", "contact", "force [N]", "area [mm²]", "largest pressure [MPa]", "largest overlap [mm]")
    rows = ((*_name(run), *_passing(run), f"{run.overlap:.4f}", _shares(run)) for run in runs)
    return tables.markdown((*heads, "fluid bears"), rows)


def _shares(run: KneeRun) -> str:
    return f"{run.fluid_most:.3f}, {run.fluid_last:.3f}" if math.isfinite(run.fluid_most) else "-"


def _passing(run: KneeRun) -> list[str]:
    """Force, area and largest pressure, medial and lateral."""
    force, area = (run.force_medial, run.force_lateral), (run.area_medial, run.area_lateral)
    numbers = ((force, ".0f"), (area, ".0f"), ((run.peak_medial, run.peak_lateral), ".2f"))
    return [", ".join(f"{value:{form}}" for value in values) for values, form in numbers]


def answers(runs: Mapping[Way, KneeRun]) -> str:
    """Runs in all ways, with their differences from the defaults."""
    heads = ("force [N]", "difference [%]", "largest pressure [MPa]", "difference [%]")
    rows = [(way.value, *_answer(run, runs[Way.DEFAULTS])) for way, run in runs.items()]
    return tables.markdown(("contacts", "iterations", "retries", *heads), rows)


def _answer(run: KneeRun, defaults: KneeRun) -> tuple[str, ...]:
    """Force and largest pressure, medial and lateral, and by how much they differ from those of the defaults."""
    force, pressure = (
        ((run.force_medial, defaults.force_medial), (run.force_lateral, defaults.force_lateral)),
        ((run.peak_medial, defaults.peak_medial), (run.peak_lateral, defaults.peak_lateral)),
    )
    return (str(run.iterations), str(run.retries), *_differing(force, ".1f"), *_differing(pressure, ".2f"))


def _differing(pairs: Sequence[tuple[float, float]], form: str) -> tuple[str, str]:
    """Values, and their differences from others in percent."""
    differences = (100.0 * (value / other - 1.0) for value, other in pairs)
    return ", ".join(f"{value:{form}}" for value, _ in pairs), ", ".join(f"{each:.2f}" for each in differences)


_HERE = Path(__file__).parent
PAGES = (
    EvidencePage("evidence/knee.md", (SOURCE,), _HERE / "knee.md", figures),
    EvidencePage("reference/knee-runs.md", (SOURCE,), _HERE / "knee-runs.md", figures_of_tables),
)
