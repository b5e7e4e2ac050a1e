"""A scene with FEBio's interface, converted, and converted with the penalties deleted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from lxml import etree

from harness.conversion import convert
from harness.errors import HarnessError
from harness.models.document import Model
from harness.run import engine, febio_log, logdata

PENALTIES = ("auto_penalty", "penalty", "pressure_penalty", "concentration_penalty")
MOST = 1.2
"""Iterations over FEBio's, at most, in any scene."""


@dataclass(frozen=True)
class Took:
    """What a run took, and the displacements, pressures and concentrations of its last state.

    Attributes
    ----------
    ended : bool
    steps, iterations, retries : int
    values : ndarray, shape (nodes, columns), optional
        None where nothing was logged.
    why : str
        Why there is no run, or why it failed.
    """

    ended: bool
    steps: int = 0
    iterations: int = 0
    retries: int = 0
    values: np.ndarray | None = None
    why: str = ""


@dataclass(frozen=True)
class Row:
    """A scene and its three runs."""

    name: str
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

    def difference(self, ours: Took) -> float:
        """Largest difference of the last state from FEBio's, of all columns relative to their largest value."""
        if self.febio.values is None or ours.values is None or self.febio.values.shape != ours.values.shape:
            return float("nan")
        size = np.abs(self.febio.values).max(axis=0)
        apart = np.abs(ours.values - self.febio.values).max(axis=0)
        return float(np.max(apart[size > 0] / size[size > 0], initial=0.0))


def compare(name: str, model: Model, folder: Path, timeout: float) -> Row:
    """Run a scene three times."""
    original = model.write(folder / name / "febio")
    febio = _run(original, model, timeout, plugin=False)
    return Row(name, febio, *(_converted(original, model, timeout, kept) for kept in (True, False)))


def _converted(original: Path, model: Model, timeout: float, kept: bool) -> Took:
    folder = original.parent.parent / ("converted" if kept else "defaults")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / original.name
    try:
        path.write_bytes(convert.convert(original).data)
    except HarnessError as error:
        return Took(ended=False, why=f"not converted: {error}")
    if not kept:
        without_penalties(path)
    return _run(path, model, timeout, plugin=True)


def without_penalties(path: Path) -> None:
    """Delete the penalties from every contact of a model file."""
    tree = etree.parse(str(path))
    for contact in tree.getroot().iter("contact"):
        for tag in [child for child in contact if child.tag in PENALTIES]:
            contact.remove(tag)
    tree.write(str(path), xml_declaration=True, encoding="ISO-8859-1")


def _run(path: Path, model: Model, timeout: float, plugin: bool) -> Took:
    command = engine.Febio4().command(path, plugin)
    report = engine.execute(command, path.parent, check=False, timeout=timeout).report
    why = "" if report.normal else _reason(report)
    return Took(report.normal, report.steps, report.iterations, report.retries, _values(path, model), why)


def _reason(report: febio_log.Report) -> str:
    return report.errors[-1] if report.errors else "no normal termination"


def _values(path: Path, model: Model) -> np.ndarray | None:
    columns = model.node_columns[3:]
    try:
        history = logdata.read_history(path.parent / model.node_file, model.node_columns)
    except HarnessError:
        return None
    return np.stack([history[column][-1] for column in columns], axis=-1)


def table(rows: Sequence[Row]) -> str:
    """A Markdown table, a row for each scene: iterations, and retries in brackets where there are any."""
    lines = ["| scene | FEBio | converted | differs by | defaults | worse in |", "|---|---|---|---|---|---|"]
    for row in rows:
        worse = "; ".join(
            f"{name}: {what}"
            for name, what in (("converted", row.worse(row.converted)), ("defaults", row.worse(row.defaults)))
            if what
        )
        cells = (
            row.name,
            _cell(row.febio),
            _cell(row.converted),
            f"{row.difference(row.converted):.1e}",
            _cell(row.defaults),
            worse.replace("|", "/"),
        )
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _cell(took: Took) -> str:
    retries = f" ({took.retries})" if took.retries else ""
    return f"{took.iterations}{retries}" if took.ended else f"fails after {took.steps} steps{retries}"


def summary(rows: Sequence[Row]) -> str:
    """How many scenes end, and how many are no worse than FEBio's."""
    sound = [row for row in rows if row.febio.ended]
    parts = [f"{len(rows)} scenes; FEBio's interface ends {len(sound)} of them."]
    for name, of in (("Converted", "converted"), ("With the penalties deleted", "defaults")):
        runs: list[tuple[Row, Took]] = [(row, getattr(row, of)) for row in sound]
        ended = sum(run.ended for _, run in runs)
        fewer = sum(run.ended and run.iterations <= row.febio.iterations for row, run in runs)
        harmed = sum(bool(row.worse(run)) for row, run in runs)
        parts.append(
            f"{name}, {ended} of these end, {fewer} in at most FEBio's iterations; {harmed} are worse: they fail, or "
            f"take more retries, or more than {MOST} times the iterations."
        )
    return " ".join(parts)
