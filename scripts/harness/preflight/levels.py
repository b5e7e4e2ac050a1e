"""Pressures and concentrations that a model starts from and prescribes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.preflight.document import Element, children, text
from harness.preflight.joint import Joint
from harness.preflight.model import Condition, Contact, Model

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Level:
    """A value of a field somewhere.

    Attributes
    ----------
    tag : Element
        Of the value.
    history : ndarray, shape (n, 2)
        Time and value; empty where it is a formula.
    nodes : ndarray of int, optional
        Where it is; None for the bath of a contact.
    """

    tag: Element
    history: Array
    nodes: NDArray[np.int64] | None

    @property
    def first(self) -> float:
        """Value at the start; NaN where it is a formula."""
        return float(self.history[0, 1]) if len(self.history) else float("nan")


def prescribed_pressures(model: Model) -> Iterator[Level]:
    """Effective pressures prescribed by boundary conditions."""
    yield from _fixed(model, "zero fluid pressure")
    yield from _values(model, model.boundary, "prescribed fluid pressure", 0)


def initial_pressures(model: Model) -> Iterator[Level]:
    """Effective pressures at the start."""
    yield from _values(model, model.initial, "initial fluid pressure", 0)


def prescribed_concentrations(model: Model, solute: int) -> Iterator[Level]:
    """Effective concentrations prescribed by boundary conditions."""
    for level in _fixed(model, "zero concentration"):
        if level.tag.find("c_dof") is None or _solute_of(model, level.tag.find("c_dof")) in (solute, 0):
            yield level
    yield from _values(model, model.boundary, "prescribed concentration", solute)


def initial_concentrations(model: Model, solute: int) -> Iterator[Level]:
    """Effective concentrations at the start."""
    yield from _values(model, model.initial, "initial concentration", solute)


def _values(model: Model, conditions: tuple[Condition, ...], kind: str, solute: int) -> Iterator[Level]:
    for condition in conditions:
        value = condition.tag.find("value")
        if condition.kind != kind or value is None or condition.step > 1:
            continue
        if solute and _solute_of(model, condition.tag.find("dof")) != solute:
            continue
        yield Level(value, model.history(value), model.nodes(condition))


def _fixed(model: Model, kind: str) -> Iterator[Level]:
    for condition in model.boundary:
        if condition.kind == kind and condition.step <= 1:
            yield Level(condition.tag, np.zeros((1, 2)), model.nodes(condition))


def _solute_of(model: Model, dof: Element | None) -> int:
    """Number of the solute in ``c1`` or in a solute's name; 0 where it is not one."""
    name = "c1" if dof is None else text(dof)
    if name in model.solutes:
        return model.solutes[name]
    return int(name[1:]) if name[:1] == "c" and name[1:].isdigit() else 0


def ambient_concentrations(model: Model, contact: Contact) -> dict[int, Element]:
    """Tags of the bath's concentrations, by the number of the solute; without `sol` it is that of all."""
    found: dict[int, Element] = {}
    for tag in children(contact.tag, "ambient_concentration"):
        named = tag.get("sol")
        numbers = model.solute_numbers if named is None else (model.solutes.get(str(named), 0),)
        found.update((number, tag) for number in numbers)
    return found


def start_concentrations(joint: Joint, solute: int) -> set[float]:
    """Concentrations that meet at the start at or in the bodies of a contact: initial, prescribed, in the bath."""
    model = joint.model
    values = {level.first for level in prescribed_concentrations(model, solute)}
    initial = list(initial_concentrations(model, solute))
    values |= {level.first for level in initial}
    covered = [node for level in initial if level.nodes is not None for node in level.nodes.tolist()]
    own = np.isin(model.mesh.bodies, list(joint.primary.bodies | joint.secondary.bodies))
    if not np.isin(np.flatnonzero(own), covered).all():
        values.add(0.0)
    bath = ambient_concentrations(model, joint.contact).get(solute)
    if bath is not None and len(model.history(bath)):
        values.add(float(model.history(bath)[0, 1]))
    return {value for value in values if np.isfinite(value)}
