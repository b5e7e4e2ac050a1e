"""Settings take effect: surfaces turned round, load curves on penalties, penalties of zero, solutes by name."""

from __future__ import annotations

import re
from dataclasses import replace

import febio_runs
import numpy as np
import pytest
from scenes import pairs

from harness.models.confined import LOAD, OVERLAP, Confined
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Control, Curve, Param, normal_load
from harness.post import compare
from harness.run import engine, logdata
from studies.models.sheared_blocks import Kind

pytestmark = pytest.mark.mixture_only

STEPS = 4


def nonzeroes(run):
    """The largest number of entries of the matrix, as FEBio's log has it."""
    return max(int(found) for found in re.findall(r"Nr of nonzeroes in stiffness matrix \.+ : (\d+)", run.log))


def force(run):
    """The force that the upper block is pushed back with, N."""
    return run.surface("lower-top")["contact_force.z"][:, 0]


@pytest.mark.parametrize("side", ["primary", "secondary"])
@pytest.mark.parametrize("kind", [Kind.ELASTIC, Kind.SOLUTE])
def test_a_surface_that_faces_inwards_is_turned_round(runner, kind, side):
    pair = pairs.of_kinds(kind, kind)
    sound = runner(pair.model())
    model = pair.model()
    name = model.mesh.pairs["lower/upper"][("primary", "secondary").index(side)]
    mesh = replace(model.mesh, surfaces=model.mesh.surfaces | {name: model.mesh.surfaces[name][:, ::-1]})
    contact = replace(model.contacts[0], params=(*model.contacts[0].params, Param(f"flip_{side}", True)))
    turned = runner(replace(model, name=f"turned-{kind.value}-{side}", mesh=mesh, contacts=(contact,)))
    assert abs(force(sound)[-1]) > 1e-3
    np.testing.assert_allclose(force(turned), force(sound), rtol=1e-10)
    np.testing.assert_allclose(turned.nodes["uz"], sound.nodes["uz"], atol=1e-10 * pairs.CLOSING, rtol=0.0)


def _pressed(runner, name, *params, curves=()):
    """Elastic blocks in four steps at full displacement, with a contact of these parameters."""
    pair = replace(pairs.of_kinds(Kind.ELASTIC, Kind.ELASTIC), name=name, settings=ContactSettings(extra=params))
    model = pair.model()
    return runner(replace(model, curves=(*model.curves, *curves), control=Control(STEPS, pairs.STEP)))


def test_a_penalty_follows_its_load_curve(runner):
    """Where the contact gives way 1/eps is in series with the blocks: each step is that of its constant penalty."""
    ramp = Curve(((0.0, 0.0), (STEPS * pairs.STEP, 1.0)))
    followed = force(_pressed(runner, "penalty-curve", Param("penalty", 40.0, 2), curves=(ramp,)))
    constants = [
        force(_pressed(runner, f"penalty-{step}", Param("penalty", 40.0 * step / STEPS)))[-1]
        for step in range(1, STEPS + 1)
    ]
    assert abs(constants[-1]) > 1.1 * abs(constants[0])
    np.testing.assert_allclose(followed[-STEPS:], constants, rtol=1e-6)


def test_a_penalty_of_zero_transmits_nothing_and_says_so(runner):
    run = _pressed(runner, "no-penalty", Param("penalty", 0.0))
    assert np.all(force(run) == 0.0)
    assert "<penalty> is 0: the contact transmits no traction" in run.log


def test_a_penalty_of_zero_has_no_effect_in_the_log_and_no_entries(runner):
    run = _pressed(runner, "no-penalty-log", Param("penalty", 0.0))
    assert "exchanges nothing. No traction: <penalty> is 0." in run.log
    sound = _pressed(runner, "penalty-log")
    assert nonzeroes(run) < nonzeroes(sound)


def test_without_a_pressure_penalty_the_surfaces_are_impermeable_to_solvent(runner):
    """As with <effects> that leave it out."""
    pair = pairs.of_kinds(Kind.BIPHASIC, Kind.BIPHASIC)
    runs = [
        runner(replace(pair, name=name, settings=ContactSettings(extra=(given,))).model())
        for name, given in (("traction", Param("effects", "traction")), ("zero", Param("pressure_penalty", 0.0)))
    ]
    assert "exchanges traction. No solvent: <pressure_penalty> is 0." in runs[1].log
    np.testing.assert_array_equal(runs[0].nodes["p"], runs[1].nodes["p"])
    assert nonzeroes(runs[0]) == nonzeroes(runs[1])


