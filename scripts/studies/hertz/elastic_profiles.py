"""Pressure of Hertz's contacts of elastic bodies over the distance from the middle, on two meshes each."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from harness.arrays import Array
from harness.run.runner import Runner, RunResult
from studies.closed_forms import hertz
from studies.models import elastic_hertz, partial_slip
from studies.models.elastic_hertz import ElasticHertz
from studies.models.partial_slip import PartialSlip

WITHIN = 0.8
"""Part of the half-width or radius that closed forms are fitted in: facets at the edge are in contact in part."""


@dataclass(frozen=True)
class ProfileRow:
    """A facet of a run."""

    problem: str
    mesh: str
    # Distance of its middle from that of the contact (mm), and mean pressure (MPa).
    place: float
    pressure: float
    radius: float
    peak: float
    """Half-width or radius of the contact (mm) and peak pressure (MPa) of the closed form, for the force that passes.
    """


def sphere(runner: Runner, elements: int) -> list[ProfileRow]:
    """A sphere on a block, with some elements over the radius of the contact."""
    run = runner(ElasticHertz(elements, name=f"elastic-hertz-{elements}").model())
    centre = _middles(run, "sphere", -1)
    force = 4.0 * _force(run, "block-outside", -1)
    exact = (force, elastic_hertz.RADIUS, elastic_hertz.COMBINED)
    pressure = run.facets("sphere")["contact pressure"][-1]
    place = np.hypot(centre[:, 0], centre[:, 1])
    radius, peak = hertz.sphere_radius(*exact), hertz.sphere_peak_pressure(*exact)
    return _rows("sphere", elements, np.column_stack([place, pressure]), radius, peak)


def cylinder(runner: Runner, elements: int) -> list[ProfileRow]:
    """A cylinder on a block, when it is pressed on and before it is pushed sideways."""
    run = runner(PartialSlip(elements, name=f"partial-slip-{elements}").model())
    step = partial_slip.PRESSING
    exact = (_force(run, "block-outside", step) / partial_slip.THICKNESS, partial_slip.RADIUS, partial_slip.COMBINED)
    pressure = run.facets("cylinder")["contact pressure"][step]
    place = np.abs(_middles(run, "cylinder", step)[:, 0])
    radius, peak = hertz.half_width(*exact), hertz.peak_pressure(*exact)
    return _rows("cylinder", elements, np.column_stack([place, pressure]), radius, peak)


PROBLEMS: Mapping[str, tuple[Callable[[Runner, int], list[ProfileRow]], tuple[int, int]]] = {
    "cylinder": (cylinder, (8, 16)),
    "sphere": (sphere, (4, 6)),
}
"""By name: what runs it, and its meshes, in elements over the half-width or radius."""


def all_rows(runner: Runner) -> list[ProfileRow]:
    """The rows of all problems and meshes."""
    return [row for make, meshes in PROBLEMS.values() for elements in meshes for row in make(runner, elements)]


def errors(rows: Sequence[ProfileRow]) -> tuple[float, float]:
    """Relative errors of half-width or radius, and of the peak pressure, of one run.

    The square of the pressure falls linearly with that of the distance, p^2 = p0^2 (1 - r^2/a^2): a line through the
    facets within `WITHIN` of the closed form's a.
    """
    place, pressure = np.array([(row.place, row.pressure) for row in rows if row.place < WITHIN * row.radius]).T
    fitted = hertz.half_ellipse_through(place, pressure)
    return fitted.half_width / rows[0].radius - 1.0, fitted.peak / rows[0].peak - 1.0


def _force(run: RunResult, nodes: str, step: int) -> float:
    """Normal force (N) on a set of nodes."""
    return abs(float(run.nodes["Rz"][step, run.model.mesh.node_sets[nodes] - 1].sum()))


def _middles(run: RunResult, surface: str, step: int) -> Array:
    """Middles of the facets of a surface, mm."""
    facets = run.model.mesh.surfaces[surface] - 1
    return np.stack([run.nodes[axis][step][facets].mean(axis=1) for axis in "xyz"], axis=-1)


def _rows(problem: str, elements: int, facets: Array, radius: float, peak: float) -> list[ProfileRow]:
    """Rows from places and pressures, shape (facets, 2), in the order of their places."""
    mesh = f"{elements} elements"
    order = np.argsort(facets[:, 0], kind="stable")
    return [ProfileRow(problem, mesh, place, pressure, radius, peak) for place, pressure in facets[order].tolist()]
