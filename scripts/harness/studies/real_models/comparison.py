"""A scene with FEBio's interface, converted, and converted with the penalties deleted."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from harness.conversion import convert
from harness.errors import HarnessError
from harness.models.document import Model
from harness.run import engine, febio_log, logdata

PENALTIES = ("auto_penalty", "penalty", "pressure_penalty", "concentration_penalty")
Array = NDArray[np.float64]
MOST = 1.2
"""Iterations over FEBio's, at most, in any scene."""


@dataclass(frozen=True)
class Took:
    """What a run took.

    Attributes
    ----------
    ended : bool
    steps, iterations, retries : int
    difference : float
        Largest difference of the last state from that of FEBio's interface, of all logged values relative to the
        largest of their kind; 0 for FEBio's interface itself, not a number where a run did not end.
    why : str
        Why there is no run, or why it failed.
    """

    ended: bool
    steps: int = 0
    iterations: int = 0
    retries: int = 0
    difference: float = math.nan
    why: str = ""


@dataclass(frozen=True)
class Row:
    """A scene and its three runs."""

    name: str
    about: str
    febio: Took
    converted: Took
    defaults: Took

    def worse(self, ours: Took) -> str:
        """In what a run of ours is worse than FEBio's; empty where in nothing."""
        if not self.febio.ended:
            return ""
        if not ours.ended:
            return ours.why or "does not end"
        found = ["more retries"] if ours.retries > self.febio.retries else []
        if ours.iterations > MOST * self.febio.iterations:
            found.append("more iterations")
        return ", ".join(found)


def compare(name: str, about: str, model: Model, folder: Path, timeout: float) -> Row:
    """Run a scene three times."""
    original = model.write(folder / name / "febio")
    febio = _run(original, timeout, plugin=False)
    state = _state(original, model)
    ours = [_converted(original, model, timeout, state, kept) for kept in (True, False)]
    return Row(name, about, replace(febio, difference=0.0), *ours)


def _converted(original: Path, model: Model, timeout: float, state: Array | None, kept: bool) -> Took:
    folder = original.parent.parent / ("converted" if kept else "defaults")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / original.name
    try:
        path.write_bytes(convert.convert(original).data)
    except HarnessError as error:
        return Took(ended=False, why=f"not converted: {error}")
    if not kept:
        without_penalties(path)
    return replace(_run(path, timeout, plugin=True), difference=_difference(state, _state(path, model)))


def without_penalties(path: Path) -> None:
    """Delete the penalties from every contact of a model file."""
    tree = etree.parse(str(path))
    for contact in tree.getroot().iter("contact"):
        for tag in [child for child in contact if child.tag in PENALTIES]:
            contact.remove(tag)
    tree.write(str(path), xml_declaration=True, encoding="ISO-8859-1")


def _run(path: Path, timeout: float, plugin: bool) -> Took:
    command = engine.Febio4().command(path, plugin)
    report = engine.execute(command, path.parent, check=False, timeout=timeout).report
    why = "" if report.normal else _reason(report)
    return Took(report.normal, report.steps, report.iterations, report.retries, why=why)


def _difference(febio: Array | None, ours: Array | None) -> float:
    if febio is None or ours is None or febio.shape != ours.shape:
        return math.nan
    size = np.abs(febio).max(axis=0)
    apart = np.abs(ours - febio).max(axis=0)
    return float(np.max(apart[size > 0] / size[size > 0], initial=0.0))


def _reason(report: febio_log.Report) -> str:
    return report.errors[-1] if report.errors else "no normal termination"


def _state(path: Path, model: Model) -> Array | None:
    """Displacements, and pressures and concentrations where there are any, of all nodes at the end of a run."""
    columns = model.node_columns[3:]
    try:
        history = logdata.read_history(path.parent / model.node_file, model.node_columns)
    except HarnessError:
        return None
    return np.stack([history[column][-1] for column in columns], axis=-1)
