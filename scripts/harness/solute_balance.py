"""How much solute each body holds, and how much leaves it at each node: FEBio's own discrete balance, from node data.

FEBio integrates the balance of solute mass by backward Euler over the deforming elements (residual of
FEBiphasicSoluteSolidDomain and FEMultiphasicSolidDomain): with the shape functions N,

    r_i = INT N_i [J phi_w c - (J phi_w c)_previous] dV0 / dt - INT grad N_i . j dv

is zero at each free node that nothing else acts on. Elsewhere it is what flows into the body there. The N_i add up to 1
and their gradients to 0, so the sum of r_i over a body is exactly the rate of its content: what is lost is
what was left over in the nodes that should balance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.hexahedra import Geometry, geometry
from harness.logdata import History
from harness.models.document import Model
from harness.models.mesh import Part
from harness.models.parts import GAS_CONSTANT, TEMPERATURE, Mixture

Array = NDArray[np.float64]


@dataclass(frozen=True)
class State:
    """Node data at one time: positions (n_nodes, 3) in mm, p~ in MPa, c~ in mM (= nmol/mm^3)."""

    positions: Array
    pressure: Array
    concentration: Array


def state_at(history: History, index: int) -> State:
    """The state of one time, counted from 0, of the node data of a run with one solute."""
    positions = np.stack([history[axis][index] for axis in "xyz"], axis=1)
    return State(positions, history["p"][index], history["c1"][index])


def referential(material: Mixture, reference: Geometry, current: Geometry, concentration: Array) -> Array:
    """J phi_w c at the integration points, nmol per mm^3 of the reference configuration.

    Parameters
    ----------
    material : Mixture
        With one solute. phi_w = 1 - phi_0/J, not less than 0, and c = kappa~ c~.
    reference, current : Geometry
    concentration : ndarray, shape (n_elements, n_nodes)
        Effective concentration c~ of the elements' nodes, mM.
    """
    stretch = current.volumes / reference.volumes
    pores = np.maximum(stretch - (1.0 - material.porosity), 0.0)
    return np.asarray(pores * material.solutes[0].solubility * current.at_points(concentration))


def content(model: Model, part: Part, state: State) -> float:
    """Amount of solute in a part, nmol."""
    nodes = part.elements - 1
    reference = geometry(model.mesh.nodes, nodes)
    current = geometry(state.positions, nodes)
    amount = referential(model.mixture(part.material), reference, current, state.concentration[nodes])
    return float(np.sum(amount * reference.volumes))


def inflow(model: Model, part: Part, before: State, after: State, step: float) -> Array:
    """Solute that enters a part at each node during a step, nmol; zero at a node that balances.

    Parameters
    ----------
    model : Model
    part : Part
    before, after : State
        At the start and the end of the step.
    step : float
        s.

    Returns
    -------
    ndarray, shape (n_nodes,)
        Over all nodes of the mesh.
    """
    nodes, material = part.elements - 1, model.mixture(part.material)
    reference, old, new = (geometry(x, nodes) for x in (model.mesh.nodes, before.positions, after.positions))
    stored = referential(material, reference, new, after.concentration[nodes])
    stored -= referential(material, reference, old, before.concentration[nodes])
    moved = step * _flux(material, reference, new, after, part) * new.volumes[..., None]
    entries = np.einsum("qa,eq->ea", new.rule.values, stored * reference.volumes)
    entries -= np.einsum("eqai,eqi->ea", new.gradients, moved)
    total = np.zeros(len(model.mesh.nodes))
    np.add.at(total, nodes, entries)
    return total


def _flux(material: Mixture, reference: Geometry, current: Geometry, state: State, part: Part) -> Array:
    """Solute flux j at the integration points, nmol/(mm^2 s).

    Equations of Mauck, Hung and Ateshian, J Biomech Eng 125:602-614 (2003), as FEBio's materials evaluate them, for
    constant isotropic permeability k and diffusivities d, d0:
    w = -[1/k + (1 - d/d0) R T kappa c~ / (phi_w d0)]^-1 (grad p~ + R T kappa d/d0 grad c~),
    j = kappa d (w c~/d0 - phi_w grad c~).
    """
    nodes, solute = part.elements - 1, material.solutes[0]
    thermal = GAS_CONSTANT * TEMPERATURE * solute.solubility
    ratio = solute.diffusivity / solute.free_diffusivity
    porosity = 1.0 - (1.0 - material.porosity) * reference.volumes / current.volumes
    c, slope = (f(state.concentration[nodes]) for f in (current.at_points, current.gradient))
    drag = 1.0 / material.permeability + (1.0 - ratio) * thermal * c / (porosity * solute.free_diffusivity)
    solvent = -(current.gradient(state.pressure[nodes]) + thermal * ratio * slope) / drag[..., None]
    convected = solvent * c[..., None] / solute.free_diffusivity
    return np.asarray(solute.solubility * solute.diffusivity * (convected - porosity[..., None] * slope))
