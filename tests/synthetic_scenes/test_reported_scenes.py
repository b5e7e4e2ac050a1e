"""The scenes of reported kinds: their bodies, files, and some runs beside FEBio's interface."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from lxml import etree

from harness.conversion import convert
from harness.run import engine, logdata
from studies import feb
from studies.pages.scene_results import Took
from studies.stamps import LIMIT
from studies.synthetic_scenes import comparison, kept_runs
from studies.synthetic_scenes.reported.kinds_of_scene import SCENES
from studies.synthetic_scenes.reported.outsides import wedge_between
from studies.synthetic_scenes.reported.pressed import Dome
from studies.synthetic_scenes.reported.shapes import MIDDLES, arc, box, mapped, shell
from studies.synthetic_scenes.reported.sketch import Drawn
from studies.synthetic_scenes.reported.words import TWO_PASS, auglag, friction, radius

QUICK = ("punch-flat-tilts", "rod-in-tube-outsides", "ring-between-plates")
VELOCITIES = ("vx", "vy", "vz")
ELEMENTS = {"hex8", "hex20", "hex27", "tet4", "tet10", "tet15", "penta6", "penta15", "quad4", "tri3"}


def test_there_are_scenes_of_every_kind():
    assert len(SCENES) >= 100
    drawn = [scene.draw() for scene in SCENES.values()]
    assert {sketch.module for sketch in drawn} == {"solid", "biphasic", "solute", "multiphasic"}
    assert {shape.element for sketch in drawn for shape in sketch.bodies.values()} == ELEMENTS


@pytest.mark.parametrize("name", list(SCENES)[::12])
def test_a_scene_converts(name, tmp_path):
    made = etree.fromstring(convert.convert(SCENES[name].write(name, tmp_path)).data)
    assert {contact.get("type") for contact in made.iter("contact")} == {"sliding-mixture"}


@pytest.mark.parametrize("element", MIDDLES)
def test_a_ring_is_closed_and_its_sides_cover_it(element):
    ring = mapped((2, 8, 2), arc(1.0, 2.0, 1.5), element)
    sides = [facet for side in ("x0", "x1", "z0", "z1") for facet in ring.sides[side]]
    assert sorted(map(sorted, sides)) == sorted(map(sorted, ring.sides["outside"]))
    assert "y0" not in ring.sides
    flow = sum(_volume_under(ring.nodes[list(facet)]) for facet in ring.sides["outside"])
    assert flow == pytest.approx(8 * np.sin(np.pi / 4) / 2 * 3.0 * 1.5, rel=0.2)


def _volume_under(nodes: np.ndarray) -> float:
    """A third of the flow of the position through the corners of a facet: its part of the volume that it bounds."""
    corners = nodes[: 3 if len(nodes) in (3, 6, 7) else 4]
    area = sum(np.cross(a - corners[0], b - corners[0]) / 2 for a, b in pairwise(corners[1:]))
    return float(corners.mean(axis=0) @ area / 3.0)


def test_middles_lie_on_the_curve():
    ring = mapped((1, 4, 1), arc(1.0, 2.0, 1.0), "hex20")
    radii = np.hypot(*ring.nodes[sorted({n for facet in ring.sides["x1"] for n in facet}), :2].T)
    np.testing.assert_allclose(radii, 2.0, atol=1e-12)


def test_a_map_that_turns_elements_over_is_refused():
    with pytest.raises(AssertionError, match="turns elements over"):
        mapped((1, 1, 1), box((0, 0, 1), (1, 1, 0)))


def test_a_shell_has_two_faces():
    plate = shell((2, 3), box((0, 0, 0), (1, 1, 0)), 0.1, "tri3")
    assert [facet[::-1] for facet in plate.sides["face"]] == plate.sides["back"]


def test_a_run_is_kept_until_its_model_or_a_program_changes(tmp_path):
    program = tmp_path / "program"
    program.write_text("one")
    model = tmp_path / "model.feb"
    model.write_text("<febio_spec/>")
    took = Took(True, 10, 30, 1)
    first = kept_runs.key(model, [program], 60.0)
    kept_runs.write(took, tmp_path, first)
    kept = kept_runs.read(tmp_path, first)
    assert kept is not None
    assert repr(kept) == repr(took)
    program.write_text("two!")
    assert kept_runs.read(tmp_path, kept_runs.key(model, [program], 60.0)) is None


@pytest.mark.usefixtures("runner")
@pytest.mark.parametrize("name", QUICK)
def test_a_scene_runs_as_with_febios_interface(name, tmp_path):
    row = comparison.compare(name, SCENES[name], tmp_path, LIMIT, ("converted",))
    assert row.febio.ended
    assert row.converted.ended, row.converted.why
    assert row.converted.retries <= row.febio.retries
    assert not row.defaults.made


@pytest.mark.usefixtures("runner")
@pytest.mark.parametrize("name", ["plates-tet4", "plates-tet10-incompressible", "plates-biphasic"])
def test_clamped_edges_under_rigid_plates_need_no_shorter_steps(name, tmp_path):
    """No solution can change the overlap of a clamped node and a plate, and its neighbours do not make up for it."""
    row = comparison.compare(name, SCENES[name], tmp_path, LIMIT, ("defaults",))
    assert row.defaults.ended, row.defaults.why
    assert row.defaults.retries == row.febio.retries == 0


@pytest.mark.usefixtures("runner")
def test_a_wedge_that_contact_alone_holds_needs_no_shorter_steps(tmp_path):
    """Couplings that the matrix does not contain hold the wedge: an increment without them moves it far away."""
    scene = Drawn("a wedge between two bodies", partial(wedge_between, auglag(1.3, 0.1, TWO_PASS)))
    row = comparison.compare("wedge", scene, tmp_path, LIMIT, ("defaults",))
    assert row.defaults.ended, row.defaults.why
    assert row.defaults.retries == row.febio.retries == 0


@pytest.mark.usefixtures("runner")
def test_an_iteration_that_moves_a_body_beyond_the_search_radius_does_not_lose_the_contact(tmp_path):
    """A soft penalty lets the force push the body by several times the radius, in the first iteration alone."""
    params = auglag(0.05, 0.1, radius(0.02) + TWO_PASS + friction(0.2))
    scene = Drawn("a dome under a pressure, small search radius", Dome(params=params, load=0.05, gap=-0.01))
    row = comparison.compare("dome", scene, tmp_path, LIMIT, ("converted",))
    assert row.converted.ended, row.converted.why
    assert row.converted.retries == 0


@pytest.mark.usefixtures("runner")
def test_a_roller_that_turns_far_in_a_step_needs_no_shorter_ones(tmp_path):
    """Elements follow the second-order part of the rotation, which a large penalty must not turn into a load."""
    row = comparison.compare("roller-rolls", SCENES["roller-rolls"], tmp_path, LIMIT, ("defaults",))
    assert row.defaults.ended, row.defaults.why
    assert row.defaults.retries == row.febio.retries == 0


@pytest.mark.usefixtures("runner")
def test_a_body_leaves_a_wall_with_no_more_energy_than_it_came_with(tmp_path):
    scene = SCENES["impact-wall"]
    path = comparison.write_converted(
        scene.write("wall", tmp_path / "febio"), tmp_path / "defaults", comparison.without_penalties
    )
    logged = feb.only(feb.read(path).root, "Output/logfile/node_data")
    path.write_text(path.read_text().replace(str(logged.get("data")), ";".join(VELOCITIES)))
    engine.execute(engine.Febio4().command(path, plugin=True), path.parent)
    velocities = logdata.read_history(path.parent / str(logged.get("file")), VELOCITIES).values
    # All elements of the block are equal: a node's mass is in proportion to their number.
    bodies = scene.draw().bodies
    elements = np.bincount(np.ravel(bodies["block"].elements))
    first = len(bodies["slab"].nodes)
    of_block = velocities[:, first : first + len(elements)]
    energies = np.einsum("tni,tni,n->t", of_block, of_block, elements)
    assert energies[-1] < energies[0]
