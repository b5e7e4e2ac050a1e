"""What a run says as a whole: force or approach, area of contact, content; and its fields at some nodes."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.arrays import Array
from harness.models.document import Model
from harness.models.parts import Mixture
from harness.post import solute_balance
from harness.post.hexahedra import geometry
from harness.run.logdata import History
from studies.synthetic_scenes.slab_and_block import BLOCK, LOADED, PAIR, SLAB

COLUMNS = ("Rx", "Ry", "Rz")
FACETS = ("contact pressure",)
FORCE, APPROACH, AREA, FACETS_AREA, VOLUME, SOLUTE = (
    "force [N]",
    "approach [mm]",
    "area of contact [mm^2]",
    "area of facets with a pressure [mm^2]",
    "solvent lost by the slab [mm^3]",
    "solute of the slab [nmol]",
)


@dataclass(frozen=True)
class State:
    """The end of a run."""

    scalars: Mapping[str, float]  # by what they are, with their unit
    fields: Mapping[str, Array]  # by their names, at all nodes. Shape (n_nodes, n_components)


def state(model: Model, nodes: History, facets: History, *, moved: bool) -> State:
    """The end of a run of a model; `moved` says whether the block is moved, or else loaded."""
    columns = {name: nodes[name][-1] for name in nodes.columns}
    positions = np.stack([columns[axis] for axis in "xyz"], axis=1)
    loaded = model.mesh.node_sets[LOADED] - 1
    scalars = _areas(model, positions, facets["contact pressure"][-1])
    if moved:
        scalars[FORCE] = abs(float(columns["Rz"][loaded].sum()))
    else:
        scalars[APPROACH] = abs(float(columns["uz"][loaded].mean()))
    fields = {"displacement": np.stack([columns[name] for name in ("ux", "uy", "uz")], axis=1)}
    if isinstance(model.materials[SLAB], Mixture):
        scalars |= _contents(model, positions, nodes)
        fields["pressure"] = columns["p"][:, None]
    if "c1" in columns:
        fields["concentration"] = columns["c1"][:, None]
    return State(scalars, fields)


def _areas(model: Model, positions: Array, pressure: Array) -> dict[str, float]:
    """Deformed area of the primary surface's facets with a mean pressure above 0, and (INT p dA)^2 / INT p^2 dA.

    The second is the area itself where the pressure is uniform, and does not ask whether a facet at the edge with a
    trace of pressure is in contact.
    """
    corners = positions[model.mesh.surfaces[model.mesh.pairs[PAIR][0]][:, :4] - 1]
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    areas = np.linalg.norm(across, axis=1) / 2.0
    area = (pressure @ areas) ** 2 / (pressure**2 @ areas)
    return {AREA: float(area), FACETS_AREA: float(areas[pressure > 0.0].sum())}


def _contents(model: Model, positions: Array, nodes: History) -> dict[str, float]:
    part = next(part for part in model.mesh.parts if part.name == SLAB)
    before, after = (geometry(x, part.elements - 1).volumes.sum() for x in (model.mesh.nodes, positions))
    found = {VOLUME: float(before - after)}
    if model.n_solutes:
        found[SOLUTE] = solute_balance.content(model, part, solute_balance.states(nodes)[-1])
    return found


def at_nodes_of(coarse: Model, fine: Model) -> NDArray[np.int64]:
    """For each node of a coarse mesh the index of the node of a finer one at the same place of the same body."""
    found = np.zeros(len(coarse.mesh.nodes), dtype=np.int64)
    for body in (SLAB, BLOCK):
        own, other = (model.mesh.node_sets[body] - 1 for model in (coarse, fine))
        gaps = np.linalg.norm(coarse.mesh.nodes[own][:, None] - fine.mesh.nodes[other][None], axis=2)
        assert gaps.min(axis=1).max() < 1e-9, "the meshes are not nested"
        found[own] = other[gaps.argmin(axis=1)]
    return found
