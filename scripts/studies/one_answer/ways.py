"""The ways to solve a scene: changes of its file, one function each, and what its answer is compared with."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from lxml import etree

from harness.run.logdata import History
from studies import feb as xml
from studies.feb import Element, Feb

Change = Callable[[Feb], Feb]


def method(name: str, updates: int | None = None) -> Change:
    """A method of solution, with this many updates between two matrices; modified Newton knows no number."""

    def change(control: Element) -> None:
        found = xml.only(control, "solver/qn_method")
        found.clear()
        found.set("type", name)
        if updates is not None:
            xml.put(found, "max_ups", updates)

    return lambda model: model.changed("Control", change)


def contact(**values: object) -> Change:
    """Parameters of the contact."""

    def change(each: Element) -> None:
        for tag, value in values.items():
            xml.put(each, tag, value)

    return lambda model: model.changed("contact", change)


def linear_solver(name: str) -> Change:
    """A linear solver of FEBio's."""
    return lambda model: model.changed("solver", lambda solver: etree.SubElement(solver, "linear_solver", type=name))


@dataclass(frozen=True)
class Renumbered:
    """New numbers for the nodes of a model, and back: node n becomes `numbers[n - 1]`."""

    numbers: tuple[int, ...]

    @classmethod
    def of(cls, model: Feb) -> Renumbered:
        """Drawn from one seed."""
        nodes = model.root.findall("Mesh/Nodes/node")
        return cls(tuple((1 + np.random.default_rng(1).permutation(len(nodes))).tolist()))

    def __call__(self, model: Feb) -> Feb:
        """The model with these numbers; elements stay in their order."""
        made = model.copy()
        mesh = xml.only(made.root, "Mesh")
        nodes = xml.only(mesh, "Nodes")
        for node in nodes:
            node.set("id", str(self.numbers[int(node.get("id", "0")) - 1]))
        nodes[:] = sorted(nodes, key=lambda node: int(node.get("id", "0")))
        listed = [*mesh.iter("elem", "NodeSet"), *(facet for surface in mesh.iter("Surface") for facet in surface)]
        for each in listed:
            ids = [self.numbers[int(number) - 1] for number in (each.text or "").split(",")]
            each.text = ",".join(map(str, sorted(ids) if each.tag == "NodeSet" else ids))
        return made

    def back(self, found: History) -> History:
        """What a run of that model found, by the numbers of before."""
        return History(found.times, found.items, found.columns, found.values[:, np.array(self.numbers) - 1])


WAYS: Mapping[str, Change] = {
    "full Newton": method("BFGS", 0),
    "BFGS 3": method("BFGS", 3),
    "BFGS 10": method("BFGS", 10),
    "Broyden": method("Broyden", 10),
    "modified Newton": method("modified Newton"),
    "mkl_dss": linear_solver("mkl_dss"),
}
"""One answer to the tolerance of the solver."""
ENFORCED: Mapping[str, Change] = {
    "PENALTY": contact(laugon="PENALTY"),
    "AUGLAG": contact(laugon="AUGLAG", tolerance=1e-5, maxaug=20),
    "LAGMULT": contact(laugon="LAGMULT"),
}
"""One answer but for the jump that a penalty leaves."""
