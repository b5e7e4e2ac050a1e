"""Concentrations below the ambient one and above the initial one in problem 3.3: where they come from."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from harness.models.document import Model
from harness.models.indentation import CONTROL, GEL, Indentation
from harness.run.runner import Runner
from studies import tables
from studies.models.indentation_variants import LEVELS
from studies.models.soaked import soaked

Array = NDArray[np.float64]
END = 100.0
"""s; later all concentrations lie between the ambient ones."""
TIMES = (0.01, 0.1, 1.0, 10.0, END)
"""Times of the table, s; the last step up to each is shown."""
OVERSHOOT = 2.0 - np.sqrt(3.0)
"""What linear elements add to a sudden front of height 1 when d dt << h^2.

On a line the consistent mass matrix alone remains then: c[j-1] + 4 c[j] + c[j+1] = 0 for the error, whose solution that
decays is (sqrt(3) - 2)^j.
"""


@dataclass(frozen=True)
class Extremes:
    """Smallest and largest concentration over all nodes (mM), of shape (n_times,), after the first step."""

    name: str
    times: Array
    lowest: Array
    highest: Array


def cases() -> dict[str, Model]:
    """The runs: contact on three meshes, contact without hindrance (d0 = d), and the bodies without contact."""
    short = Indentation(module="multiphasic", clamp=False, gripped=False, control=replace(CONTROL, end=END))
    free = replace(GEL, solutes=tuple(replace(s, free_diffusivity=s.diffusivity) for s in GEL.solutes))
    coarse, medium, fine = (replace(short, grid=grid, name=f"extremes-{n}") for n, grid in enumerate(LEVELS))
    return {
        "contact, coarse mesh": coarse.model(),
        "contact": medium.model(),
        "contact, fine mesh": fine.model(),
        "contact, d0 = d": replace(medium, gel=free, name="extremes-free").model(),
        "no contact": soaked(medium),
    }


def run(runner: Runner, names: list[str] | None = None) -> list[Extremes]:
    """Runs the cases, or those named, one after the other."""
    found = []
    for name, model in cases().items():
        if names and name not in names:
            continue
        history = runner(model).nodes
        values = history["c1"][1:]
        found.append(Extremes(name, history.times[1:], values.min(axis=1), values.max(axis=1)))
    return found


def table(runs: list[Extremes]) -> str:
    """Smallest and largest concentration at `TIMES`, as a Markdown table."""
    rows = []
    for entry in runs:
        at = [int(np.searchsorted(entry.times, time * (1.0 + 1e-9))) - 1 for time in TIMES]
        rows.append((entry.name, *(f"{entry.lowest[i]:.3f} / {entry.highest[i]:.3f}" for i in at)))
    return tables.markdown(("c [mM], smallest / largest", *(f"{time:g} s" for time in TIMES)), rows)


def draw(runs: list[Extremes], path: Path) -> Path:
    """Both extremes over time, with the overshoot of linear elements at a sudden front."""
    figure = Figure(figsize=(7.2, 4.2), layout="constrained")
    axes = figure.subplots()
    for number, entry in enumerate(runs):
        for values, label in ((entry.highest, entry.name), (entry.lowest, None)):
            axes.semilogx(entry.times, values, color=f"C{number}", label=label, linewidth=1.4)
    for level in (-OVERSHOOT, 1.0 + OVERSHOOT):
        axes.axhline(level, color="0.6", linestyle="--", linewidth=1.0)
    axes.text(END, 1.0 + OVERSHOOT, r"$1+(2-\sqrt{3})$", ha="right", va="bottom", fontsize=8, color="0.4")
    axes.set_xlabel("time [s]")
    axes.set_ylabel(r"smallest and largest $\tilde c$ [mM]")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(fontsize=8, frameon=False, loc="center left")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=160)
    return path