@pytest.mark.parametrize("settings", [ContactSettings(laugon="LAGMULT"), ContactSettings()])
def test_under_tension_a_split_layer_is_drawn_out_as_its_reference(runner, settings):
    """With multipliers to rounding and the overlap at the start; with the default penalty to 1e-3."""
    tension = replace(settings, extra=(Param("tension", True),))
    runs = [
        runner(_drawn_out(kind, chosen))
        for kind, chosen in ((InterfaceType.MIXTURE, tension), (InterfaceType.CONFORMING, None))
    ]
    bar = 1e-7 if settings.laugon == "LAGMULT" else 1e-3
    for column in ("uz", "p"):
        scale = np.abs(runs[1].nodes[column]).max()
        begun = OVERLAP if column == "uz" else 0.0
        assert compare.largest_difference(runs[0], runs[1], column) <= bar * scale + begun, column
    assert runs[1].nodes["uz"].max() > 0.0


def _drawn_out(interface, settings):
    """A biphasic layer, split in two, that a load pulls at."""
    name = f"drawn-{interface.value}-{getattr(settings, 'laugon', '')}"
    model = Confined(interface, settings, elements=5, control=Control(5, 200.0), name=name).model()
    kept = tuple(condition for condition in model.conditions if condition != normal_load("top", LOAD))
    assert len(kept) < len(model.conditions)
    return replace(model, conditions=(*kept, normal_load("top", -LOAD)))


def test_an_offset_keeps_the_surfaces_apart(runner):
    """Blocks that begin an offset apart press like blocks that touch."""
    touching = _pressed(runner, "touching")
    pair = replace(
        pairs.of_kinds(Kind.ELASTIC, Kind.ELASTIC),
        name="offset",
        settings=ContactSettings(extra=(Param("offset", 0.05),)),
    )
    model = replace(pair.model(), control=Control(STEPS, pairs.STEP))
    nodes = model.mesh.nodes.copy()
    nodes[model.mesh.node_sets["upper-all"] - 1, 2] += 0.05
    apart = runner(replace(model, mesh=replace(model.mesh, nodes=nodes)))
    np.testing.assert_allclose(force(apart), force(touching), rtol=1e-8)


def test_a_load_curve_that_leads_below_zero_ends_the_run(runner):
    falling = Curve(((0.0, 1.0), (STEPS * pairs.STEP, -1.0)))
    pair = replace(
        pairs.of_kinds(Kind.ELASTIC, Kind.ELASTIC),
        name="falling",
        settings=ContactSettings(extra=(Param("penalty", 40.0, 2),)),
    )
    model = pair.model()
    model = replace(model, curves=(*model.curves, falling), control=Control(STEPS, pairs.STEP))
    run = runner(model, check=False)
    assert not run.report.normal
    assert "<penalty>" in " ".join(run.report.errors)


def test_a_search_radius_of_zero_is_the_automatic_one(runner):
    plain, zero = (
        _pressed(runner, f"radius-{len(params)}", *params) for params in ((), (Param("search_radius", 0.0),))
    )
    assert "<search_radius> is 0" in zero.log
    np.testing.assert_array_equal(zero.nodes["uz"], plain.nodes["uz"])


def test_a_solute_is_named_by_its_name_or_its_number(runner, tmp_path):
    model = pairs.of_kinds(Kind.TRIPHASIC, Kind.MULTIPHASIC).model()
    results = []
    for sol in ("2", "s2"):
        named = replace(model, name=f"sol-{sol}")
        path = named.write(tmp_path)
        tag = '<ambient_concentration sol="2">'
        assert tag in path.read_text()
        path.write_text(path.read_text().replace(tag, tag.replace("2", sol)))
        assert febio_runs.run(path, plugin=engine.required_plugin()).report.normal
        results.append(logdata.read_history(path.parent / named.node_file, named.node_columns).values)
    np.testing.assert_array_equal(*results)
