"""The same model written differently: sides swapped, moved as a whole, nodes renumbered, in other units."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from harness.arrays import Array, Ids
from harness.models.document import Model
from harness.models.mesh import Mesh
from harness.models.parts import Condition, Elastic, Material, Param, Rigid
from harness.run.runner import RunResult

TURNED = {"x": "y", "y": "z", "z": "x"}  # a third of a turn about the diagonal: each axis becomes the next one
SHIFT = np.array([2.0, -1.0, 4.0])  # mm


def swapped(model: Model) -> Model:
    """Primary and secondary surfaces of all pairs exchanged."""
    pairs = {name: (secondary, primary) for name, (primary, secondary) in model.mesh.pairs.items()}
    return replace(model, name=f"{model.name}-swapped", mesh=replace(model.mesh, pairs=pairs))


def moved(model: Model) -> Model:
    """The whole model turned as `TURNED` says and shifted by `SHIFT`, its conditions with it."""
    nodes = np.roll(model.mesh.nodes, 1, axis=1) + SHIFT
    conditions = tuple(_turned(condition) for condition in model.conditions)
    return replace(model, name=f"{model.name}-moved", mesh=replace(model.mesh, nodes=nodes), conditions=conditions)


def _turned(condition: Condition) -> Condition:
    params = []
    for param in condition.params:
        axis, _, rest = param.tag.partition("_")
        if rest == "dof" and axis in TURNED:
            params.append(replace(param, tag=f"{TURNED[axis]}_dof"))
        elif param.tag == "dof" and param.value in TURNED:
            params.append(replace(param, value=TURNED[str(param.value)]))
        else:
            params.append(param)
    return replace(condition, params=tuple(params))


def turned_back(values: Array, columns: tuple[str, ...]) -> Array:
    """Node data of a moved model as those of the original: components turned back and positions shifted back."""
    found = values.copy()
    for stem in ("{}", "u{}", "R{}"):
        for axis, after in TURNED.items():
            if stem.format(axis) in columns:
                source = values[..., columns.index(stem.format(after))]
                found[..., columns.index(stem.format(axis))] = source
    for place, axis in enumerate("xyz"):
        found[..., columns.index(axis)] -= np.roll(SHIFT, -1)[place]
    return found


def renumbered(model: Model) -> tuple[Model, Ids]:
    """Nodes in a random order, and for each node of the original its index (from 0) in that order."""
    order = np.random.default_rng(1).permutation(len(model.mesh.nodes))
    place = np.argsort(order)
    mesh = model.mesh

    def new(ids: NDArray[np.int64]) -> NDArray[np.int64]:
        return np.asarray(place[ids - 1] + 1, dtype=np.int64)

    made = Mesh(
        mesh.nodes[order],
        tuple(replace(part, elements=new(part.elements)) for part in mesh.parts),
        {name: new(ids) for name, ids in mesh.node_sets.items()},
        {name: new(facets) for name, facets in mesh.surfaces.items()},
        mesh.pairs,
    )
    return replace(model, name=f"{model.name}-renumbered", mesh=made), place


def difference(first: RunResult, values: Array, times: Array) -> float:
    """Largest difference of the node data of a run and of another one, each column relative to its largest value.

    Displacements, reactions and positions are compared with the largest component of their vector. Where the runs were
    cut back differently, only the last states are compared.
    """
    own = first.nodes
    mine, other = own.values, values
    if own.times.shape != times.shape or not np.allclose(own.times, times, rtol=1e-8, atol=0.0):
        mine, other = mine[-1:], other[-1:]
    scale = np.abs(own.values).max(axis=(0, 1))
    for stem in ("{}", "u{}", "R{}"):
        vector = [own.columns.index(stem.format(a)) for a in "xyz" if stem.format(a) in own.columns]
        if vector:
            scale[vector] = scale[vector].max()
    gaps = np.abs(mine - other).max(axis=(0, 1))
    return float(np.max(np.divide(gaps, scale, out=gaps.copy(), where=scale > 0.0)))


@dataclass(frozen=True)
class Units:
    """A system of units: its length in mm and its force in N; second, kelvin and nmol stay."""

    name: str
    length: float
    force: float


UNITS = (Units("m-N-s", 1e3, 1.0), Units("um-nN-s", 1e-3, 1e-9))


def in_units(model: Model, units: Units) -> Model:
    """A model of mm, N, s in other units. Penalties must be automatic."""
    length, force = 1.0 / units.length, 1.0 / units.force
    stress, density = force / length**2, 1.0 / length**3
    factors = {
        "prescribed displacement": length,
        "prescribed fluid pressure": stress,
        "initial fluid pressure": stress,
        "prescribed concentration": density,
        "initial concentration": density,
        "pressure": stress,
    }
    contact_factors = {
        "search_radius": length,
        "gaptol": length,
        "ptol": stress,
        "ctol": density,
        "ambient_pressure": stress,
        "ambient_concentration": density,
    }
    return replace(
        model,
        name=f"{model.name}-{units.name}",
        mesh=replace(model.mesh, nodes=model.mesh.nodes * length),
        materials={name: _material_in_units(m, stress, length) for name, m in model.materials.items()},
        conditions=tuple(
            replace(c, params=tuple(_times(p, {"value": factors.get(c.kind, 1.0)}) for p in c.params))
            for c in model.conditions
        ),
        contacts=tuple(replace(c, params=tuple(_times(p, contact_factors) for p in c.params)) for c in model.contacts),
        gas_constant=model.gas_constant * force * length,
    )


def _material_in_units(material: Material, stress: float, length: float) -> Material:
    """A material with its moduli times `stress` and its lengths times `length`."""
    if isinstance(material, Rigid):
        return material
    solid = replace(material.solid, modulus=material.solid.modulus * stress)
    if isinstance(material, Elastic):
        return replace(material, solid=solid)
    solutes = tuple(
        replace(s, diffusivity=s.diffusivity * length**2, free_diffusivity=s.free_diffusivity * length**2)
        for s in material.solutes
    )
    return replace(material, solid=solid, permeability=material.permeability * length**2 / stress, solutes=solutes)


def _times(param: Param, factors: dict[str, float]) -> Param:
    factor = factors.get(param.tag, 1.0)
    return (
        param
        if factor == 1.0 or not isinstance(param.value, (int, float))
        else replace(param, value=param.value * factor)
    )


def from_units(values: Array, columns: tuple[str, ...], units: Units) -> Array:
    """Node data in mm, N, s."""
    length, force = units.length, units.force
    factors = {"p": force / length**2}
    factors |= dict.fromkeys(("x", "y", "z", "ux", "uy", "uz"), length)
    factors |= dict.fromkeys(("Rx", "Ry", "Rz"), force)
    return np.asarray(values * np.array([factors.get(name, 1.0 / length**3) for name in columns]))
