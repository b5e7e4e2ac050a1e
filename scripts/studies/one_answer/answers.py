"""The ways in which one answer is asked for, the answers of a scene, and how far each is from another one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from lxml import etree

from harness.run.logdata import History
from studies import feb as xml
from studies.feb import Element, Feb
from studies.robustness import differences, execution, variations
from studies.robustness.execution import Ended, Way
from studies.robustness.trial import Trial

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


SAME = 1e-8  # difference, relative to the largest value of a field, that tolerances and FEBio's twelve digits leave
FULL, KEPT = "full Newton", "BFGS 10"


@dataclass(frozen=True)
class Answer:
    """One run."""

    scene: str
    way: str
    ended: str
    iterations: int
    retries: int
    difference: float | None = None  # from the run that it is compared with; None where it is compared with none
    across: bool = False
    """Whether that one has its conditions enforced another way, so that they differ by what a penalty leaves."""

    @property
    def is_the_same(self) -> bool:
        """Whether it ends, and where it has to be the same is."""
        near = self.difference is None or self.across or self.difference <= SAME
        return self.ended == "normal" and near


@dataclass(frozen=True)
class Answers:
    """Of one scene; its runs are in a folder."""

    model: Feb
    way: Way
    folder: Path

    def all(self) -> Iterator[Answer]:
        """In all ways, for each way to enforce conditions; the first of these is compared with none."""
        first: Ended | None = None
        for name, enforced in ENFORCED.items():
            model = enforced(self.model)
            own = self._run(WAYS[FULL](variations.watched(model)), f"{name}, {FULL}")
            yield self._answer(f"{name}, {FULL}", own, first, across=True)
            yield from self._alike(name, model, own)
            first = first or own

    def _alike(self, name: str, model: Feb, full: Ended) -> Iterator[Answer]:
        """Of one enforcement, beside full Newton."""
        seen = variations.watched(model)
        for way in (way for way in WAYS if way != FULL):
            yield self._answer(f"{name}, {way}", self._run(WAYS[way](seen), f"{name}, {way}"), full)
        yield self._renumbered(f"{name}, renumbered", WAYS[FULL](seen), full)
        for way in (FULL, KEPT):
            yield from self._interrupted(f"{name}, {way}", WAYS[way](model))

    def _run(self, model: Feb, name: str) -> Ended:
        return execution.run(model, self.folder / _folder(name), self.way)

    def _answer(self, name: str, run: Ended, reference: Ended | None = None, *, across: bool = False) -> Answer:
        gap = None if reference is None else _difference(run, reference)
        return Answer(self.model.name, name, run.how, run.report.iterations, run.report.retries, gap, across)

    def _renumbered(self, name: str, model: Feb, full: Ended) -> Answer:
        numbers = Renumbered.of(model)
        run = self._run(numbers(model), name)
        back = run if run.nodes is None else replace(run, nodes=numbers.back(run.nodes))
        return self._answer(name, back, full)

    def _interrupted(self, name: str, model: Feb) -> Iterator[Answer]:
        """On two threads, restarted, and cut back."""
        for found in Trial(model, self.way, self.folder / _folder(f"{name}, interrupted"), 0).findings():
            if found.variation == "as it is":
                continue
            ended = found.ended if found.difference is not None else "nothing to compare"
            yield Answer(self.model.name, f"{name}, {found.variation}", ended, 0, found.retries, found.difference)
            if found.variation == "cut back":
                return


def _folder(name: str) -> str:
    return name.replace(",", "").replace(" ", "-")


def _difference(run: Ended, reference: Ended) -> float:
    """Infinite where one of both has failed, which is no answer at all."""
    failed = any(each.how != "normal" for each in (run, reference))
    if failed or run.nodes is None or reference.nodes is None:
        return float("inf")
    return differences.largest(run.nodes, reference.nodes)
