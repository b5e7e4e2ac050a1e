"""A model without and with the predictor, and what the two runs took."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from harness.models.document import Model
from harness.models.interface import InterfaceType
from harness.models.parts import Contact, Rigid
from harness.run.runner import Runner
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.scene import Fineness, Interface
from studies.models import kept_models as collection
from studies.models.pieces import PREDICTOR
from studies.stamps import at_limit

MOST = 1.02
"""Iterations with the predictor over those without it, at most, for it to become the default."""


@dataclass(frozen=True)
class Took:
    """What a run took: time steps, Newton iterations, steps tried again; and whether the limit ended it."""

    model: str
    predictor: bool
    ended: bool
    limited: bool
    steps: int
    iterations: int
    retries: int


@dataclass(frozen=True)
class Pair:
    """The runs of a model without and with the predictor."""

    without: Took
    predicted: Took

    @property
    def name(self) -> str:
        """The model's."""
        return self.without.model

    @property
    def both_end(self) -> bool:
        """Whether both runs end."""
        return self.without.ended and self.predicted.ended

    @property
    def ratio(self) -> float:
        """Iterations with the predictor over those without it."""
        return self.predicted.iterations / max(1, self.without.iterations)

    @property
    def harms(self) -> str:
        """In what the predictor is worse; empty where in nothing."""
        worse = []
        if self.without.ended and not self.predicted.ended:
            worse.append("ended by the limit" if self.predicted.limited else "does not end")
        if self.predicted.retries > self.without.retries:
            worse.append("more retries")
        if self.predicted.ended and self.ratio > MOST:
            worse.append("more iterations")
        return ", ".join(worse)


def with_predictor(model: Model) -> Model:
    """The same model with `predictor` 1 in each contact of the plugin."""
    return replace(model, contacts=tuple(_predicted(contact) for contact in model.contacts))


def _predicted(contact: Contact) -> Contact:
    if contact.kind != InterfaceType.MIXTURE.value:
        return contact
    others = tuple(param for param in contact.params if param.tag != "predictor")
    return replace(contact, params=(*others, PREDICTOR))


def known_models(meshes: Sequence[Fineness]) -> Iterator[tuple[str, Model]]:
    """Name and model: those of the repository, then each hard case on these meshes.

    Models without sliding contact have no predictor. Models with rigid bodies are left out: the predictor is not
    available there.
    """
    for model in collection.models():
        slides = any(contact.kind == InterfaceType.MIXTURE.value for contact in model.contacts)
        if slides and not any(isinstance(material, Rigid) for material in model.materials.values()):
            yield model.name, model
    for name, case in CASES.items():
        for mesh in meshes:
            yield f"{name}, {mesh.value}", case.scene.model(mesh, Interface.MIXTURE)


def run(name: str, model: Model, runner: Runner) -> Pair:
    """Run a model without and with the predictor."""
    return Pair(_took(name, False, model, runner), _took(name, True, with_predictor(model), runner))


def _took(name: str, predictor: bool, model: Model, runner: Runner) -> Took:
    result = runner(model, check=False)
    report = result.report
    limited = at_limit(report.normal, result.cpu, result.limit)
    return Took(name, predictor, report.normal, limited, report.steps, report.iterations, report.retries)


def runs(pairs: Iterable[Pair]) -> list[Took]:
    """The runs of all pairs, a row of a table each."""
    return [took for pair in pairs for took in (pair.without, pair.predicted)]


def pairs(found: Sequence[Took]) -> list[Pair]:
    """What `runs` was made from."""
    predicted = {took.model: took for took in found if took.predictor}
    return [Pair(took, predicted[took.model]) for took in found if not took.predictor]
