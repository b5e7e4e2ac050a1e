"""How much solute each body holds, and how much leaves it at each node: FEBio's own discrete balance, from node data.

FEBio integrates the balance of solute mass by backward Euler over the deforming elements (residual of
FEBiphasicSoluteSolidDomain and FEMultiphasicSolidDomain): with the shape functions N,

    r_i = INT N_i [J phi_w c - (J phi_w c)_previous] dV0 / dt - INT grad N_i . j dv

is zero at each free node that nothing else acts on. Elsewhere it is what flows into the body there. The N_i add up to 1
and their gradients to 0, so the sum of r_i over a body is exactly the rate of its content: what is lost is
what was left over in the nodes that should balance.
"""

import re
from dataclasses import dataclass

import numpy as np

from harness.arrays import Array
from harness.models.document import Model
from harness.models.mesh import Part
from harness.models.parts import GAS_CONSTANT, TEMPERATURE, Mixture
from harness.post.hexahedra import Geometry, geometry
from harness.run.logdata import History


@dataclass(frozen=True)
class State:
    """Node data at one time."""

    positions: Array  # shape (n_nodes, 3): mm
    pressure: Array  # shape (n_nodes,): p~, MPa
    concentrations: Array  # shape (n_solutes, n_nodes): c~, mM (= nmol/mm^3)

    @property
    def concentration(self) -> Array:
        """That of the first solute."""
        return np.asarray(self.concentrations[0])


def states(history: History) -> list[State]:
    """The states of a run of a model with solutes."""
    solutes = [name for name in history.columns if re.fullmatch(r"c\d+", name)]
    positions = np.stack([history[axis] for axis in "xyz"], axis=2)
    concentrations = np.stack([history[name] for name in solutes], axis=1)
    return [State(*at) for at in zip(positions, history["p"], concentrations, strict=True)]


def referential(material: Mixture, reference: Geometry, current: Geometry, concentrations: Array) -> Array:
    """J phi_w c of each solute at the integration points, nmol per mm^3 of the reference configuration.

    material: phi_w = 1 - phi_0/J, not less than 0, and c = kappa~ c~.
    concentrations: shape (n_solutes, n_elements, n_nodes), effective concentrations c~ of the elements' nodes, mM.
    Returns: shape (n_solutes, n_elements, n_points).
    """
    stretch = current.volumes / reference.volumes
    pores = np.maximum(stretch - (1.0 - material.porosity), 0.0)
    pairs = zip(material.solutes, concentrations, strict=True)
    return np.stack([pores * solute.solubility * current.at_points(c) for solute, c in pairs])


def contents(model: Model, part: Part, state: State) -> Array:
    """Amount of each solute in a part, shape (n_solutes,), nmol."""
    nodes = part.elements - 1
    reference = geometry(model.mesh.nodes, nodes)
    current = geometry(state.positions, nodes)
    amount = referential(model.mixture(part.material), reference, current, state.concentrations[:, nodes])
    return np.asarray(np.sum(amount * reference.volumes, axis=(1, 2)))


def content(model: Model, part: Part, state: State) -> float:
    """Amount of the first solute in a part, nmol."""
    return float(contents(model, part, state)[0])


def inflows(model: Model, part: Part, before: State, after: State, step: float) -> Array:
    """Solute that enters a part at each node during a step, nmol; zero at a node that balances.

    model: all of whose mixtures have all its solutes.
    before, after: at the start and the end of the step.
    step: s.
    Returns: shape (n_solutes, n_nodes), over all nodes of the mesh.
    """
    nodes, material = part.elements - 1, model.mixture(part.material)
    reference, old, new = (geometry(x, nodes) for x in (model.mesh.nodes, before.positions, after.positions))
    stored = referential(material, reference, new, after.concentrations[:, nodes])
    stored -= referential(material, reference, old, before.concentrations[:, nodes])
    moved = step * _fluxes(material, reference, new, after, part) * new.volumes[..., None]
    entries = np.einsum("qa,keq->kea", new.rule.values, stored * reference.volumes)
    entries -= np.einsum("eqai,keqi->kea", new.gradients, moved)
    total = np.zeros((len(entries), len(model.mesh.nodes)))
    for row, values in zip(total, entries, strict=True):
        np.add.at(row, nodes, values)
    return total


def inflow(model: Model, part: Part, before: State, after: State, step: float) -> Array:
    """`inflows` of the first solute, shape (n_nodes,)."""
    return np.asarray(inflows(model, part, before, after, step)[0])


def _fluxes(material: Mixture, reference: Geometry, current: Geometry, state: State, part: Part) -> Array:
    """Flux j of each solute at the integration points, (n_solutes, n_elements, n_points, 3), nmol/(mm^2 s).

    Equations of Mauck, Hung and Ateshian, J Biomech Eng 125:602-614 (2003), as FEBio's materials evaluate them, for
    constant isotropic permeability k and diffusivities d, d0, and neutral solutes:
    w = -[1/k + SUM (1 - d/d0) R T kappa c~ / (phi_w d0)]^-1 (grad p~ + SUM R T kappa d/d0 grad c~),
    j = kappa d (w c~/d0 - phi_w grad c~).
    """
    nodes = part.elements - 1
    porosity = 1.0 - (1.0 - material.porosity) * reference.volumes / current.volumes
    drag = np.full(porosity.shape, 1.0 / material.permeability)
    drive = current.gradient(state.pressure[nodes])
    values = [current.at_points(c[nodes]) for c in state.concentrations]
    slopes = [current.gradient(c[nodes]) for c in state.concentrations]
    for solute, c, slope in zip(material.solutes, values, slopes, strict=True):
        thermal = GAS_CONSTANT * TEMPERATURE * solute.solubility
        ratio = solute.diffusivity / solute.free_diffusivity
        drag += (1.0 - ratio) * thermal * c / (porosity * solute.free_diffusivity)
        drive = drive + thermal * ratio * slope
    solvent = -drive / drag[..., None]
    return np.stack(
        [
            s.solubility * s.diffusivity * (solvent * c[..., None] / s.free_diffusivity - porosity[..., None] * slope)
            for s, c, slope in zip(material.solutes, values, slopes, strict=True)
        ]
    )
