"""FEBio's `sticky` and what `convert` makes of it: the same limits, iterations and loads compared."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

import numpy as np
import pytest

from harness.conversion.convert import convert
from harness.errors import ModelError
from studies.models import small
from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed, moved, rigid

pytestmark = pytest.mark.mixture_only

STIFFNESS = 1000.0
STRENGTH = 0.05
SNAP = 1e-5
"""mm; less than the gap STRENGTH/STIFFNESS at which a node is let go, else FEBio catches it again at once."""
STEPS = 20


@dataclass(frozen=True)
class Scene:
    """Two cubes that touch, the upper one moved at its top.

    Attributes
    ----------
    z, x : tuples of points
        Time, displacement of the top, mm.
    end : bool
        Only an edge of the top is moved, and the other one stays.
    """

    z: tuple[tuple[float, float], ...] = ((0, 0),)
    x: tuple[tuple[float, float], ...] = ((0, 0),)
    end: bool = False
    cells: tuple[int, int] = (2, 2)
    gap: float = 0.0
    on_rigid: bool = False
    strength: float = STRENGTH
    more: str = ""

    def document(self) -> Document:
        """The model."""
        parts = Parts()
        parts.box("low", (0, 0, 0), (1, 1, 1), (self.cells[0], self.cells[0], 2), "low")
        parts.box("up", (0, 0, 1 + self.gap), (1, 1, 2 + self.gap), (self.cells[1], self.cells[1], 2), "up")
        top = parts.node_sets["up-top"]
        grip = [n for n in top if parts.nodes[n - 1][0] > 0.9] if self.end else top
        parts.node_sets |= {"grip": grip}
        params = (
            f"<penalty>{STIFFNESS}</penalty><max_traction>{self.strength}</max_traction>"
            f"<snap_tol>{SNAP}</snap_tol>{self.more}"
        )
        held = (fixed("low-bottom", "x", "y", "z"),) if not self.on_rigid else ()
        return Document(
            parts.mesh({"pair": ("up-bottom", "low-top")}),
            (rigid("low", 1) if self.on_rigid else elastic("low", 1, 1.0, 0.3), elastic("up", 2, 1.0, 0.3)),
            control=control("solid", STEPS, 1 / STEPS),
            boundary=(*held, moved("grip", "z", 1.0, 1), moved("grip", "x", 1.0, 2), fixed("up-top", "y")),
            rigid=(HELD,) if self.on_rigid else (),
            contacts=(contact("tie", "pair", "sticky", params),),
            curves=(curve(1, *self.z), curve(2, *self.x)),
            node_data="ux;uy;uz;Rx;Ry;Rz",
        )


HELD = (
    '<rigid_bc type="rigid_fixed"><rb>low</rb>'
    + "".join(f"<{dof}_dof>1</{dof}_dof>" for dof in ("Rx", "Ry", "Rz", "Ru", "Rv", "Rw"))
    + "</rigid_bc>"
)
UP = ((0, 0), (1, 0.2))
PEELED = "peeled"
SCENES = {
    "pulled off": Scene(UP),
    "pulled off across meshes": Scene(UP, cells=(2, 3)),
    "pulled off a rigid body": Scene(UP, on_rigid=True),
    "sheared": Scene(x=((0, 0), (1, 0.1)), strength=1.0),
    "pressed and sheared": Scene(((0, 0), (0.5, -0.05)), ((0, 0), (0.5, 0), (1, 0.1)), strength=1.0),
    "for ever": Scene(((0, 0), (1, 0.1)), strength=0.0),
    "with multipliers": Scene(UP, more="<laugon>AUGLAG</laugon><tolerance>0.01</tolerance>"),
    PEELED: Scene(((0, 0), (1, 0.3)), end=True),
    "released and pressed again": Scene(((0, 0), (0.5, 0.2), (1, -0.05))),
}


def loads(folder, document: Document) -> np.ndarray:
    """Forces on what is moved, shape (times, 3)."""
    grip = re.search(r'<NodeSet name="grip">([^<]*)<', document.mesh)
    ids = [int(n) - 1 for n in grip.group(1).split(",")]
    return small.table(folder / "nodes.txt")[1:, ids, 3:].sum(axis=1)


class MoreIterationsError(AssertionError):
    """A converted model takes more iterations than the old one."""


def first_break(force: np.ndarray) -> int:
    """The step in which the load first falls while the body is drawn; how many there are if it never does."""
    falls = np.flatnonzero(np.diff(np.linalg.norm(force, axis=1)) < 0)
    return int(falls[0]) + 1 if len(falls) else len(force)


def both(solve, tmp_path, document):
    """The runs with FEBio's interface and converted, as `solve` gives them."""
    path = tmp_path / "sticky.feb"
    path.write_text(document.text())
    new = convert(path).data.decode()
    assert 'type="tied-mixture"' in new
    return solve("sticky", document), solve("tied", new)


