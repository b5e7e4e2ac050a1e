"""Contact nodes that are not in contact: ambient values by load curve, prescribed values, and shared nodes."""

from __future__ import annotations

import febio_runs
import numpy as np
import pytest
from scenes.ambient import CONCENTRATION, CURVES, PRESSURE, Apart, HalfWet
from scenes.patches import Patches

from harness.models.interface import InterfaceType
from harness.models.parts import Control, concentration, pressure
from harness.post import compare
from harness.run import engine, logdata
from studies import feb
from studies.synthetic_scenes import scenes_of_files


def ambient(times):
    """Ambient pressure (MPa) and concentration (mM) at the given times (s)."""
    factors = [np.interp(times, *zip(*curve.points, strict=True)) for curve in CURVES]
    return PRESSURE * factors[0], CONCENTRATION * factors[1]


def at(run, column, node_set):
    """Values of a column over a node set, shape (n_times, n_nodes)."""
    return run.nodes[column][:, run.model.mesh.node_sets[node_set] - 1]


@pytest.mark.parametrize("module", ["solute", "multiphasic"])
def test_ambient_values_follow_their_load_curves(context, module):
    if module == "multiphasic" and context.interface is not InterfaceType.MIXTURE:
        pytest.skip("FEBio takes no load curve for the ambient concentration of 'sliding-multiphasic'")
    run = context.runner(Apart(context.interface, module=module).model())
    p, c = ambient(run.nodes.times)
    for surface in ("lower-top", "upper-bottom"):
        np.testing.assert_allclose(at(run, "p", surface), np.broadcast_to(p[:, None], (len(p), 4)), rtol=1e-11)
        np.testing.assert_allclose(at(run, "c1", surface), np.broadcast_to(c[:, None], (len(c), 4)), rtol=1e-11)


@pytest.mark.mixture_only
def test_prescribed_values_on_contact_nodes_are_left_alone(context):
    held = (concentration("lower-top", 0.7), pressure("upper-bottom", 2e-3))
    run = context.runner(Apart(context.interface, held=held, name="held").model())
    p, c = ambient(run.nodes.times)
    np.testing.assert_allclose(at(run, "c1", "lower-top")[1:], 0.7, rtol=1e-12)
    np.testing.assert_allclose(at(run, "p", "upper-bottom")[1:], 2e-3, rtol=1e-12)
    np.testing.assert_allclose(at(run, "p", "lower-top")[:, 0], p, rtol=1e-11)
    np.testing.assert_allclose(at(run, "c1", "upper-bottom")[:, 0], c, rtol=1e-11)


@pytest.mark.mixture_only
def test_a_node_is_at_ambient_only_where_no_interface_has_it_in_contact(context):
    run = context.runner(HalfWet(context.interface).model())
    slab, left = at(run, "c1", "slab-top")[-1], at(run, "c1", "left-bottom")[-1]
    x = run.model.mesh.nodes[run.model.mesh.node_sets["slab-top"] - 1, 0]
    np.testing.assert_allclose(slab[x == 2.0], CONCENTRATION, rtol=1e-11)
    np.testing.assert_allclose(at(run, "c1", "right-bottom")[-1], CONCENTRATION, rtol=1e-11)
    np.testing.assert_allclose(slab[x < 1.5], left, rtol=1e-5)
    assert np.all(np.abs(slab[x < 1.5] - CONCENTRATION) > 1e-2)


def in_two_steps(model, folder):
    """The model in two analysis steps: the interface on the right alone, then both."""
    file = feb.read(model.write(folder))
    scenes_of_files.two_steps((1, 2), file.root, folder)
    left = feb.only(file.root, "Step/step[@id='1']/Contact/contact[@surface_pair='pair-1']")
    left.getparent().remove(left)
    return file.write(folder)


@pytest.mark.mixture_only
def test_an_analysis_step_begins_with_contact_where_the_last_one_had_ambient_values(context, tmp_path):
    """At the end, the slab has the values of a model in which both interfaces are there from the start."""
    model = HalfWet(context.interface, Control(20, 100.0)).model()
    file = in_two_steps(model, tmp_path)
    assert febio_runs.run(file, plugin=engine.required_plugin()).report.normal
    found = logdata.read_history(tmp_path / model.node_file, model.node_columns)
    slab, left = (found["c1"][-1, model.mesh.node_sets[s] - 1] for s in ("slab-top", "left-bottom"))
    x = model.mesh.nodes[model.mesh.node_sets["slab-top"] - 1, 0]
    np.testing.assert_allclose(slab[x == 2.0], CONCENTRATION, rtol=1e-11)
    np.testing.assert_allclose(slab[x < 1.5], left, rtol=1e-5)
    assert np.all(np.abs(slab[x < 1.5] - CONCENTRATION) > 1e-2)


def test_two_interfaces_that_share_nodes_act_as_one(context):
    two, one = (
        context.runner(Patches(context.interface, divided=divided, name=f"patches-{divided}").model())
        for divided in (True, False)
    )
    # A node on the seam has a law in either interface, averaged over its part of the area around it: the same but for
    # the leak of the default penalties, 1e-5 of the drop across the adjoining elements.
    np.testing.assert_allclose(two.nodes["c1"], one.nodes["c1"], atol=1e-5 * np.ptp(one.nodes["c1"]) / 8)
    assert np.ptp(at(two, "c1", "lower-top")[-1]) > 0.02


@pytest.mark.mixture_only
def test_two_interfaces_that_share_nodes_do_not_show(context):
    two = context.runner(Patches(context.interface, name="patches-True").model())
    reference = context.runner(Patches(InterfaceType.CONFORMING, name="patches-conforming").model())
    assert compare.largest_difference(two, reference, "c1") <= 1e-6
