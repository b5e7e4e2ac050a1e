"""What problem 3.3 is judged by, over time: force, width of contact, contents, flows, jumps, extremes."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from harness.models.document import Model
from harness.models.mesh import Ids
from harness.models.parts import GAS_CONSTANT, TEMPERATURE
from harness.post import contact_line, solute_balance
from harness.post.solute_balance import State
from harness.run.runner import RunResult

Array = NDArray[np.float64]
NEAR = 1e-6
"""Gap (mm) up to which the surfaces count as being in contact."""


@dataclass(frozen=True)
class Curves:
    """Numbers over time, each of shape (n_times,); those of the first time describe the initial state.

    Attributes
    ----------
    times : ndarray
        s.
    force : ndarray
        Force by which the round body's flat top is pressed down, N (of the modelled half or quarter).
    half_width : ndarray
        Of the contact in the plane z = 0, along x, mm: midway between the slab's last node in contact and the first
        one at ambient values.
    slab, cylinder : ndarray
        Solute in each body, nmol.
    outflow : ndarray
        Solute that has left the bodies, nmol: what has left at the nodes of both contact surfaces, because what
        contact takes from one surface it gives to the other.
    exchanged : ndarray
        Solute that has entered the round body at nodes in contact, nmol.
    edge : ndarray
        Part of the outflow that contact has handed to nodes at ambient values, at facets that straddle the edge of the
        contact, nmol. A contact that does not conserve solute would show here, too.
    residue : ndarray
        Solute that has appeared at all other nodes, which should balance, nmol.
    pressure : ndarray
        Largest actual fluid pressure p = p~ + R T Phi kappa c~, MPa.
    lowest, highest : ndarray
        Extremes of c~ over all nodes, mM.
    jump_c, jump_p : ndarray
        Largest |c1 - c2| (mM) and |p~1 - p~2| (MPa) over the contact, at the slab's nodes in the plane z = 0.
    overlap : ndarray
        Deepest overlap, mm.
    """

    times: Array
    force: Array
    half_width: Array
    slab: Array
    cylinder: Array
    outflow: Array
    exchanged: Array
    edge: Array
    residue: Array
    pressure: Array
    lowest: Array
    highest: Array
    jump_c: Array
    jump_p: Array
    overlap: Array

    @property
    def imbalance(self) -> Array:
        """Content of both bodies and outflow, less the initial content, relative to the latter."""
        total = self.slab + self.cylinder
        return np.asarray((total + self.outflow - total[0]) / total[0])


def curves(result: RunResult) -> Curves:
    """All numbers of a run, finished or not, from its node data."""
    model, history = result.model, result.nodes
    states = solute_balance.states(history)
    rows = [_instant(model, state) for state in states]
    flows = _flows(model, states, history.times)
    top = model.mesh.node_sets["top"] - 1
    columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    made = columns | flows | {"times": history.times, "force": history["Ry"][:, top].sum(axis=1)}
    return Curves(**{field.name: made[field.name] for field in fields(Curves)})


def _instant(model: Model, state: State) -> dict[str, float]:
    """Numbers of one time."""
    material = model.mixture("slab")
    osmotic = GAS_CONSTANT * TEMPERATURE * material.osmotic * material.solutes[0].solubility
    parts = {part.name: solute_balance.content(model, part, state) for part in model.mesh.parts}
    return {
        **parts,
        "pressure": float(np.max(state.pressure + osmotic * state.concentration)),
        "lowest": float(state.concentration.min()),
        "highest": float(state.concentration.max()),
        **_contact(model, state),
    }


def _contact(model: Model, state: State) -> dict[str, float]:
    """Numbers of the contact in the plane z = 0."""
    slab, arc = (contact_line.line_nodes(model.mesh, f"{body}-contact") - 1 for body in ("slab", "cylinder"))
    points = state.positions[slab, :2]
    found = contact_line.project(points, state.positions[arc, :2])
    touching = found.gap <= NEAR
    jumps = [
        np.abs(field[slab] - found.sample(field[arc]))[touching] for field in (state.concentration, state.pressure)
    ]
    return {
        "half_width": contact_line.half_width(points[:, 0], np.where(is_open(state)[slab], 1.0, -1.0)),
        "overlap": float(max(0.0, -found.gap.min())),
        "jump_c": float(jumps[0].max(initial=0.0)),
        "jump_p": float(jumps[1].max(initial=0.0)),
    }


def _flows(model: Model, states: list[State], times: Array) -> dict[str, Array]:
    """What has passed where since the start, nmol."""
    names = ("outflow", "exchanged", "edge", "residue")
    rows = [dict.fromkeys(names, 0.0)]
    surface = {body: np.unique(model.mesh.surfaces[f"{body}-contact"]) - 1 for body in ("slab", "cylinder")}
    for before, after, step in zip(states, states[1:], np.diff(times), strict=False):
        entered = {p.name: solute_balance.inflow(model, p, before, after, float(step)) for p in model.mesh.parts}
        rows.append(_split(entered, surface, is_open(after)))
    return {name: np.cumsum([row[name] for row in rows]) for name in names}


def is_open(state: State) -> NDArray[np.bool_]:
    """Nodes at the ambient p~ = 0 and c~ = 0, to the last digit."""
    return np.asarray((state.pressure == 0.0) & (state.concentration == 0.0))


def _split(entered: dict[str, Array], surface: dict[str, Ids], open_: NDArray[np.bool_]) -> dict[str, float]:
    """Inflows of a step by the kind of node at which they enter."""
    through_ambient = sum(float(entered[body][ids[open_[ids]]].sum()) for body, ids in surface.items())
    contact = {body: float(entered[body][ids[~open_[ids]]].sum()) for body, ids in surface.items()}
    everything = sum(float(values.sum()) for values in entered.values())
    straddling = sum(contact.values())
    return {
        "outflow": -through_ambient - straddling,
        "exchanged": contact["cylinder"],
        "edge": -straddling,
        "residue": everything - through_ambient - straddling,
    }
