"""The answers of a scene in all ways, and how far each is from the one that it is compared with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from studies.one_answer.ways import ENFORCED, WAYS, Renumbered
from studies.robustness import differences, execution, variations
from studies.robustness.execution import Ended, Way
from studies.robustness.feb import Feb
from studies.robustness.trial import Trial

SAME = 1e-8
"""Difference, relative to the largest value of a field, that tolerances and FEBio's twelve digits leave."""
FULL, KEPT = "full Newton", "BFGS 10"


@dataclass(frozen=True)
class Answer:
    """One run.

    Attributes
    ----------
    scene, way : str
    ended : str
    iterations, retries : int
    difference : float, optional
        From the run that it is compared with; None where it is compared with none.
    across : bool
        Whether that one has its conditions enforced another way, so that they differ by what a penalty leaves.
    """

    scene: str
    way: str
    ended: str
    iterations: int
    retries: int
    difference: float | None = None
    across: bool = False

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
        """In all ways."""
        seen = variations.watched(self.model)
        full = self._run(WAYS[FULL](seen), FULL)
        yield self._answer(FULL, full)
        for name in (name for name in WAYS if name != FULL):
            yield self._answer(name, self._run(WAYS[name](seen), name), full)
        yield self._renumbered(WAYS[FULL](seen), full)
        for name in (name for name in ENFORCED if name != "PENALTY"):
            yield from self._enforced(name, seen, full)
        for name in (FULL, KEPT):
            yield from self._interrupted(name)

    def _run(self, model: Feb, name: str) -> Ended:
        return execution.run(model, self.folder / name.replace(" ", "-"), self.way)

    def _answer(self, name: str, run: Ended, reference: Ended | None = None, *, across: bool = False) -> Answer:
        gap = None if reference is None else _difference(run, reference)
        return Answer(self.model.name, name, run.how, run.report.iterations, run.report.retries, gap, across)

    def _renumbered(self, model: Feb, full: Ended) -> Answer:
        numbers = Renumbered.of(model)
        run = self._run(numbers(model), "renumbered")
        back = (
            run
            if run.nodes is None
            else Ended(run.folder, run.code, run.report, run.sanitizers, numbers.back(run.nodes))
        )
        return self._answer("renumbered", back, full)

    def _enforced(self, name: str, model: Feb, full: Ended) -> Iterator[Answer]:
        """By full Newton beside the penalty, and with a matrix that is kept beside that."""
        own = self._run(WAYS[FULL](ENFORCED[name](model)), name)
        yield self._answer(name, own, full, across=True)
        yield self._answer(f"{name}, {KEPT}", self._run(WAYS[KEPT](ENFORCED[name](model)), f"{name} {KEPT}"), own)

    def _interrupted(self, name: str) -> Iterator[Answer]:
        """On two threads, restarted, and cut back."""
        trial = Trial(WAYS[name](self.model), self.way, self.folder / f"{name}-interrupted".replace(" ", "-"), 0)
        for found in trial.findings():
            if found.variation in ("as it is", "few matrices"):
                continue
            ended = found.ended if found.difference is not None else "nothing to compare"
            yield Answer(self.model.name, f"{name}, {found.variation}", ended, 0, found.retries, found.difference)


def _difference(run: Ended, reference: Ended) -> float:
    if run.nodes is None or reference.nodes is None:
        return float("inf")
    return differences.largest(run.nodes, reference.nodes)
