"""What problem 3.3 is judged by, over time: force, width of contact, contents, outflow, extremes."""

from dataclasses import dataclass

import numpy as np

from harness.arrays import Array, Mask
from harness.models.document import Model
from harness.post import contact_line, solute_balance
from harness.post.solute_balance import State
from harness.run.runner import RunResult


@dataclass(frozen=True)
class Curves:
    """Numbers over time, each of shape (n_times,); those of the first time describe the initial state."""

    times: Array  # s
    force: Array  # force by which the round body's flat top is pressed down, N (of the modelled half or quarter)
    # Of the contact in the plane z = 0, along x, mm: midway between the slab's last node in contact and the first one
    # at ambient values.
    half_width: Array
    # Solute in each body, nmol.
    slab: Array
    cylinder: Array
    # Solute that has left the bodies, nmol: what has left at the nodes of both contact surfaces, because what contact
    # takes from one surface it gives to the other.
    outflow: Array
    # Extremes of c~ over all nodes, mM.
    lowest: Array
    highest: Array

    @property
    def imbalance(self) -> Array:
        """Content of both bodies and outflow, less the initial content, relative to the latter."""
        total = self.slab + self.cylinder
        return np.asarray((total + self.outflow - total[0]) / total[0])


def curves(result: RunResult) -> Curves:
    """All numbers of a run, finished or not, from its node data."""
    model, history = result.model, result.nodes
    states = solute_balance.states(history)
    concentration = history["c1"]
    slab, cylinder = (
        np.array([solute_balance.content(model, part, state) for state in states]) for part in model.mesh.parts
    )
    return Curves(
        history.times,
        history["Ry"][:, model.mesh.node_sets["top"] - 1].sum(axis=1),
        np.array([_half_width(model, state) for state in states]),
        slab,
        cylinder,
        _outflow(model, states, history.times),
        concentration.min(axis=1),
        concentration.max(axis=1),
    )


def _half_width(model: Model, state: State) -> float:
    slab = contact_line.line_nodes(model.mesh, "slab-contact") - 1
    return contact_line.half_width(state.positions[slab, 0], np.where(is_open(state)[slab], 1.0, -1.0))


def _outflow(model: Model, states: list[State], times: Array) -> Array:
    """What has left at the nodes of both contact surfaces since the start, nmol."""
    surface = {body: np.unique(model.mesh.surfaces[f"{body}-contact"]) - 1 for body in ("slab", "cylinder")}
    left = [0.0]
    for before, after, step in zip(states, states[1:], np.diff(times), strict=False):
        entered = {p.name: solute_balance.inflow(model, p, before, after, float(step)) for p in model.mesh.parts}
        left.append(-sum(float(entered[body][ids].sum()) for body, ids in surface.items()))
    return np.cumsum(left)


def is_open(state: State) -> Mask:
    """Nodes at the ambient p~ = 0 and c~ = 0, to the last digit."""
    return np.asarray((state.pressure == 0.0) & (state.concentration == 0.0))
