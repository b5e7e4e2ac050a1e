"""What is compared of each run: its curve over the angle or the way, beside the published ones."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from harness.arrays import Array
from harness.models.interface import InterfaceType
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from studies.friction import published
from studies.friction.published import Curves
from studies.models import twisting_hemisphere
from studies.models.concentric_spheres import WAY, ConcentricSpheres
from studies.models.twisting_hemisphere import TwistingHemisphere

TORQUE_BAR = 0.03  # distance from what the published torques span, relative to them
HEMISPHERES = {
    "coarse mesh": TwistingHemisphere(),
    "fine mesh": TwistingHemisphere(10, name="twisting-hemisphere-fine"),
}
FEBIO_SERIES = "FEBio's sliding-elastic, coarse mesh"
FEBIO_HEMISPHERE = TwistingHemisphere(interface=InterfaceType.ELASTIC, name="twisting-hemisphere-febio")
MESHES = {"coarse mesh": (6, 2, 45), "fine mesh": (8, 3, 90)}
"""Of the spheres: elements along the edge of a patch and through a shell, and steps."""
SPHERES, SMOOTH_SPHERES = "spheres", "smooth spheres"
COEFFICIENTS = {SPHERES: 0.5, SMOOTH_SPHERES: 0.0}  # friction coefficients of the problems of spheres


@dataclass(frozen=True)
class Row:
    """A place on a curve."""

    problem: str  # "torque" or "force" of the hemisphere, `SPHERES` or `SMOOTH_SPHERES`
    series: str  # a mesh, or who published it
    place: float  # degrees or mm
    value: float  # N mm or N


def hemisphere_rows(series: str, runner: Runner) -> list[Row]:
    """Torque and force of the hemisphere while it turns, on one of the meshes."""
    return _turned_rows(series, runner(HEMISPHERES[series].model()))


def febio_rows(runner: Runner) -> list[Row]:
    """The same with FEBio's interface, as far as its run comes."""
    return _turned_rows(FEBIO_SERIES, runner(FEBIO_HEMISPHERE.model(), check=False))


def _turned_rows(series: str, run: RunResult) -> list[Row]:
    angle, torque, force = turned(run)
    return [*_rows("torque", series, angle, torque), *_rows("force", series, angle, force)]


def sphere_rows(problem: str, series: str, runner: Runner) -> list[Row]:
    """Force on the octant of the spheres, with friction or without it, on one of the meshes."""
    coefficient, (elements, through, steps) = COEFFICIENTS[problem], MESHES[series]
    name = f"concentric-spheres-{coefficient:g}-{series.removesuffix(' mesh')}"
    run = runner(ConcentricSpheres(coefficient, elements, through, steps, name=name).model(), check=False)
    lid = run.model.mesh.node_sets["lid"] - 1
    way = run.nodes.times / steps * WAY
    return _rows(problem, series, way, -run.nodes["Rz"][:, lid].sum(axis=1))


def published_rows() -> list[Row]:
    """All that was published, at its places."""
    found = _published("torque", published.ANGLES, published.TORQUE)
    found += _published("force", published.ANGLES, published.PRESSED)
    found += _published(SPHERES, published.WAYS, published.SPHERES)
    return [*found, *_published(SMOOTH_SPHERES, published.WAYS, published.SMOOTH_SPHERES)]


def turned(run: RunResult) -> tuple[Array, Array, Array]:
    """Since the hemisphere turns: angle in degrees, torque in N mm, force in N, as the base of the block bears them."""
    nodes, base = run.nodes, run.model.mesh.node_sets["base"] - 1
    turns = nodes.times > twisting_hemisphere.PRESSED * (1.0 - 1e-9)
    place = run.model.mesh.nodes[base]
    along, across, up = (nodes[column][turns][:, base] for column in ("Rx", "Ry", "Rz"))
    torque = (place[:, 1] * along - place[:, 0] * across).sum(axis=1)
    return twisting_hemisphere.angle(nodes.times[turns]), torque, up.sum(axis=1)


def values_at(rows: Sequence[Row], problem: str, series: str, places: Sequence[float]) -> Array:
    """A series of a problem at some places, interpolated; nan where it does not reach."""
    own = [(row.place, row.value) for row in rows if (row.problem, row.series) == (problem, series)]
    at, value = np.array(own).T
    return np.asarray(np.interp(np.array(places), at, value, right=np.nan))


def torque_measures(rows: Sequence[Row], series: str) -> list[Measure]:
    """How far the torque is from what the published ones span, at each of their angles."""
    found = values_at(rows, "torque", series, published.ANGLES)
    spans = published.spread(published.TORQUE)
    return [
        Measure(f"Twisting hemisphere, torque at {angle:g} degrees", outside(value, span), TORQUE_BAR)
        for angle, value, span in zip(published.ANGLES, found.tolist(), spans, strict=True)
    ]


def outside(value: float, span: tuple[float, float]) -> float:
    """How far a value is outside of a span, relative to its nearer end."""
    low, high = span
    return max(0.0, 1.0 - value / low, value / high - 1.0)


def _rows(problem: str, series: str, places: Array, values: Array) -> list[Row]:
    return [Row(problem, series, *pair) for pair in zip(places.tolist(), values.tolist(), strict=True)]


def _published(problem: str, places: Sequence[float], curves: Curves) -> list[Row]:
    return [
        Row(problem, series, *pair) for series, values in curves.items() for pair in zip(places, values, strict=True)
    ]
