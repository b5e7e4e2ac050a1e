"""A contact that grows under a force: half-width, peak pressure and approach over time, beside the closed form."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from harness.arrays import Array
from harness.run.runner import RunResult
from studies.closed_forms import biphasic_layers
from studies.models.biphasic_hertz import BiphasicHertz

FINE = 2000  # intervals in which the closed form is integrated


@dataclass(frozen=True)
class Growth:
    """Over `times` (s): half-width or radius (mm), peak pressure (MPa) and approach (mm)."""

    times: Array
    half_width: Array
    peak: Array
    approach: Array

    def since(self, time: float) -> Growth:
        """What is later than a time (s), or at it."""
        late = self.times >= time * (1.0 - 1e-9)
        return Growth(self.times[late], self.half_width[late], self.peak[late], self.approach[late])


def exact(problem: BiphasicHertz, times: Array) -> Growth:
    """The closed form for thin layers at `times`."""
    contact, points = problem.contact, np.array(problem.load.points)
    fine = np.unique(np.concatenate([np.linspace(0.0, time, FINE) for time in points[1:, 0]]))
    force = np.interp(fine, points[:, 0], points[:, 1])
    width = contact.half_width(biphasic_layers.accumulated_load(fine, force, contact.rate))
    peak = biphasic_layers.pressure(0.0, fine, force, contact)
    at = [np.interp(times, fine, values) for values in (width, peak, contact.approach(width))]
    return Growth(times, *at)


def measured(problem: BiphasicHertz, run: RunResult) -> Growth:
    """What a run of a problem found: contact area, largest pressure of a facet, and the way of the rigid bone."""
    primary, _ = run.model.mesh.pairs["joint"]
    surface, facets, nodes = run.surface(primary), run.facets(primary), run.nodes
    bone = int(run.model.mesh.parts[-1].elements.max()) - 1
    growth = Growth(
        surface.times,
        problem.extent(surface["contact area"][:, 0]),
        facets["contact pressure"].max(axis=1),
        problem.overlap - nodes["uy"][:, bone],
    )
    return growth.since(float(surface.times[surface.times > 0.0][0]))
