"""The answers of a scene in all ways, and how far each is from the one that it is compared with."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from studies.feb import Feb
from studies.one_answer.ways import ENFORCED, WAYS, Renumbered
from studies.robustness import differences, execution, variations
from studies.robustness.execution import Ended, Way
from studies.robustness.trial import Trial

SAME = 1e-8
"""Difference, relative to the largest value of a field, that tolerances and FEBio's twelve digits leave."""
FULL, KEPT = "full Newton", "BFGS 10"


@dataclass(frozen=True)
class Answer:
    """One run."""

    scene: str
    way: str
    ended: str
    iterations: int
    retries: int
    difference: float | None = None
    """From the run that it is compared with; None where it is compared with none."""
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
