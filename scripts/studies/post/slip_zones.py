"""Stick and slip zones of a run of `studies.models.partial_slip`, from the tractions at its nodes."""

from dataclasses import dataclass

import numpy as np

from harness.arrays import Array
from harness.post.compare import Measure
from harness.run.runner import RunResult
from studies.closed_forms import cattaneo_mindlin, hertz
from studies.models.partial_slip import COMBINED, FRICTION, RADIUS, THICKNESS


@dataclass(frozen=True)
class Zones:
    """The contact at the end of a run, and what it should be for the forces that pass."""

    x: Array
    # Of the nodes under load: position (mm) and tractions (MPa).
    pressure: Array
    shear: Array
    half_width: float  # a of the closed form for the normal force, mm
    ratio: float  # Q/(mu P)
    bound: float  # mu p0 of the closed form, MPa

    @property
    def stick_half_width(self) -> float:
        """Stick half-width c (mm): where mu p - q, whose square falls linearly with x^2 in stick, comes to zero.

        In the closed form (mu p - q)^2 = (mu p0/a)^2 (c^2 - x^2) there.
        """
        left = FRICTION * self.pressure - np.abs(self.shear)
        sticks = left > 1e-3 * self.bound
        middle = float(np.mean(self.x[sticks]))
        return hertz.half_ellipse_through(self.x[sticks] - middle, left[sticks]).half_width

    @property
    def peak_shear(self) -> float:
        """Shear (MPa) at the edges of the stick zone, mu p there: a node next to the peak, a kink, misses it."""
        left, right = (np.interp(side * self.stick_half_width, self.x, self.pressure) for side in (-1.0, 1.0))
        return float(FRICTION * 0.5 * (left + right))

    def pressed(self, tolerance: float) -> list[Measure]:
        """Half-width and peak of the pressure against Hertz's, relative: its square falls linearly with x^2 to zero."""
        half_width, peak = hertz.half_ellipse_through(self.x - np.mean(self.x), self.pressure)
        width, height = half_width / self.half_width, peak * FRICTION / self.bound
        return [
            Measure("Hertz's line contact, half-width, relative error", abs(width - 1.0), tolerance),
            Measure("Hertz's line contact, peak pressure, relative error", abs(height - 1.0), tolerance),
        ]

    def measures(self, tolerance: float) -> list[Measure]:
        """Stick half-width and peak shear against the closed form, relative."""
        width = self.stick_half_width / cattaneo_mindlin.stick_half_width(self.half_width, self.ratio)
        exact = cattaneo_mindlin.peak_shear(self.ratio, self.bound)
        peak, nodal = self.peak_shear / exact, np.abs(self.shear).max() / exact
        note = f"Q/(mu P) = {self.ratio:.3f}; the largest value at a node is {1.0 - nodal:.1%} below the peak"
        return [
            Measure("Partial slip, stick half-width, relative error", abs(width - 1.0), tolerance, note=note),
            Measure("Partial slip, peak shear, relative error", float(abs(peak - 1.0)), tolerance, note=note),
        ]


def zones(run: RunResult) -> Zones:
    """The contact at the end of a run."""
    facets, nodes, mesh = run.facets("cylinder"), run.nodes, run.model.mesh
    outside = mesh.node_sets["block-outside"] - 1
    normal, along = (abs(float(nodes[name][-1, outside].sum())) / THICKNESS for name in ("Rz", "Rx"))
    x = nodes["x"][-1][mesh.surfaces["cylinder"] - 1]
    order = np.argsort(x.mean(axis=1))
    position = np.concatenate([x[order].min(axis=1), x[order[-1:]].max(axis=1)])
    pressure, shear = (_at_nodes(facets[name][-1, order]) for name in ("contact pressure", "contact friction.x"))
    loaded = pressure > 1e-6 * pressure.max()
    return Zones(
        position[loaded],
        pressure[loaded],
        shear[loaded],
        hertz.half_width(normal, RADIUS, COMBINED),
        along / (FRICTION * normal),
        FRICTION * hertz.peak_pressure(normal, RADIUS, COMBINED),
    )


def _at_nodes(means: Array) -> Array:
    """Values at the ends of facets in a row whose means over two ends each are given; none at the first end."""
    values = np.zeros(len(means) + 1)
    for k, mean in enumerate(means):
        values[k + 1] = 2.0 * mean - values[k]
    return values
