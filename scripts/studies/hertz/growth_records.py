"""What is compared of each run: a row per time step, with the closed form beside it."""

from dataclasses import dataclass

import numpy as np

from harness.run.runner import Runner
from studies.models.biphasic_hertz import BiphasicHertz, BiphasicLine, BiphasicSphere
from studies.post import contact_growth

LINES: tuple[BiphasicHertz, ...] = (
    BiphasicLine(),
    BiphasicLine(across=144, through=6, name="biphasic-hertz-fine"),
    BiphasicLine(draining=True, name="biphasic-hertz-draining"),
)
"""Coarse mesh, fine mesh, and the coarse one with surfaces that drain where they are not in contact."""
SPHERES: tuple[BiphasicHertz, ...] = (
    BiphasicSphere(across=36, through=2, around=6),
    BiphasicSphere(across=72, through=3, around=12, name="biphasic-hertz-sphere-fine"),
)
"""Coarse and fine mesh."""
PROBLEMS = LINES + SPHERES


@dataclass(frozen=True)
class Record:
    """A time step of a run, and the closed form.

    Time (s), half-width or radius (mm), peak pressure (MPa) and approach (mm).
    """

    model: str
    time: float
    half_width: float
    peak: float
    approach: float
    half_width_exact: float
    peak_exact: float
    approach_exact: float


def records(problem: BiphasicHertz, runner: Runner) -> list[Record]:
    """The rows of a run."""
    found = contact_growth.measured(problem, runner(problem.model()))
    exact = contact_growth.exact(problem, found.times)
    columns = (found.half_width, found.peak, found.approach, exact.half_width, exact.peak, exact.approach)
    return [
        Record(problem.name, float(time), *map(float, row)) for time, *row in zip(found.times, *columns, strict=True)
    ]


def largest_errors(rows: list[Record], start: float) -> dict[str, float]:
    """Largest relative errors of a run from the time `start` (s) on."""
    late = [row for row in rows if row.time >= start * (1.0 - 1e-6)]

    def largest(name: str) -> float:
        ratios = [getattr(row, name) / getattr(row, f"{name}_exact") for row in late]
        return float(np.max(np.abs(np.array(ratios) - 1.0)))

    return {name: largest(name) for name in ("half_width", "peak", "approach")}
