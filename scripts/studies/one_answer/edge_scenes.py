"""Porous scenes with an edge of contact: a punch, a load, a slide, and a crack that closes and opens."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from lxml import etree

from harness.arrays import Ids, Mask
from harness.models import parts
from harness.models.document import Model
from harness.models.mesh import Box, Mesh, assemble
from studies import feb
from studies.feb import Feb, only
from studies.models.quadratic import Middles
from studies.synthetic_scenes.slab_and_block import (
    BASE,
    BLOCK,
    LOADED,
    LOWER,
    PAIR,
    SLAB,
    UPPER,
    Cells,
    Elements,
    Shape,
)
from studies.synthetic_scenes.slab_and_block import mesh as slab_and_block

KIND = "sliding-mixture"
STEP = 5.0  # s. Fluid then crosses a third of an element
GAP, OVERLAP = 0.002, 0.05
"""mm between the bodies at the start: where the block is moved; where it is pushed, and has to rest on something."""
DEPTH, SLIDE, CREEP, LOAD = 0.15, 0.35, 0.1, 0.04  # mm, mm, mm of what is pushed, MPa
AMBIENT = 0.5  # mM; the slab begins with twice as much, the block with half
CELLS = {"hex8": Cells(), "hex20": Cells(4, 3, 2), "tet10": Cells(4, 3, 1), "tet15": Cells(3, 2, 1)}
"""So that no scene is large."""
TIGHT = (
    parts.Param("min_residual", 1e-26),
    parts.Param("lstol", 0.9),
    parts.Param("lsmin", 0.01),
    parts.Param("lsiter", 5),
    parts.Param("diverge_reform", True),
    parts.Param("reform_each_time_step", True),
)
"""Of the solver, beside its tolerances."""
SOLUTE = parts.Solute(1, 1e-3, 2e-3, 1.0)


def control(steps: int) -> parts.Control:
    """Fixed steps at tolerances that leave next to nothing."""
    return parts.Control(
        steps,
        STEP,
        displacement_tolerance=1e-8,
        energy_tolerance=1e-10,
        pressure_tolerance=1e-8,
        concentration_tolerance=1e-8,
        residual_tolerance=1e-10,
        reformations=50,
        solver=TIGHT,
    )


@dataclass(frozen=True)
class Scene:
    """A scene."""

    moves: str  # ``punch``, ``load``, ``slide`` or ``crack``
    elements: str = "hex8"  # as `Elements`, or ``tet15``
    shape: Shape = Shape.FLAT  # of the block's lower face
    primary: str = LOWER  # its surface is the primary one
    solute: bool = False  # whether both bodies hold a solute
    stiffness: float = 1.0  # of the block over that of the slab
    steps: int = 10
    cells: Cells | None = None  # those of `CELLS` without it

    def feb(self, name: str) -> Feb:
        """The scene as a model file."""
        model = self._crack(name) if self.moves == "crack" else self._slab_and_block(name)
        made = feb.made(model)
        return with_tet15(made) if self.elements == "tet15" else made

    @property
    def module(self) -> str:
        """FEBio's."""
        return "multiphasic" if self.solute else "biphasic"

    def _material(self, modulus: float) -> parts.Mixture:
        return parts.Mixture(parts.Solid(modulus, 0.3), 1e-3, 0.8, (SOLUTE,) if self.solute else ())

    def _model(
        self, name: str, mesh: Mesh, conditions: tuple[parts.Condition, ...], curves: tuple[parts.Curve, ...]
    ) -> Model:
        bodies = {SLAB: self._material(1.0), BLOCK: self._material(self.stiffness)}
        if not self.solute:
            ambient: tuple[parts.Param, ...] = ()
        else:
            ambient = (parts.Param("ambient_concentration", AMBIENT, attributes={"sol": "1"}),)
            held = ((SLAB, 2 * AMBIENT), (BLOCK, 0.5 * AMBIENT))
            conditions = (*conditions, *(parts.initial_concentration(body, value) for body, value in held))
            conditions = (*conditions, *(parts.concentration(f"{body}-outside", value) for body, value in held))
        return Model(
            name,
            f"{self.moves}, {self.elements}",
            self.module,
            mesh,
            bodies,
            conditions,
            control(self.steps),
            (parts.Contact(KIND, PAIR, ambient),),
            curves,
            plot=True,
        )

    def _slab_and_block(self, name: str) -> Model:
        elements = Elements.TET10 if self.elements == "tet15" else Elements(self.elements)
        gap = -OVERLAP if self.moves == "load" else GAP
        made = slab_and_block(elements, self.shape, self.primary, gap, self.cells or CELLS[self.elements])
        sets = made.node_sets | {f"{SLAB}-outside": made.node_sets[BASE], f"{BLOCK}-outside": made.node_sets[LOADED]}
        half, end = self.steps * STEP / 2, self.steps * STEP
        ramp = parts.Curve(((0.0, 0.0), (half, 1.0), (end, 1.0)))
        then = parts.Curve(((0.0, 0.0), (half, 0.0), (end, 1.0)))
        held = [parts.fix(BASE, "xyz"), parts.pressure(LOADED, 0.0)]
        if self.moves == "load":
            held += [parts.fix(LOADED, "y"), parts.displace(LOADED, "x", CREEP, 2), parts.normal_load(LOADED, LOAD, 1)]
        elif self.moves == "slide":
            held += [
                parts.fix(LOADED, "y"),
                parts.displace(LOADED, "z", -DEPTH, 1),
                parts.displace(LOADED, "x", SLIDE, 2),
            ]
        else:
            held += [parts.fix(LOADED, "xy"), parts.displace(LOADED, "z", -DEPTH, 1)]
        return self._model(name, replace(made, node_sets=sets), tuple(held), (ramp, then))

    def _crack(self, name: str) -> Model:
        """Two bodies, joined over a third of their length; pressed, then drawn apart."""
        lower = Box(SLAB, SLAB, (0.0, 0.0, 0.0), (3.0, 1.0, 1.0), (9, 2, 3))
        upper = Box(BLOCK, BLOCK, (0.0, 0.0, 1.0), (3.0, 1.0, 1.0), (9, 2, 3))
        apart = assemble([lower, upper])
        x, _, z = apart.nodes.T
        joined = _joined(apart, (abs(z - 1.0) < 1e-9) & (x < 1.0 + 1e-9))
        beyond = {LOWER: _beyond(joined, f"{BLOCK}-bottom"), UPPER: _beyond(joined, f"{SLAB}-top")}
        pair = (LOWER, UPPER) if self.primary == LOWER else (UPPER, LOWER)
        sets = joined.node_sets | {
            SLAB: np.unique(joined.parts[0].elements),
            BLOCK: np.unique(joined.parts[1].elements),
            f"{SLAB}-outside": joined.node_sets[f"{SLAB}-bottom"],
            f"{BLOCK}-outside": joined.node_sets[f"{BLOCK}-top"],
        }
        mesh = replace(joined, node_sets=sets, surfaces=joined.surfaces | beyond, pairs={PAIR: pair})
        end = self.steps * STEP
        path = parts.Curve(((0.0, 0.0), (0.4 * end, 1.0), (end, -0.1)))
        conditions = (
            parts.fix(f"{SLAB}-bottom", "xyz"),
            parts.fix(f"{BLOCK}-top", "xy"),
            parts.pressure(f"{BLOCK}-top", 0.0),
            parts.displace(f"{BLOCK}-top", "z", -DEPTH / 2, 1),
        )
        return self._model(name, mesh, conditions, (path,))


