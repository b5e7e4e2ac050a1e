"""A slab on a fixed base and a body of any shape that is pushed into it, along it, or turned on it."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from harness.arrays import Array, Ids
from harness.models import blocks
from harness.models.blocks import Body
from harness.models.document import Model
from harness.models.indentation_mesh import Grid, cylinder_body
from harness.models.mesh import Mesh, Part
from harness.models.parts import Param, fix
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from studies.hard_cases.press import ambient_at
from studies.hard_cases.scene import GEL, NEWTON, Fineness, Interface, finished, timed
from studies.models.assembly import NEAR, box, plane
from studies.models.pieces import Motion, driven


@dataclass(frozen=True)
class Shape:
    """A body with what it touches with and what it is held by."""

    body: Body
    contact: Ids  # node numbers from 0. Shape (n_facets, 4)
    grip: Ids  # node numbers from 0


def faces(body: Body, axes: str, ends: float) -> Ids:
    """Outer facets of a box whose position along one of `axes` is `ends` (mm)."""
    return np.concatenate([blocks.facets_where(body, plane(axis, ends).inside) for axis in axes])


def turned(shape: Shape, rotation: Array, shift: Array) -> Shape:
    """A shape turned about the origin, then shifted (mm)."""
    return replace(shape, body=replace(shape.body, nodes=shape.body.nodes @ rotation.T + shift))


def cube(size: float, elements: tuple[int, int, int], axes: str) -> Shape:
    """A cube from the origin; it touches with its lower faces across `axes` and is held by the opposite ones."""
    body = box((0.0, 0.0, 0.0), (size, size, size), elements)
    return Shape(body, faces(body, axes, 0.0), np.unique(faces(body, axes, size)))


def along(path: tuple[tuple[float, tuple[float, float, float]], ...]) -> Motion:
    """A shift that follows (time, displacement) points by straight lines."""
    times, shifts = np.array([t for t, _ in path]), np.array([shift for _, shift in path])

    def motion(positions: Array, time: float) -> Array:
        shift = [np.interp(time, times, shifts[:, k]) for k in range(3)]
        return np.broadcast_to(shift, positions.shape)

    return motion


def spinning(depth: float, pressed: float, end: float, degrees: float) -> Motion:
    """Pushed down by `depth` (mm) until `pressed` (s), then turned about the z axis until `end` (s)."""

    def motion(positions: Array, time: float) -> Array:
        angle = np.radians(degrees) * np.clip((time - pressed) / (end - pressed), 0.0, 1.0)
        c, s = np.cos(angle), np.sin(angle)
        rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        return np.asarray(positions @ rotation.T - positions - np.array([0.0, 0.0, depth * min(1.0, time / pressed)]))

    return motion


def slab(low: tuple[float, float, float], high: tuple[float, float, float], elements: tuple[int, int, int]) -> Shape:
    """A box that touches with its top and is held by its bottom."""
    body = box(low, high, elements)
    return Shape(body, faces(body, "z", high[2]), np.unique(faces(body, "z", low[2])))


@dataclass(frozen=True)
class Pushed:
    """A body held by its grip and one that moves with its own; 1 mM at the first grip, 0 at the other."""

    base: Callable[[int], Shape]
    shape: Callable[[int], Shape]
    """The lower and the upper body for a factor (1 or 2) on the number of elements along each edge."""
    motion: Motion
    times: tuple[float, ...]  # ends of the time steps, s
    bounds: Callable[[RunResult], list[Measure]]  # the physical checks: from a run, measures
    plane: bool = True  # whether nothing moves along y
    name: str = "pushed"
    half: bool = False  # whether x = 0 is a plane of symmetry at which the model ends
    base_is_primary: bool = False  # whether the base has the primary surface
    extra: tuple[Param, ...] = ()  # further parameters of every interface

    def model(self, mesh: Fineness, interface: Interface) -> Model:
        axes = "xz" if self.plane else "xyz"
        made, grip, curves = driven(self._mesh(1 if mesh is Fineness.COARSE else 2), self.times, self.motion, axes)
        control, steps = timed(self.times, len(curves) + 1, 1e-3 * NEWTON)
        conditions = (
            *((fix("all", "y"),) if self.plane else ()),
            *((fix("symmetry", "x"),) if self.half else ()),
            fix("base", "xyz"),
            *grip,
            *ambient_at("base", (1.0,)),
            *ambient_at("grip", (0.0,)),
        )
        about = (self.name, f"Hard case {self.name}: a body pushed into another one.", "multiphasic")
        joined = interface.contacts(made, self.extra)
        model = Model(*about, made, {"gel": GEL}, conditions, control, joined, (*curves, steps))
        return finished(model, interface)

    def _mesh(self, factor: int) -> Mesh:
        below, above = self.base(factor), self.shape(factor)
        offset = len(below.body.nodes)
        nodes = np.concatenate([below.body.nodes, above.body.nodes])
        number = np.arange(1, len(nodes) + 1, dtype=np.int64)
        sets = {"all": number, "base": below.grip + 1, "grip": above.grip + offset + 1}
        if self.half:
            sets["symmetry"] = number[np.abs(nodes[:, 0]) < NEAR]
        surfaces = {"base-contact": below.contact + 1, "shape-contact": above.contact + offset + 1}
        parts = (Part("base", "gel", below.body.elements + 1), Part("shape", "gel", above.body.elements + offset + 1))
        pair = ("base-contact", "shape-contact") if self.base_is_primary else ("shape-contact", "base-contact")
        return Mesh(nodes, parts, sets, surfaces, {"pair": pair})

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """The bounds of this scene."""
        return self.bounds(run)


def arc(around: int, radius: float, height: float, thickness: float) -> Shape:
    """A quarter disk in the plane y = 0, its round side down, touching z = `height` at x = 0."""
    grid = Grid(radius=radius, height=height, thickness=thickness, around=around)
    body = cylinder_body(grid)
    centre = height + radius
    on_arc = blocks.facets_where(body, lambda x: np.abs(np.hypot(x[..., 0], x[..., 1] - centre) - radius) < NEAR)
    grip = np.flatnonzero(np.abs(body.nodes[:, 1] - centre) < NEAR)
    upright = np.stack([body.nodes[:, 0], thickness - body.nodes[:, 2], body.nodes[:, 1]], axis=1)
    return Shape(replace(body, nodes=upright), on_arc, grip)


def grip_force(run: RunResult) -> Array:
    """Force (N) on the grip over time, shape (n_times, 3)."""
    grip = run.model.mesh.node_sets["grip"] - 1
    return np.stack([run.nodes[f"R{axis}"][:, grip].sum(axis=1) for axis in "xyz"], axis=1)


def steady_slide(run: RunResult, start: float, sideways: float, change: float) -> list[Measure]:
    """From `start` (s) on: force along the surface, and change of the normal force, both relative to the latter."""
    force = grip_force(run)[run.nodes.times >= start * (1.0 - 1e-9)]
    normal = np.abs(force[:, 2])
    return [
        Measure("force along the surface, relative", float(np.abs(force[:, :2]).max() / normal.max()), sideways),
        Measure("change of the normal force, relative", float(np.abs(normal / normal[0] - 1.0).max()), change),
    ]


def mirrored(axis: int, tolerance: float) -> Callable[[RunResult], list[Measure]]:
    """A scene with a plane of symmetry: no force across it, and a force that grows on the way down."""

    def bounds(run: RunResult) -> list[Measure]:
        force = grip_force(run)
        normal = np.abs(force[:, 2])
        grows = float(np.min(np.diff(normal[: int(np.argmax(normal)) + 1])) / normal.max())
        across = float(np.abs(force[:, axis]).max() / normal.max())
        return [
            Measure("force across the plane of symmetry, relative", across, tolerance),
            Measure("normal force on the way down, smallest growth", -grows, 1e-6),
        ]

    return bounds
