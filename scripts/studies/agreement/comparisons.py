"""Scenes on nested meshes with FEBio's interface and converted, against the mean of both on the finest mesh."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from harness.conversion import convert
from harness.errors import EngineFailedError
from harness.models.document import Model
from harness.run import engine, logdata
from studies.agreement import quantities
from studies.agreement.quantities import State
from studies.pages.scene_results import Took
from studies.synthetic_scenes import kept_runs
from studies.synthetic_scenes.collection_of_scenes import SCENES

FEBIO, OURS = "FEBio's", "converted"
_SCENES = ("elements-hex8", "sphere", "pressure-load", "biphasic", "biphasic-creep", "solute")
MESHES: Mapping[str, tuple[int, ...]] = dict.fromkeys(_SCENES, (1, 2, 3))
"""Scenes, and by how much finer than that of the collection each mesh is; all nodes of the first are in the others."""


@dataclass(frozen=True)
class Row:
    """One quantity of one run, beside the reference."""

    scene: str
    fineness: int
    interface: str  # `FEBIO` or `OURS`
    quantity: str  # a number with its unit, or a field
    value: float  # of a number; of a field its largest value in the reference
    error: float
    """Difference from the reference over it; of a field the largest one at any node of the coarsest mesh, over the
    field's largest value."""
    # Of a field: the mean of the differences, and the root of their mean square (L2), over the same.
    mean: float
    rms: float
    apart: float
    """Half of the difference of both interfaces on the finest mesh, in the measure of `error`: what the reference is
    not certain of."""


def compare(name: str, folder: Path, limit: float, announce: Callable[[str], None]) -> list[Row]:
    """Run a scene on its meshes with both interfaces. Raises EngineFailedError where a run does not end."""
    meshes = MESHES[name]
    models = {f: _model(name, f) for f in meshes}
    moved = SCENES[name].force is None
    found: dict[tuple[int, str], State] = {}
    for f, model in models.items():
        for interface in (FEBIO, OURS):
            announce(f"{name}, mesh {f}, {interface}")
            found[f, interface] = _run(model, folder / name / str(f), interface, limit, moved=moved)
    places = {f: quantities.at_nodes_of(models[meshes[0]], model) for f, model in models.items()}
    common = {
        (f, who): State(state.scalars, {name: field[places[f]] for name, field in state.fields.items()})
        for (f, who), state in found.items()
    }
    theirs, ours = (common[meshes[-1], interface] for interface in (FEBIO, OURS))
    return [row for (f, who), state in common.items() for row in _rows(name, f, who, state, (theirs, ours))]


def _model(name: str, fineness: int) -> Model:
    scene = replace(SCENES[name], fineness=fineness)
    model = scene.model(name)
    return replace(model, further_columns=quantities.COLUMNS, facet_columns=quantities.FACETS)


def _run(model: Model, folder: Path, interface: str, limit: float, *, moved: bool) -> State:
    path = model.write(folder / interface.split("'", maxsplit=1)[0].lower())
    if interface == OURS:
        path.write_bytes(convert.convert(path).data)
    host, plugin = engine.Febio4(), interface == OURS
    key = kept_runs.key(path, host.binaries(plugin), limit)
    if kept_runs.read(path.parent, key) is None:
        done = engine.execute(engine.limited(host.command(path, plugin), limit), path.parent, check=False)
        if not done.report.normal:
            raise EngineFailedError(f"{path} does not end within {limit:g} s: {'; '.join(done.report.errors)}")
        kept_runs.write(Took(True, done.report.steps, done.report.iterations, done.report.retries), path.parent, key)
    nodes = logdata.read_history(path.parent / model.node_file, model.node_columns)
    primary = model.mesh.pairs[model.contacts[0].pair][0]
    facets = logdata.read_history(path.parent / model.facet_file(primary), quantities.FACETS)
    return quantities.state(model, nodes, facets, moved=moved)


def _rows(name: str, fineness: int, who: str, state: State, finest: Sequence[State]) -> list[Row]:
    rows = []
    for quantity, value in state.scalars.items():
        one, two = (each.scalars[quantity] for each in finest)
        reference = (one + two) / 2.0
        apart = abs(one - two) / 2.0 / abs(reference)
        error = abs(value - reference) / abs(reference)
        rows.append(Row(name, fineness, who, quantity, value, error, math.nan, math.nan, apart))
    for quantity, field in state.fields.items():
        first, second = (each.fields[quantity] for each in finest)
        middle = (first + second) / 2.0
        size = float(np.abs(middle).max())
        gaps = np.linalg.norm(field - middle, axis=1) / size
        apart = float(np.linalg.norm(first - second, axis=1).max() / 2.0 / size)
        largest, rms = float(gaps.max()), float(np.sqrt((gaps**2).mean()))
        rows.append(Row(name, fineness, who, quantity, size, largest, float(gaps.mean()), rms, apart))
    return rows
