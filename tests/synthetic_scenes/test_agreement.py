"""What the study of converted models measures, and what its page says. Needs no run."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from studies.agreement import comparisons, page, quantities
from studies.agreement.comparisons import FEBIO, OURS, Row
from studies.synthetic_scenes.collection_of_scenes import SCENES
from studies.synthetic_scenes.slab_and_block import PAIR


def test_meshes_are_nested():
    coarse, fine = (comparisons._model("sphere", fineness) for fineness in (1, 3))
    places = quantities.at_nodes_of(coarse, fine)
    np.testing.assert_allclose(fine.mesh.nodes[places], coarse.mesh.nodes, atol=1e-12)


def test_each_scene_is_one_of_the_collection():
    assert set(comparisons.MESHES) <= set(SCENES)


def test_the_area_of_a_uniform_pressure_is_that_of_its_facets():
    nodes = np.array([[x, y, 0.0] for y in (0, 1) for x in (0, 1, 2)])
    facets = np.array([[1, 2, 5, 4], [2, 3, 6, 5]])
    model = SimpleNamespace(mesh=SimpleNamespace(pairs={PAIR: ("up", "down")}, surfaces={"up": facets}))
    both = quantities._areas(model, nodes, np.array([3.0, 3.0]))
    assert both == pytest.approx({quantities.AREA: 2.0, quantities.FACETS_AREA: 2.0})
    trace = quantities._areas(model, nodes, np.array([3.0, 1e-6]))
    assert trace == pytest.approx({quantities.AREA: 1.0, quantities.FACETS_AREA: 2.0}, rel=1e-5)


def row(interface: str, quantity: str, error: float, rms: float = math.nan) -> Row:
    return Row("sphere", 1, interface, quantity, 1.0, error, rms, rms, 0.001)


def test_the_headline_says_whose_errors_are_smaller():
    rows = [
        row(FEBIO, quantities.FORCE, 0.02),
        row(OURS, quantities.FORCE, 0.01),
        row(FEBIO, quantities.FACETS_AREA, 0.3),
        row(OURS, quantities.FACETS_AREA, 0.9),
        row(FEBIO, "pressure", 0.5, 0.03),
        row(OURS, "pressure", 0.1, 0.04),
    ]
    assert "nearer to the fine one in 1 of 2 quantities" in page.headline(rows)
    said = page.details(rows)
    assert "nearer to the fine answer in 1 of 1 forces, approaches, areas and contents" in said
    assert "contents and in 0 of 1 fields (L2)." in said
    assert "1.0 to 1.0 % in the converted model and 2.0 to 2.0 % with FEBio's interface" in said
    table = page.tables(rows).splitlines()
    assert table[4].startswith("| area of facets")
    assert table[6] == "| pressure | 1 |  |  | 50.00 % | 10.00 % | 3.00 % | 4.00 % | 3.00 % | 4.00 % | 0.10 % |"
