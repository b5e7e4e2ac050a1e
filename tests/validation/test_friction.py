"""Friction against closed forms, and against the conforming reference."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial
from itertools import product

import febio_runs
import numpy as np
import pytest
from scenes import friction_checks as checks
from scenes.block_on_incline import FRICTION, SLOPE, BlockOnIncline

from harness.conversion.convert import convert
from harness.models.interface import InterfaceType
from harness.post.compare import missed
from harness.run import engine, logdata
from studies import files
from studies.friction import page
from studies.hard_cases import rubbing_record
from studies.hard_cases.outcomes import OURS, Outcome, arranged
from studies.hard_cases.rubbing import CASES
from studies.hard_cases.scene import Fineness
from studies.models import sheared_blocks
from studies.models.sheared_blocks import MODULES, Kind, ShearedBlocks
from studies.pages.evidence import DATA

pytestmark = pytest.mark.mixture_only


@pytest.mark.parametrize("block_is_primary", [True, False])
def test_a_block_is_pushed_up_an_incline(runner, block_is_primary):
    assert missed(checks.block_pushed_up(runner, block_is_primary=block_is_primary)) == []


@pytest.mark.parametrize("phi", [0.0, 0.1, 0.5])
def test_friction_under_a_plate_grows_as_the_layer_drains(runner, phi):
    assert missed(checks.plate_sliding(runner, phi)) == []


def test_the_side_that_has_fluid_decides(runner):
    assert missed(checks.plate_sliding(runner, 0.1, layer_is_primary=False)) == []


@pytest.mark.parametrize("kind", MODULES)
def test_what_sticks_is_as_one_body(runner, kind):
    assert missed(checks.stick(runner, kind)) == []


@pytest.mark.parametrize("kind", MODULES)
def test_what_sticks_is_as_one_body_with_augmentation(runner, kind):
    assert missed(checks.augmented_stick(runner, kind)) == []


def test_without_friction_the_split_block_differs(runner):
    """The test of these tests: what they measure is friction."""
    split, reference = checks.sheared_pair(runner, Kind.ELASTIC, checks.ContactSettings())
    assert checks.displaced(split, reference) > 0.1


def test_febio_logs_friction_before_the_first_step(runner):
    """FEBio logs data when it has read a model, before the contact has output."""
    columns = tuple(
        f"contact {name}" for name in ("friction.x", "slip.x", "friction coefficient", "fluid load support")
    )
    model = replace(ShearedBlocks(Kind.ELASTIC, name="friction-from-the-start").model(), facet_columns=columns)
    logged = runner(model).facets("lower-top")
    assert logged.times[0] == 0.0
    assert not logged.values[0].any()
    assert logged["contact friction coefficient"][-1] == pytest.approx(sheared_blocks.FRICTION)


@pytest.mark.slow
def test_a_cylinder_in_partial_slip(runner):
    assert missed(checks.partial_slips(runner)) == []


def test_a_converted_model_has_the_friction_it_had(runner, tmp_path):
    model = BlockOnIncline(InterfaceType.ELASTIC, name="incline-febio").model()
    path = tmp_path / f"{model.name}.feb"
    path.write_bytes(convert(model.write(tmp_path)).data)
    febio_runs.run(path, plugin=engine.required_plugin())
    nodes, base = logdata.read_history(tmp_path / model.node_file, model.node_columns), model.mesh.node_sets["base"] - 1
    along, weight = (np.abs(nodes[column][-1, base].sum()) for column in ("Rx", "Rz"))
    assert along / weight == pytest.approx((SLOPE + FRICTION) / (1.0 - SLOPE * FRICTION), abs=checks.INCLINE_BAR)


QUICK = ("stick-slip-stick", "touch-in-motion", "fluid-bears-all")
"""The cases of friction that are run always, on the coarse mesh; the others are slow."""
ON_FINE_MESH = ("touch-in-motion", "fast-and-drained")
"""Run on the fine mesh, too. `friction-cases` runs all on both meshes, and its results are looked at below."""
RECORDED = arranged(files.read_csv(DATA / page.CASES_SOURCE, Outcome))
"""What the page of friction says."""


def cases():
    """By name and mesh, as far as they are run here."""
    coarse, fine = product(CASES, [Fineness.COARSE]), product(ON_FINE_MESH, [Fineness.FINE])
    return [_case(name, mesh) for name, mesh in (*coarse, *fine)]


def _case(name, mesh):
    slow = [] if name in QUICK and mesh is Fineness.COARSE else [pytest.mark.slow]
    return pytest.param(name, mesh, marks=slow, id=f"{name}-{mesh.value}")


@pytest.fixture(scope="module")
def made(runner):
    """A case with what was checked of it, made once."""
    return cache(partial(rubbing_record.make, runner))


@pytest.mark.parametrize(("name", "mesh"), cases())
def test_hard_cases_of_friction_end_and_are_in_balance(made, name, mesh):
    record = made(name, mesh)
    assert record.friction.ended, record.failures
    assert missed(record.measures) == []


@pytest.mark.parametrize(("name", "mesh"), cases())
def test_what_hard_cases_of_friction_cost(made, name, mesh):
    assert missed(made(name, mesh).costs) == []


@pytest.mark.parametrize(("name", "mesh"), cases())
def test_the_data_of_the_page_are_what_the_code_gives(made, name, mesh):
    """Where this fails on purpose: `scripts/mixcontact friction-cases --docs --no-febio`."""
    for now in (made(name, mesh).friction, made(name, mesh).frictionless):
        assert now.counts == RECORDED[name, mesh.value][now.interface].counts


@pytest.mark.parametrize("name", CASES)
def test_on_the_fine_mesh_the_page_has_every_case_and_misses_no_check(name):
    """The test above tells whether its data are of today."""
    written = RECORDED[name, Fineness.FINE.value][OURS]
    assert written.ended
    assert not written.missed
