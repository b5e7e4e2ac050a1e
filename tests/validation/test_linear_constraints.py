"""Linear constraints of FEBio's between nodes of a contact: a degree of freedom follows others, and has no equation."""

from __future__ import annotations

from dataclasses import replace

import febio_runs
import numpy as np
import pytest

from harness.run import engine
from studies.models import small
from studies.models.small import Document, Parts, biphasic, contact, control, curve, elastic, fixed, moved

pytestmark = pytest.mark.mixture_only

RAMP = curve(1, (0, 0), (1, 1))
CELLS = 4
"""Of the lower body along x and y."""


@pytest.fixture
def solve(runner, tmp_path):
    """Runs a document; displacements at the end, and what the run printed."""

    def run(name: str, document: Document):
        folder = tmp_path / name
        folder.mkdir()
        path = folder / "model.feb"
        path.write_text(document.text())
        finished = febio_runs.run(path, plugin=engine.required_plugin())
        return small.table(folder / "nodes.txt")[-1], finished.report

    return run


def follows(parent: int, dof: str, *children: tuple[int, float]) -> str:
    """A displacement of a node that is a sum of those of others."""
    inner = "".join(
        f"<child_dof><node>{node}</node><dof>{dof}</dof><value>{factor}</value></child_dof>"
        for node, factor in children
    )
    return f'<bc type="linear constraint"><node>{parent}</node><dof>{dof}</dof><offset>0</offset>{inner}</bc>'


def pressed(params: str = "", updates: int = 0, *, drag: bool = False, fluid: bool = False) -> tuple[Document, Parts]:
    """A block on a wider one, pressed down between two planes of symmetry, and dragged along one of them."""
    parts = Parts()
    parts.box("low", (-1, -1, 0), (1, 1, 1), (CELLS, CELLS, 2), "low")
    parts.box("up", (-0.6, -0.6, 1), (0.6, 0.6, 2), (3, 3, 2), "up")
    module, analysis = ("biphasic", "TRANSIENT") if fluid else ("solid", "STATIC")
    sideways = (moved("up-top", "x", 0.05, 2), fixed("up-top", "y")) if drag else (fixed("up-top", "x", "y"),)
    document = Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (biphasic("low", 1, 1), biphasic("up", 2, 2))
        if fluid
        else (elastic("low", 1, 1, 0.3), elastic("up", 2, 2, 0.3)),
        module=module,
        control=control(module, 4, 0.25, analysis=analysis).replace("<max_ups>0", f"<max_ups>{updates}"),
        boundary=(fixed("low-bottom", "x", "y", "z"), moved("up-top", "z", -0.1), *sideways),
        contacts=(contact("c", "pair", params=params),),
        curves=(RAMP, curve(2, (0, 0), (0.5, 0), (1, 1))),
    )
    return document, parts


def node_at(parts: Parts, *place: float) -> int:
    """The number of the last node at a place."""
    return 1 + max(n for n, point in enumerate(parts.nodes) if np.allclose(point, place))


def constrained(document: Document, *constraints: str) -> Document:
    return replace(document, boundary=(*document.boundary, *constraints))


SETTINGS = {
    "penalty": "",
    "gauss": "<integration>gauss</integration>",
    "two passes": "<two_pass>1</two_pass>",
    "augmented": "<laugon>AUGLAG</laugon>",
    "multipliers": "<laugon>LAGMULT</laugon>",
    "friction": "<fric_coeff>0.3</fric_coeff>",
}


@pytest.mark.parametrize("fluid", [False, True])
@pytest.mark.parametrize("setting", SETTINGS)
@pytest.mark.parametrize("updates", [0, 10])
def test_what_symmetry_holds_anyway_changes_nothing(solve, setting, updates, fluid):
    """Nodes of both surfaces at mirrored places; z at one is z at the other, and half of that twice."""
    document, parts = pressed(SETTINGS[setting], updates, fluid=fluid)
    expected, without = solve("without", document)
    low = [node_at(parts, x, 0.0, 1.0) for x in (0.5, -0.5)]
    up = [node_at(parts, x, y, 1.0) for x, y in ((0.2, 0.2), (-0.2, 0.2), (0.2, -0.2))]
    found, report = solve(
        "with",
        constrained(document, follows(low[0], "z", (low[1], 1.0)), follows(up[0], "z", (up[1], 0.5), (up[2], 0.5))),
    )
    np.testing.assert_allclose(found, expected, atol=2e-6)
    assert report.retries == 0
    assert report.iterations <= 1.2 * without.iterations + 2


@pytest.mark.parametrize("setting", SETTINGS)
def test_what_follows_a_prescribed_node_is_prescribed(solve, setting):
    """A node of the contact follows one that is moved, as in a model in which it is moved itself."""
    document, parts = pressed(SETTINGS[setting])
    node = node_at(parts, 0.0, 0.0, 1.0)
    moving = node_at(parts, 0.6, 0.6, 2.0)
    found, _ = solve("follows", constrained(document, follows(node, "z", (moving, 0.5))))
    mesh = document.mesh.replace("</Mesh>", f'<NodeSet name="middle">{node}</NodeSet></Mesh>')
    expected, _ = solve("moved", replace(constrained(document, moved("middle", "z", -0.05)), mesh=mesh))
    np.testing.assert_allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize("updates", [0, 10])
def test_constraints_hold_where_they_change_the_answer(solve, updates):
    document, parts = pressed("<fric_coeff>0.2</fric_coeff>", updates, drag=True)
    edge = [node_at(parts, x, -0.5, 1.0) for x in (-0.5, 0.0, 0.5)]
    found, report = solve(
        "with", constrained(document, *(follows(edge[0], dof, (edge[1], 0.25), (edge[2], 0.5)) for dof in "xyz"))
    )
    parent, one, two = (found[n - 1] for n in edge)
    np.testing.assert_allclose(parent, 0.25 * one + 0.5 * two, atol=1e-9)
    assert report.retries == 0
