"""Pressures and concentrations that a model starts from and prescribes, and where it does so in a contact."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from harness.arrays import Array, Ids
from harness.preflight.model import Condition, Contact, Model
from harness.preflight.sides import Joint
from harness.preflight.xml_file import Element, children, text


@dataclass(frozen=True)
class Level:
    """A value of a field somewhere."""

    tag: Element  # of the value
    history: Array  # shape (n, 2): time and value; empty where it is a formula
    nodes: Ids  # where it is

    @property
    def first(self) -> float:
        """Value at the start; NaN where it is a formula."""
        return float(self.history[0, 1]) if len(self.history) else float("nan")


def prescribed(model: Model, solute: int | None = None) -> Iterator[Level]:
    """Effective concentrations of a solute that boundary conditions prescribe; effective pressures without it."""
    for condition in _at_start(model.boundary, "zero", solute):
        named = condition.tag.find("c_dof")
        if solute is None or named is None or not _solutes_of(model, named).isdisjoint((solute, 0)):
            yield Level(condition.tag, np.zeros((1, 2)), model.nodes(condition))
    yield from _values(model, model.boundary, "prescribed", solute)


def initial(model: Model, solute: int | None = None) -> Iterator[Level]:
    """Effective concentrations of a solute at the start; effective pressures without it."""
    yield from _values(model, model.initial, "initial", solute)


def _at_start(conditions: Iterable[Condition], what: str, solute: int | None) -> Iterator[Condition]:
    kind = f"{what} {'fluid pressure' if solute is None else 'concentration'}"
    return (condition for condition in conditions if condition.kind == kind and condition.step <= 1)


def _values(model: Model, conditions: Iterable[Condition], what: str, solute: int | None) -> Iterator[Level]:
    for condition in _at_start(conditions, what, solute):
        value, dof = condition.tag.find("value"), condition.tag.find("dof")
        own = 1 if dof is None or not solute else next(iter(_solutes_of(model, dof)))
        if value is not None and (not solute or own == solute):
            yield Level(value, model.history(value), model.nodes(condition))


def _solutes_of(model: Model, dof: Element) -> set[int]:
    """Numbers of the solutes in ``c1``, in a solute's name, or in a list of them; 0 for what is not one."""
    return {_solute_of(model, name.strip()) for name in text(dof).split(",")}


def _solute_of(model: Model, name: str) -> int:
    if name in model.solutes:
        return model.solutes[name]
    return int(name[1:]) if name[:1] == "c" and name[1:].isdecimal() else 0


def ambient_concentrations(model: Model, contact: Contact) -> dict[int, Element]:
    """Tags of the ambient concentrations, by the number of the solute; without `sol` it is that of all."""
    found: dict[int, Element] = {}
    for tag in children(contact.tag, "ambient_concentration"):
        named = tag.get("sol")
        numbers = model.solute_numbers if named is None else (model.solutes.get(str(named), 0),)
        found.update((number, tag) for number in numbers)
    return found


def start_concentrations(joint: Joint, solute: int) -> set[float]:
    """Concentrations that meet at the start at or in the bodies of a contact: initial, prescribed, ambient."""
    model = joint.model
    given = list(initial(model, solute))
    values = {level.first for level in (*prescribed(model, solute), *given)}
    covered = [node for level in given for node in level.nodes.tolist()]
    own = np.isin(model.mesh.bodies, list(joint.primary.bodies | joint.secondary.bodies))
    if not np.isin(np.flatnonzero(own), covered).all():
        values.add(0.0)
    ambient = ambient_concentrations(model, joint.contact).get(solute)
    if ambient is not None and len(model.history(ambient)):
        values.add(float(model.history(ambient)[0, 1]))
    return {value for value in values if np.isfinite(value)}


# ---- pressures against concentrations ----


def osmotic_scale(joint: Joint) -> float:
    """R T Phi; Phi is that of the mixtures at the contact where they agree, else NaN."""
    found = {m.osmotic for side in joint.sides for m in side.kinds if m.solutes and math.isfinite(m.osmotic)}
    return joint.model.gas_constant_and_temperature * found.pop() if len(found) == 1 else math.nan