def _joined(mesh: Mesh, inside: Mask) -> Mesh:
    """With one node in place of two where they coincide and are inside."""
    keys = np.column_stack([np.round(mesh.nodes, 9), np.where(inside, -1, np.arange(len(mesh.nodes)))])
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    kept = np.sort(first)
    new = np.searchsorted(kept, first[place]) + 1
    return Mesh(
        mesh.nodes[kept],
        tuple(replace(part, elements=new[part.elements - 1]) for part in mesh.parts),
        {name: np.unique(new[ids - 1]) for name, ids in mesh.node_sets.items()},
        {name: new[facets - 1] for name, facets in mesh.surfaces.items()},
    )


def _beyond(mesh: Mesh, surface: str) -> Ids:
    facets = mesh.surfaces[surface]
    return np.asarray(facets[mesh.nodes[facets - 1, 0].mean(axis=1) > 1.0])


_BIPHASIC: Mapping[str, Scene] = {
    "punch": Scene("punch"),
    "punch-from-below": Scene("punch", primary=UPPER, shape=Shape.SPHERE),
    "sphere-loaded": Scene("load", shape=Shape.SPHERE, cells=Cells(4, 5, 2)),
    "flat-loaded": Scene("load", primary=UPPER, stiffness=3.0),
    "sphere-slides": Scene("slide", shape=Shape.SPHERE),
    "hex20-punch": Scene("punch", "hex20", Shape.SPHERE, steps=5),
    "tet10-slide": Scene("slide", "tet10", Shape.CYLINDER, steps=6),
    "tet10-load": Scene("load", "tet10", Shape.SPHERE, steps=6),
    "tet15-punch": Scene("punch", "tet15", Shape.SPHERE, steps=5),
    "crack": Scene("crack", steps=10),
}
SCENES: Mapping[str, Scene] = {
    **_BIPHASIC,
    **{f"solute-{name}": replace(scene, solute=True) for name, scene in _BIPHASIC.items()},
}


TET_FACES = ((0, 1, 2), (0, 1, 3), (1, 2, 3), (2, 0, 3))
"""Corners of the faces, in the order in which FEBio has their nodes after those of the edges."""


def _numbers(text: str | None) -> list[int]:
    return [int(number) for number in (text or "").split(",")]


def with_tet15(model: Feb) -> Feb:
    """The same model with tetrahedra of 15 nodes in place of those of 10."""
    made = model.copy()
    mesh = only(made.root, "Mesh")
    nodes = only(mesh, "Nodes")
    middle = Middles(np.array([[float(value) for value in (node.text or "").split(",")] for node in nodes]))
    for group in mesh.iter("Elements"):
        group.set("type", "tet15")
        for element in group:
            ids = _numbers(element.text)
            faces = [middle([ids[corner] for corner in face]) for face in TET_FACES]
            element.text = ",".join(map(str, [*ids, *faces, middle(ids[:4])]))
    for facet in list(mesh.iter("tri6")):
        ids = _numbers(facet.text)
        facet.tag = "tri7"
        facet.text = ",".join(map(str, [*ids, middle(ids[:3])]))
    for nodes_of in mesh.iter("NodeSet"):
        nodes_of.text = ",".join(map(str, middle.grown(_numbers(nodes_of.text))))
    for number, position in enumerate(middle.positions[len(nodes) :], len(nodes) + 1):
        etree.SubElement(nodes, "node", id=str(number)).text = ",".join(f"{value:.12g}" for value in position)
    return made
