"""Nodes of a contact surface with a pressure or concentration prescribed by a boundary condition.

FEBio's interfaces write the ambient values over them where they are not in contact; `sliding-mixture`
leaves them as they are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from harness.preflight import levels
from harness.preflight.levels import Array, Level
from harness.preflight.sides import Joint
from harness.preflight.xml_file import Element


@dataclass(frozen=True)
class PrescribedNodes:
    """Nodes of a contact that a boundary condition holds.

    Attributes
    ----------
    tag : Element
        Of the condition's value.
    field : str
        What it holds.
    nodes : int
        Number of nodes.
    as_ambient : bool
        Whether at the ambient value.
    """

    tag: Element
    field: str
    nodes: int
    as_ambient: bool


def prescribed_nodes(joint: Joint) -> Iterator[PrescribedNodes]:
    """Every boundary condition that holds a pressure or a concentration at nodes of the contact."""
    model, contact = joint.model, joint.contact
    if not contact.kind.solvent:
        return
    ambient = contact.given("ambient_pressure")
    for level in levels.prescribed_pressures(model):
        yield from _prescribed(joint, level, "fluid pressure", ambient)
    for number in model.solute_numbers if contact.kind.solutes else ():
        ambient = levels.ambient_concentrations(model, contact).get(number)
        for level in levels.prescribed_concentrations(model, number):
            yield from _prescribed(joint, level, f"concentration of solute {number}", ambient)


def _prescribed(joint: Joint, level: Level, field: str, ambient: Element | None) -> Iterator[PrescribedNodes]:
    own = np.union1d(*(side.surface.corners.ravel() for side in joint.sides))
    nodes = 0 if level.nodes is None else len(np.intersect1d(own, level.nodes))
    if nodes:
        history = np.zeros((1, 2)) if ambient is None else joint.model.history(ambient)
        yield PrescribedNodes(level.tag, field, nodes, _equal(level.history, history))


def _equal(one: Array, other: Array) -> bool:
    """Whether two histories are the same at all times; a formula's is the same as none."""
    when = levels.times([one, other])
    return bool(np.allclose(levels.at(one, when), levels.at(other, when), rtol=1e-9, atol=0.0))
