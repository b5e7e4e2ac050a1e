"""Problem 3.3 on three meshes, with either body as the primary one and with two passes: values and observed orders."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np

from harness.indentation.histories import Curves, curves
from harness.models.indentation import TIMES, Indentation
from harness.models.indentation_mesh import Primary
from harness.models.interface import ContactSettings
from harness.run.runner import Runner, RunResult
from studies.models.indentation_variants import LEVELS

QUANTITIES = {
    "force [N]": "force",
    "half-width [mm]": "half_width",
    "slab's content [nmol]": "slab",
    "cylinder's content [nmol]": "cylinder",
}
"""What converges: its heading, and its name among the curves."""


class Arrangement(str, Enum):
    """Which surfaces are integrated over."""

    CYLINDER = "cylinder"
    SLAB = "slab"
    TWO_PASS = "two-pass"

    def problem(self, level: int) -> Indentation:
        """The problem on a mesh of `LEVELS`: segments, top free to slide, no clamp; the same time steps on each mesh.

        A gripped top has a singular corner, and a clamp creates solute: neither has an answer to converge to.
        """
        return Indentation(
            settings=ContactSettings(integration="segments", two_pass=self is Arrangement.TWO_PASS or None),
            primary=Primary.SLAB if self is Arrangement.SLAB else Primary.CYLINDER,
            grid=LEVELS[level],
            module="multiphasic",
            clamp=False,
            gripped=False,
            name=f"convergence-{self.value}-{level}",
        )


@dataclass(frozen=True)
class Solved:
    """A run and its curves."""

    arrangement: Arrangement
    result: RunResult
    curves: Curves


def run(
    runner: Runner, arrangements: Sequence[Arrangement], levels: int, finished: Callable[[Solved], None]
) -> list[Solved]:
    """Runs `levels` meshes of each arrangement, and calls `finished` after each run."""
    found = []
    for arrangement in arrangements:
        for level in range(levels):
            result = runner(arrangement.problem(level).model(), check=False)
            found.append(Solved(arrangement, result, curves(result)))
            finished(found[-1])
    return found


def order(values: Sequence[float]) -> float:
    """Observed order of three values on meshes of h, h/2 and h/4; nan where they do not approach a limit in one way."""
    if len(values) < 3:
        return math.nan
    first, second = values[-2] - values[-3], values[-1] - values[-2]
    return math.log2(first / second) if first * second > 0.0 else math.nan


def table(runs: Sequence[Solved]) -> str:
    """Values on all meshes at the times of figure 3.4 with their order, as a Markdown table."""
    lines = ["| primary | t [s] | " + " | ".join(f"{name} | order" for name in QUANTITIES) + " |"]
    lines.append("|---|---|" + "---|---|" * len(QUANTITIES))
    for arrangement in dict.fromkeys(entry.arrangement for entry in runs):
        levels = [entry.curves for entry in runs if entry.arrangement is arrangement]
        for time in TIMES:
            cells = "".join(_cells(levels, name, time) for name in QUANTITIES.values())
            lines.append(f"| {arrangement.value} | {time:g} |{cells}")
    return "\n".join(lines)


def _cells(levels: Sequence[Curves], name: str, time: float) -> str:
    reached = [level for level in levels if level.times[-1] >= time * (1.0 - 1e-6)]
    values = [float(getattr(level, name)[np.argmin(np.abs(level.times - time))]) for level in reached]
    observed = order(values)
    shown = "-" if math.isnan(observed) else f"{observed:.1f}"
    return f" {', '.join(f'{value:.4f}' for value in values)} | {shown} |"
