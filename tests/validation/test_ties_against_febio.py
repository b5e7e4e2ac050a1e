"""Ties beside FEBio's own with stiff penalties: iterations, and jumps that are left."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scenes.tied_columns import column

from studies.models import small
from studies.models.small import Document, Parts, control

pytestmark = pytest.mark.mixture_only

FACTOR = 1000.0
"""Times the automatic penalty; for types that have none, times the stiffness of the elements, 3 N/mm^3."""
PENALTIES = {
    "tied-elastic": ("penalty",),
    "tied-biphasic": ("penalty", "pressure_penalty"),
    "tied-multiphasic": ("penalty", "pressure_penalty", "concentration_penalty"),
}
MODULES = {"tied-biphasic": "biphasic", "tied-multiphasic": "multiphasic"}
KINDS = ("tied-elastic", "tied-node-on-facet", "tied-facet-on-facet", "tied-biphasic", "tied-multiphasic")


def params(kind: str) -> str:
    """Penalties of a type of FEBio's."""
    if kind not in PENALTIES:
        return f"<penalty>{3 * FACTOR}</penalty>"
    return "<auto_penalty>1</auto_penalty>" + "".join(f"<{name}>{FACTOR}</{name}>" for name in PENALTIES[kind])


def by_default(document: Document, module: str) -> Document:
    """The same with FEBio's default tolerances."""
    return replace(document, control=control(module, 2, 0.5, analysis="STATIC" if module == "solid" else "TRANSIENT"))


def matrix_profiles(folder: Path) -> int:
    """How often FEBio has built the profile of its matrix."""
    return (folder / "model.log").read_text(errors="replace").count("Nr of nonzeroes in stiffness matrix")


def jumps(parts: Parts, values: np.ndarray) -> np.ndarray:
    """Differences of the means of both surfaces, by the trapezoidal rule."""
    return np.abs(mean(parts, values, "up-bottom") - mean(parts, values, "low-top"))


def mean(parts: Parts, values: np.ndarray, surface: str) -> np.ndarray:
    ids = np.array(parts.node_sets[surface]) - 1
    places = np.array(parts.nodes)[ids]
    ids = ids[np.lexsort((places[:, 1], places[:, 0]))]
    count = round(len(ids) ** 0.5)
    weights = np.ones(count)
    weights[[0, -1]] = 0.5
    weights /= weights.sum()
    return np.asarray(np.einsum("i,j,ijk->k", weights, weights, values[ids].reshape(count, count, -1)))


@pytest.mark.parametrize("cells", [(3, 3), (2, 3), (3, 2), (4, 3)], ids=lambda cells: f"{cells[0]} to {cells[1]}")
@pytest.mark.parametrize("kind", KINDS)
def test_a_hundredth_of_the_jumps_in_as_many_iterations(solve, tmp_path, kind, cells):
    module = MODULES.get(kind, "solid")
    found = {}
    for name, given in ((kind, params(kind)), ("tied-mixture", "")):
        document, parts = column(module, given, cells=cells, kind=name)
        folder, finished = solve(name, by_default(document, module))
        left = jumps(parts, small.table(folder / "nodes.txt")[-1])
        found[name] = finished.report.iterations, left[[0, 2, *range(3, len(left))]]  # uy has no mean
    (theirs, their_jumps), (ours, our_jumps) = found[kind], found["tied-mixture"]
    assert ours <= theirs
    assert matrix_profiles(tmp_path / "tied-mixture") == 1
    assert np.all(our_jumps <= 0.01 * their_jumps)


def test_the_profile_is_a_device_with_a_switch(solve):
    found = {}
    for name, given in (("on", ""), ("off", "<solver_devices>none</solver_devices>")):
        document, _ = column("solid", given, cells=(2, 3), kind="tied-mixture")
        folder, _ = solve(name, by_default(document, "solid"))
        log = (folder / "model.log").read_text(errors="replace")
        found[name] = matrix_profiles(folder), log.count("constant_profile"), small.table(folder / "nodes.txt")
    (profiles, acted, values), (others, silent, same) = found["on"], found["off"]
    assert (profiles, acted) == (1, 1)
    assert others > 1
    assert silent == 0
    assert np.array_equal(values, same)
