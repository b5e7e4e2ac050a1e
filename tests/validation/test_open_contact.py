"""A step that fails because the contact that should hold a body is open is named, and tried again in contact."""

from __future__ import annotations

import febio_runs
import pytest

from harness.conversion import convert
from harness.run import engine
from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed, moved
from studies.synthetic_scenes.reported.kinds_of_scene import SCENES
from studies.synthetic_scenes.varied_scenes import SCENES as VARIED

pytestmark = pytest.mark.mixture_only

SAID = "the failed step began without a node in contact"
LOAD = '<surface_load type="pressure" surface="up-top"><pressure lc="1">{}</pressure></surface_load>'


def _run(folder, gap: float, pressure: float, boundary=()):
    """A block over another one, free to move along z, under a pressure on its top."""
    parts = Parts()
    parts.box("up", (0, 0, 1 + gap), (1, 1, 2), (2, 2, 2), "up")
    parts.box("low", (-0.3, -0.3, 0), (1.3, 1.3, 1), (4, 4, 2), "low")
    document = Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (elastic("up", 1), elastic("low", 2)),
        control=control("solid", 1, 1.0, retries=2),
        boundary=(fixed("low-bottom", "x", "y", "z"), fixed("up-top", "x", "y"), *boundary),
        loads=(LOAD.format(pressure),),
        contacts=(contact("joint", "pair"),),
        curves=(curve(1, (0, 0), (1, 1)),),
    )
    path = folder / "model.feb"
    path.write_text(document.text())
    return febio_runs.run(path, plugin=engine.required_plugin(), check=False)


def _run_converted(scene, folder):
    path = folder / "converted.feb"
    path.write_bytes(convert.convert(scene.write("scene", folder)).data)
    return febio_runs.run(path, plugin=engine.required_plugin(), check=False)


def test_an_open_contact_that_should_hold_a_body_is_named(runner, tmp_path):
    found = _run(tmp_path, gap=0.1, pressure=0.01)
    assert not found.report.normal
    assert found.output.count(SAID) == 1
    assert '"joint"' in found.output.split(SAID)[0][-60:]


def test_bodies_that_nearly_touch_come_into_contact_at_the_second_attempt(runner, tmp_path):
    """A block that a gap of a fiftieth of a facet separates from the body that has to hold it."""
    found = _run(tmp_path, gap=0.01, pressure=0.01)
    assert found.report.normal, found.report.errors
    assert found.output.count(SAID) == 1
    assert found.report.retries == 1


@pytest.mark.parametrize(
    "scene",
    [SCENES["punch-incompressible"], SCENES["punch-round-friction"], VARIED["seed-046"]],
    ids=["punch-incompressible", "punch-round-friction", "in two passes"],
)
def test_points_that_overlap_hold_a_rigid_body_at_the_first_attempt(runner, tmp_path, scene):
    """A sphere under a force: its lowest points overlap, and averages around the nodes with conditions are open."""
    found = _run_converted(scene, tmp_path)
    assert found.report.normal, found.report.errors
    assert SAID not in found.output
    assert found.report.retries == 0


def test_points_that_overlap_keep_a_body_from_turning_at_the_second_attempt(runner, tmp_path):
    """A soft body that may turn about the one row of nodes whose averages overlap."""
    found = _run_converted(SCENES["cam-soft-follower"], tmp_path)
    assert found.report.normal, found.report.errors
    assert SAID not in found.output
    assert found.report.retries == 1


def test_nothing_is_said_where_contact_began_closed(runner, tmp_path):
    found = _run(tmp_path, gap=-0.01, pressure=50.0)  # so large that elements invert
    assert not found.report.normal
    assert SAID not in found.output


def test_nothing_is_said_where_no_step_fails(runner, tmp_path):
    found = _run(tmp_path, gap=0.02, pressure=0.0, boundary=(moved("up-top", "z", -0.05),))
    assert found.report.normal
    assert SAID not in found.output
