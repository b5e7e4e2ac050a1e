"""What is compared of each run: a row per time step, with the closed form beside it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from harness.models.biphasic_hertz import BiphasicHertz
from harness.post import line_growth
from harness.run.runner import Runner

_COARSE = BiphasicHertz()
PROBLEMS = (
    _COARSE,
    replace(_COARSE, across=2 * _COARSE.across, through=2 * _COARSE.through, name="biphasic-hertz-fine"),
    replace(_COARSE, draining=True, name="biphasic-hertz-draining"),
)
"""Coarse mesh, fine mesh, and the coarse one with surfaces that drain where they are not in contact."""


@dataclass(frozen=True)
class Record:
    """A time step of a run: time (s), half-width (mm), peak pressure (MPa), approach (mm), and the closed form's."""

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
    found = line_growth.measured(runner(problem.model()))
    exact = line_growth.exact(problem, found.times)
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
