"""A scene with FEBio's interface, converted, with the penalties deleted, and with the predictor as well."""

import math
import shutil
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np
from lxml import etree

from harness.arrays import Array
from harness.conversion import convert
from harness.errors import HarnessError
from harness.models.interface import InterfaceType
from harness.run import engine, febio_log, logdata
from studies import feb
from studies.feb import Element
from studies.pages.scene_results import AT_LIMIT, Row, Took
from studies.stamps import at_limit
from studies.synthetic_scenes import kept_runs

POSITIONS, DISPLACEMENTS = ("x", "y", "z"), ("ux", "uy", "uz")
DISPLACEMENT = "displacement"
PENALTIES = ("auto_penalty", "penalty", "pressure_penalty", "concentration_penalty")
State = dict[str, Array]  # by kind
Change = Callable[[Element], None]


class Written(Protocol):
    """A scene that writes itself."""

    @property
    def about(self) -> str:
        """What it stands for."""

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` with FEBio's interface into `folder`, and return its path."""


def compare(name: str, scene: Written, folder: Path, limit: float, ways: Iterable[str] | None = None) -> Row:
    """Run a scene with FEBio's interface and in each of some of `WAYS` (all without it), with a limit of processor
    time (s) for each run.

    Runs that were made in the same folder before, of the same model with the same programs and limit, are kept.
    """
    original = scene.write(name, folder / name / "febio")
    febio = _run(original, limit, plugin=False)
    state = _state(original) if febio.ended else None
    chosen = WAYS if ways is None else {way: WAYS[way] for way in ways}
    ours = {way: _converted(original, folder / name / way, limit, state, change) for way, change in chosen.items()}
    return Row(name, scene.about, replace(febio, difference=0.0), **ours)


def _converted(original: Path, folder: Path, limit: float, state: State | None, change: Change) -> Took:
    try:
        path = write_converted(original, folder, change)
    except HarnessError as error:
        return Took(ended=False, why=f"not converted: {error}")
    took = _run(path, limit, plugin=True)
    return _compared(took, state, _state(path)) if took.ended else took


def write_converted(original: Path, folder: Path, change: Change) -> Path:
    """Write a model into another folder, converted and with a change of each contact, and return its path.

    Raises HarnessError where it cannot be converted.
    """
    made_by_runs = shutil.ignore_patterns("*.txt", "*.log", kept_runs.NAME)
    shutil.copytree(original.parent, folder, dirs_exist_ok=True, ignore=made_by_runs)
    path = folder / original.name
    made = convert.convert(path)
    for file, data in {**made.included, path: made.data}.items():
        file.write_bytes(data)
    model = feb.read(path)
    for contact in model.contacts:
        change(contact)
    return model.write(folder)


def as_converted(_: Element) -> None:
    """Leave a contact as it is."""


def without_penalties(contact: Element) -> None:
    """Delete the penalties of a contact."""
    for tag in [child for child in contact if child.tag in PENALTIES]:
        contact.remove(tag)


def predicted(contact: Element) -> None:
    """Delete the penalties of a contact and turn the predictor on where it is the plugin's."""
    without_penalties(contact)
    if contact.get("type") == InterfaceType.MIXTURE.value:
        etree.SubElement(contact, "predictor").text = "1"


WAYS: Mapping[str, Change] = {"converted": as_converted, "defaults": without_penalties, "predicted": predicted}
"""What is changed in each contact of the converted model, by the names of the runs."""


def _run(path: Path, limit: float, plugin: bool) -> Took:
    host = engine.Febio4()
    key = kept_runs.key(path, host.binaries(plugin), limit)
    kept = kept_runs.read(path.parent, key)
    if kept is not None:
        return kept
    done = engine.execute(engine.limited(host.command(path, plugin), limit), path.parent, check=False)
    report = done.report
    why = "" if report.normal else _reason(report, done.cpu, limit)
    took = Took(report.normal, report.steps, report.iterations, report.retries, why=why)
    kept_runs.write(took, path.parent, key)
    return took


def _compared(took: Took, febio: State | None, ours: State | None) -> Took:
    if febio is None or ours is None or febio.keys() != ours.keys():
        return took
    apart = {kind: _difference(febio[kind], ours[kind]) for kind in febio}
    displacement = apart.pop(DISPLACEMENT, math.nan)
    return replace(took, difference=displacement, of_fields=max(apart.values(), default=math.nan))


def _difference(febio: Array, ours: Array) -> float:
    size = np.abs(febio).max()
    return float(np.abs(ours - febio).max() / size) if size > 0 else 0.0


def _reason(report: febio_log.Report, cpu: float, limit: float) -> str:
    if at_limit(report.normal, cpu, limit):
        return AT_LIMIT
    return "; ".join(report.errors) or "no normal termination"


def _state(path: Path) -> State | None:
    """What the model logs of all nodes but their positions, at the end of a run: displacements are one kind."""
    logged = feb.read(path).root.find("Output/logfile/node_data")
    if logged is None:
        return None
    columns = tuple(str(logged.get("data")).split(";"))
    try:
        history = logdata.read_history(path.parent / str(logged.get("file")), columns)
    except HarnessError:
        return None
    kinds = {column: DISPLACEMENT if column in DISPLACEMENTS else column for column in columns}
    return {
        kind: logdata.at_the_end(history, (column for column in columns if kinds[column] == kind))
        for kind in dict.fromkeys(kinds.values())
        if kind not in POSITIONS
    }