@pytest.mark.parametrize("name", SCENES)
def test_convert_gives_the_same_loads(solve, tmp_path, name):
    """Until the first node breaks, which may be a step apart, and at the end.

    FEBio ties nodes to facets and `tied-mixture` averages around nodes, so that loads differ on coarse meshes. The
    tolerances, 2e-3 and across meshes 5e-3, are choices near the largest differences measured.
    """
    document = SCENES[name].document()
    theirs, ours = (loads(folder, document) for folder, _ in both(solve, tmp_path, document))
    matching = SCENES[name].cells[0] == SCENES[name].cells[1]
    allowed = (2e-3 if matching else 5e-3) * np.abs(theirs).max()
    breaks = first_break(theirs), first_break(ours)
    assert abs(breaks[0] - breaks[1]) <= 1
    assert np.abs(ours - theirs)[: min(breaks)].max() <= allowed
    assert np.abs(ours - theirs)[-1].max() <= allowed


MORE = pytest.mark.xfail(
    reason="57 iterations for FEBio's 56: a row breaks a step earlier", strict=True, raises=MoreIterationsError
)


@pytest.mark.parametrize("name", [pytest.param(name, marks=MORE if name == PEELED else ()) for name in SCENES])
def test_convert_takes_no_more_iterations_than_sticky(solve, tmp_path, name):
    theirs, ours = (run.report for _, run in both(solve, tmp_path, SCENES[name].document()))
    if ours.iterations > theirs.iterations:
        raise MoreIterationsError(f"{ours.iterations} for {theirs.iterations}")


DRAWN = "pulled off", "pulled off a rigid body"
FINER = [*((name, cells) for name in DRAWN for cells in ((8, 8), (8, 7), (7, 8))), (PEELED, (8, 8))]


@pytest.mark.parametrize(("name", "cells"), FINER, ids=str)
def test_finer_meshes_take_no_more_iterations_than_sticky(solve, tmp_path, name, cells):
    """Where meshes do not match, `peeled` breaks up to a step apart from FEBio's, and what is broken turns freely."""
    theirs, ours = (run.report for _, run in both(solve, tmp_path, replace(SCENES[name], cells=cells).document()))
    assert ours.iterations <= theirs.iterations


def test_the_matrix_of_matching_meshes_has_no_more_entries_than_with_sticky(solve, tmp_path):
    document = replace(SCENES["for ever"], cells=(8, 8)).document()
    entries = []
    for folder, _ in both(solve, tmp_path, document):
        log = (folder / "model.log").read_text(errors="replace")
        entries.append(int(re.findall(r"Nr of nonzeroes in stiffness matrix \.+ : (\d+)", log)[-1]))
    assert entries[1] <= entries[0]


@pytest.mark.parametrize("name", ["pulled off a rigid body", PEELED])
def test_the_first_node_breaks_in_the_step_of_febio_where_tractions_vary(solve, tmp_path, name):
    """On meshes of 8 by 8 cells, with a traction at the edge of up to 1.8 times the mean."""
    document = replace(SCENES[name], cells=(8, 8)).document()
    theirs, ours = (first_break(loads(folder, document)) for folder, _ in both(solve, tmp_path, document))
    assert ours == theirs


@pytest.mark.parametrize("change", [{"gap": 0.05}, {"gap": 0.05, "z": ((0, 0), (1, -0.1))}])
def test_bodies_that_touch_later_keep_their_sticky(tmp_path, change):
    path = tmp_path / "sticky.feb"
    path.write_text(Scene(**change).document().text())
    with pytest.raises(ModelError, match=r"up to 0\.05 apart"):
        convert(path)
