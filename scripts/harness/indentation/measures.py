"""What can be said of problem 3.3 without a closed form, as numbers with tolerances."""

import numpy as np

from harness.arrays import Ids
from harness.indentation.histories import Curves, is_open
from harness.models.document import Model
from harness.models.indentation import CONCENTRATION, TIMES
from harness.models.indentation_mesh import Grid
from harness.post import contact_line, solute_balance
from harness.post.compare import Measure
from harness.post.solute_balance import State
from harness.run.runner import RunResult

BALANCE = 1e-6  # solute out of nowhere, relative to the initial content; Newton's tolerance on increments is 1e-3
RESOLVED = 100.0  # s from which on fronts, of width sqrt(d t), are wider than an element of the slab
DISCRETE = 0.01  # what the mesh leaves open: the contents on the two finer meshes of the study differ by as much


def of_a_run(result: RunResult, curves: Curves) -> list[Measure]:
    """Balance and direction of the flow of solute, bounds, ambient values, and the contact conditions on average."""
    late = curves.times >= RESOLVED
    total = curves.slab + curves.cylinder
    outside = max(0.0, -float(curves.lowest[late].min()), float(curves.highest[late].max()) - CONCENTRATION)
    history, lines = result.nodes, contact_lines(result.model)
    states = solute_balance.states(history)[1:]
    strays = sum(not_at_ambient(state, lines) for state in states)
    gaps, jumps = np.abs([mean_gap_and_jump(state, lines) for state in states])[late[1:]].max(axis=0)
    sagitta = _sagitta(result.model)
    return [
        Measure("3.3 solute: contents and outflow less the start", float(np.abs(curves.imbalance).max()), BALANCE),
        Measure("3.3 solute that comes in from outside", float(np.diff(total).max() / total[0]), BALANCE),
        Measure(
            "3.3 c outside of ambient and start", outside / CONCENTRATION, DISCRETE, note=f"from {RESOLVED:g} s on"
        ),
        Measure("3.3 nodes off the other body that are not at the ambient values", strays, 0.0),
        Measure(
            "3.3 mean gap in contact [mm]", float(gaps), sagitta, note="tolerance: sagitta of the cylinder's facets"
        ),
        Measure("3.3 mean jump of c in contact", float(jumps / CONCENTRATION), DISCRETE),
    ]


def of_both_primaries(cylinder: Curves, slab: Curves) -> list[Measure]:
    """Two runs that differ in which body has the primary surface: force and contents at the times of the pictures."""
    measures = []
    for name, one, two, size in (
        ("force", cylinder.force, slab.force, float(np.abs(cylinder.force).max())),
        ("slab's content", cylinder.slab, slab.slab, cylinder.slab[0]),
        ("cylinder's content", cylinder.cylinder, slab.cylinder, cylinder.slab[0]),
    ):
        gap = max(abs(np.interp(time, cylinder.times, one) - np.interp(time, slab.times, two)) for time in TIMES)
        measures.append(Measure(f"3.3 either body primary: {name}", float(gap / size), DISCRETE, note="relative"))
    return measures


def contact_lines(model: Model) -> tuple[Ids, Ids]:
    """Indices of the nodes of slab and cylinder along their contact surfaces, in the plane z = 0."""
    slab, cylinder = (contact_line.line_nodes(model.mesh, f"{body}-contact") - 1 for body in ("slab", "cylinder"))
    return slab, cylinder


def mean_gap_and_jump(state: State, lines: tuple[Ids, Ids]) -> tuple[float, float]:
    """Means over the slab's closed surface: gap (mm) and jump of c (mM); 0 where nothing is closed.

    The laws hold as averages around nodes; point by point, two polygons cannot lie on each other.
    """
    slab, cylinder = lines
    points = state.positions[slab, :2]
    found = contact_line.project(points, state.positions[cylinder, :2])
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    weights = ~is_open(state)[slab] * np.convolve(lengths, [0.5, 0.5])
    jump = state.concentration[slab] - found.sample(state.concentration[cylinder])
    means = weights @ np.stack([found.gap, jump], axis=1) / (weights.sum() or 1.0)
    return float(means[0]), float(means[1])


def _sagitta(model: Model) -> float:
    """Height (mm) of the cylinder's arc over its longest facet: L^2/(8 R) for L << R."""
    _, cylinder = contact_lines(model)
    lengths = np.linalg.norm(np.diff(model.mesh.nodes[cylinder], axis=0), axis=1)
    return float(lengths.max() ** 2 / (8.0 * Grid().radius))


def not_at_ambient(state: State, lines: tuple[Ids, Ids]) -> int:
    """How many nodes farther than a facet's length from the other body are not at the ambient values."""
    found = 0
    for mine, other in (lines, lines[::-1]):
        shapes = [state.positions[nodes, :2] for nodes in (mine, other)]
        facet = max(float(np.linalg.norm(np.diff(shape, axis=0), axis=1).max()) for shape in shapes)
        far = contact_line.project(*shapes).gap > facet
        found += int(np.sum(far & ~is_open(state)[mine]))
    return found
