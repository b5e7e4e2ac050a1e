"""Blocks whose displacements are all fixed: contact is transport alone, and says so."""

from __future__ import annotations

import shutil
from copy import deepcopy
from dataclasses import replace

import febio_runs
import numpy as np
import pytest
from lxml import etree
from scenes import pairs

from harness.models.parts import Param, fix
from harness.run import engine, logdata
from studies.models.sheared_blocks import Kind

REASON = "No traction: the displacements of both surfaces are fixed."
SAME = 1e-9
"""Relative: two runs that differ in the word for their effects alone."""
STEADY = 1e-6
"""Relative: what is left of a transient after 8 steps of more than twice the slowest time."""


def blocks(name, effects="all", fixed=True):
    """Two multiphasic blocks that share three solutes and just touch; all nodes fixed, or pressed together."""
    settings = pairs.ContactSettings(extra=(Param("effects", effects),))
    pair = replace(pairs.of_kinds(Kind.MULTIPHASIC, Kind.MULTIPHASIC), name=name, settings=settings)
    model = pair.model()
    if not fixed:
        return model
    transport = tuple(c for c in model.conditions if "displacement" not in c.kind)
    conditions = (*transport, fix("lower-all", "xyz"), fix("upper-all", "xyz"))
    # Later steps are steady to rounding, and FEBio's relative norms then compare rounding with rounding.
    return replace(model, conditions=conditions, control=replace(model.control, steps=4))


def end_of(run, surface):
    return run.surface(surface).values[-1, 0]


@pytest.fixture(scope="module")
def run(runner):
    return runner(blocks("fixed"))


def test_the_log_says_why_there_is_no_traction(run):
    assert f"exchanges solvent, solute 1, solute 2, solute 3. {REASON}" in run.log


def test_fluxes_pass_and_no_force_does(run):
    lower, upper = (end_of(run, surface) for surface in ("lower-top", "upper-bottom"))
    assert np.all(lower[:3] == 0)
    assert np.all(np.abs(lower[3:]) > 0)
    assert np.array_equal(lower, -upper)


def test_traction_may_be_left_out_by_name(run, runner):
    named = runner(blocks("fixed-named", "solvent, solutes"))
    assert np.allclose(end_of(named, "lower-top"), end_of(run, "lower-top"), rtol=SAME, atol=0)


def test_traction_must_not_be_left_out_where_bodies_can_move(runner):
    run = runner(blocks("fixed-refused", "solvent, solutes", fixed=False), check=False)
    assert not run.report.normal
    assert run.report.steps == 0
    assert "<effects> omits traction, but not all displacements" in " ".join(run.report.errors)


def test_restart_of_fixed_blocks(runner, tmp_path):
    """From the archive that was written after 3 of 4 steps; FEBio needs a plot file to continue."""
    model = replace(blocks("fixed-restart"), plot=True)
    whole = runner(model, options=("-dump=1", "-dump_stride=3"))
    folder = shutil.copytree(whole.folder, tmp_path / "continued")
    (folder / model.node_file).unlink()
    febio_runs.restart(folder / f"{model.name}.dmp", plugin=engine.required_plugin())
    part = logdata.read_history(folder / model.node_file, model.node_columns)
    assert np.allclose(part.times, whole.nodes.times[4:])
    assert np.allclose(part.values, whole.nodes.values[4:], rtol=SAME, atol=0)


def in_two_steps(model, path):
    """The model with its displacements all fixed in a first analysis step, and as it is in a second one."""
    path.mkdir()
    file = model.write(path)
    document = etree.parse(file)
    root = document.getroot()
    control, boundary = root.find("Control"), root.find("Boundary")
    moving = [bc for bc in boundary if "displacement" in bc.get("type")]
    fixed = etree.Element("Boundary")
    for surface in ("lower-all", "upper-all"):
        condition = etree.SubElement(fixed, "bc", type="zero displacement", node_set=surface)
        for axis in "xyz":
            etree.SubElement(condition, f"{axis}_dof").text = "1"
    free = etree.Element("Boundary")
    free.extend(moving)
    steps = etree.SubElement(root, "Step")
    for number, conditions in enumerate((fixed, free), start=1):
        step = etree.SubElement(steps, "step", id=str(number), name=f"step {number}")
        step.append(deepcopy(control))
        step.append(conditions)
    root.remove(control)
    root.remove(steps)
    root.insert(list(root).index(root.find("Output")), steps)
    document.write(file, encoding="utf-8", xml_declaration=True)
    return file


def test_blocks_that_are_freed_in_a_second_step(runner, tmp_path):
    """The contact finds out at the start of each step, and ends in the steady state of blocks that were never fixed."""
    free = runner(blocks("never-fixed", fixed=False))
    model = blocks("freed", fixed=False)
    file = in_two_steps(model, tmp_path / "freed")
    report = febio_runs.run(file, plugin=engine.required_plugin()).report
    log = file.with_suffix(".log").read_text()
    assert report.normal
    assert log.index(REASON) < log.index("exchanges traction, solvent")
    expected = free.nodes.values[-1]
    found = logdata.read_history(file.parent / model.node_file, model.node_columns).values[-1]
    assert np.allclose(found, expected, rtol=STEADY, atol=STEADY * np.abs(expected).max(axis=0))