def covering(level: Level, others: Sequence[Level]) -> Level | None:
    """The other value on all nodes of a level, if there is one."""
    return next((other for other in others if np.isin(level.nodes, other.nodes).all()), None)


def times(histories: Sequence[Array]) -> Array:
    """All times of histories."""
    return np.unique(np.concatenate([history[:, 0] for history in histories]))


def at(history: Array, when: Array) -> Array:
    """Values of a history at times; NaN where it is a formula's."""
    return np.asarray(np.interp(when, history[:, 0], history[:, 1])) if len(history) else np.full(len(when), math.nan)


def osmotic(joint: Joint, concentrations: Sequence[Array], when: Array) -> Array:
    """R T Phi sum c at times, of the histories of concentrations; NaN where one is a formula's."""
    return np.asarray(osmotic_scale(joint) * np.sum([at(history, when) for history in concentrations], axis=0))


def pressures_with_concentrations(model: Model) -> Iterator[tuple[Level, list[Array]]]:
    """Prescribed effective pressures, each with the histories of the concentrations that its nodes have."""
    known = [list(prescribed(model, number)) for number in model.solute_numbers]
    for pressure in prescribed(model):
        there = [match for group in known if (match := covering(pressure, group)) is not None]
        yield pressure, [level.history for level in there]


def fluid_pressures(joint: Joint) -> Array:
    """Fluid pressures p = p~ + R T Phi sum c that the model prescribes, over time, ambient ones too."""
    model = joint.model
    given = [(pressure.history, there) for pressure, there in pressures_with_concentrations(model)]
    ambient = joint.contact.given("ambient_pressure")
    if ambient is not None:
        tags = ambient_concentrations(model, joint.contact).values()
        given.append((model.history(ambient), [model.history(tag) for tag in tags]))
    every = np.concatenate([np.empty(0), *(_fluid_pressure(joint, *each) for each in given)])
    return np.asarray(every[np.isfinite(every)])


def _fluid_pressure(joint: Joint, pressure: Array, concentrations: Sequence[Array]) -> Array:
    when = times([pressure, *concentrations])
    return at(pressure, when) + (osmotic(joint, concentrations, when) if concentrations else 0.0)


# ---- nodes of a contact that a boundary condition holds ----


@dataclass(frozen=True)
class PrescribedNodes:
    """Nodes of a contact that a boundary condition holds."""

    tag: Element  # of the condition's value
    field: str  # what it holds
    nodes: int  # number of nodes
    as_ambient: bool  # whether at the ambient value


def prescribed_nodes(joint: Joint) -> Iterator[PrescribedNodes]:
    """Every boundary condition that holds a pressure or a concentration at nodes of the contact.

    FEBio's interfaces write the ambient values over them where they are not in contact; `sliding-mixture` leaves them.
    """
    model, contact = joint.model, joint.contact
    if not contact.kind.solvent:
        return
    ambient = contact.given("ambient_pressure")
    for level in prescribed(model):
        yield from _prescribed(joint, level, "fluid pressure", ambient)
    for number in model.solute_numbers if contact.kind.solutes else ():
        ambient = ambient_concentrations(model, contact).get(number)
        for level in prescribed(model, number):
            yield from _prescribed(joint, level, f"concentration of solute {number}", ambient)


def _prescribed(joint: Joint, level: Level, field: str, ambient: Element | None) -> Iterator[PrescribedNodes]:
    own = np.union1d(*(side.surface.corners.ravel() for side in joint.sides))
    nodes = len(np.intersect1d(own, level.nodes))
    if nodes:
        history = np.zeros((1, 2)) if ambient is None else joint.model.history(ambient)
        yield PrescribedNodes(level.tag, field, nodes, _equal(level.history, history))


def _equal(one: Array, other: Array) -> bool:
    """Whether two histories are the same at all times; a formula's is the same as none."""
    when = times([one, other])
    return bool(np.allclose(at(one, when), at(other, when), rtol=1e-9, atol=0.0))
