"""Two blocks whose facets do not match, tied, under linear fields: tension, shear, p~ and c~.

With d = d0 and p~ = -R T c~ no solvent flows and the actual fluid pressure is zero, so that stress is uniform.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from harness.arrays import Ids
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts
from harness.models.mesh import Mesh, Nodes
from harness.models.parts import GAS_CONSTANT, TEMPERATURE, Condition, Param
from scenes.nonmatching import Block, NonMatching

Array = NDArray[np.float64]

SLOPES = {
    "ux": (1e-3, 0.0, 2e-3),
    "uy": (0.0, -5e-4, 1e-3),
    "uz": (0.0, 0.0, 3e-3),
    "c1": (0.1, 0.05, -0.3),
}
"""Derivatives with X, Y, Z of the displacement [-] and the effective concentration [mM/mm]: tension and shear."""
MEAN = 0.5
"""Effective concentration at the origin, mM."""
NEAR = 1e-9
"""Tolerance for positions, mm."""


def tied(choices: NonMatching, settings: ContactSettings | None) -> Model:
    """The blocks of a patch test, tied, with the field given at all nodes that are not inside the joint.

    Where the test holds the lower block, all of its nodes have the field.
    """
    model = choices.model()
    mesh = model.mesh
    free = _inner(mesh, "upper", choices.upper)
    if not choices.held:
        free = np.union1d(free, _inner(mesh, "lower", choices.lower))
    number = np.arange(1, len(mesh.nodes) + 1, dtype=np.int64)
    mesh = replace(mesh, node_sets={"given": np.setdiff1d(number, free)})
    osmotic = f"{-GAS_CONSTANT * TEMPERATURE!r}*({_formula('c1')})"
    conditions = (
        *(_given("displacement", _formula(f"u{axis}"), Param("dof", axis)) for axis in "xyz"),
        _given("concentration", _formula("c1"), Param("dof", "c1")),
        _given("fluid pressure", osmotic),
    )
    return replace(model, mesh=mesh, conditions=conditions, contacts=contacts(InterfaceType.TIED, mesh, settings))


def exact(places: Nodes) -> dict[str, Array]:
    """The field at undeformed positions (n, 3), mm: displacements (mm), ``p`` (MPa), ``c1`` (mM)."""
    found = {name: np.asarray(places @ np.array(slopes)) for name, slopes in SLOPES.items()}
    found["c1"] = found["c1"] + MEAN
    return found | {"p": -GAS_CONSTANT * TEMPERATURE * found["c1"]}


def _inner(mesh: Mesh, part: str, block: Block) -> Ids:
    """Numbers of the nodes of a block in the plane of the joint, but those on its sides."""
    ids = np.unique(next(each for each in mesh.parts if each.name == part).elements)
    angle = np.radians(block.angle)
    across = mesh.nodes[ids - 1, :2] @ np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    inside = np.all(np.abs(across) < block.width / 2 - NEAR, axis=1) & (np.abs(mesh.nodes[ids - 1, 2]) < NEAR)
    return np.asarray(ids[inside], dtype=np.int64)


def _formula(name: str) -> str:
    slopes = "+".join(f"{slope!r}*{axis}" for slope, axis in zip(SLOPES[name], "XYZ", strict=True))
    return (f"{MEAN!r}+{slopes}" if name == "c1" else slopes).replace("+-", "-")


def _given(kind: str, formula: str, *params: Param) -> Condition:
    field = Param("value", formula, attributes={"type": "math"})
    return Condition("bc", f"prescribed {kind}", "given", (*params, field, Param("relative", False)))
