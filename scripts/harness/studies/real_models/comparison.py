"""A scene with FEBio's interface, converted, and converted with the penalties deleted."""

from __future__ import annotations

import math
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from harness.conversion import convert
from harness.errors import HarnessError
from harness.pages.scene_results import Row, Took
from harness.run import engine, febio_log, logdata

POSITIONS, DISPLACEMENTS = ("x", "y", "z"), ("ux", "uy", "uz")
DISPLACEMENT = "displacement"
PENALTIES = ("auto_penalty", "penalty", "pressure_penalty", "concentration_penalty")
Array = NDArray[np.float64]
State = dict[str, Array]
"""By kind."""


class Written(Protocol):
    """A scene that writes itself."""

    @property
    def about(self) -> str:
        """What it stands for."""

    @property
    def module(self) -> str:
        """FEBio's module."""

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` with FEBio's interface into `folder`, and return its path."""


def compare(name: str, scene: Written, folder: Path, timeout: float) -> Row:
    """Run a scene three times."""
    original = scene.write(name, folder / name / "febio")
    febio = _run(original, timeout, plugin=False)
    state = _state(original)
    ours = [_converted(original, timeout, state, kept) for kept in (True, False)]
    return Row(name, scene.about, replace(febio, difference=0.0), *ours)


def _converted(original: Path, timeout: float, state: State | None, kept: bool) -> Took:
    folder = original.parent.parent / ("converted" if kept else "defaults")
    shutil.copytree(original.parent, folder, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.txt", "*.log"))
    path = folder / original.name
    try:
        made = convert.convert(path)
    except HarnessError as error:
        return Took(ended=False, why=f"not converted: {error}")
    for file, data in {**made.included, path: made.data}.items():
        file.write_bytes(data)
    if not kept:
        without_penalties(path)
    return _compared(_run(path, timeout, plugin=True), state, _state(path))


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


def _compared(took: Took, febio: State | None, ours: State | None) -> Took:
    if febio is None or ours is None or febio.keys() != ours.keys():
        return took
    apart = {kind: _difference(febio[kind], ours[kind]) for kind in febio}
    displacement = apart.pop(DISPLACEMENT, math.nan)
    return replace(took, difference=displacement, of_fields=max(apart.values(), default=math.nan))


def _difference(febio: Array, ours: Array) -> float:
    size = np.abs(febio).max()
    return float(np.abs(ours - febio).max() / size) if size > 0 else 0.0


def _reason(report: febio_log.Report) -> str:
    return report.errors[-1] if report.errors else "no normal termination"


def _state(path: Path) -> State | None:
    """What the model logs of all nodes but their positions, at the end of a run: displacements are one kind."""
    logged = etree.parse(str(path)).getroot().find("Output/logfile/node_data")
    if logged is None:
        return None
    columns = tuple(str(logged.get("data")).split(";"))
    try:
        history = logdata.read_history(path.parent / str(logged.get("file")), columns)
    except HarnessError:
        return None
    kinds = {column: DISPLACEMENT if column in DISPLACEMENTS else column for column in columns}
    return {
        kind: np.stack([history[column][-1] for column in columns if kinds[column] == kind], axis=-1)
        for kind in dict.fromkeys(kinds.values())
        if kind not in POSITIONS
    }
