"""The same model written differently, and the pieces of the scenes; no run is needed."""

from __future__ import annotations

import numpy as np
import pytest
from lxml import etree

from harness.models.parts import Solid
from studies.hard_cases import rubbing, variants
from studies.hard_cases.catalogue import CASES, rotation
from studies.hard_cases.press import Press, stress, stretches
from studies.hard_cases.scene import Fineness, Interface
from studies.hard_cases.uniaxial import drained


def volumes(mesh):
    """Smallest Jacobian over the corners' edges of each element, by its first node."""
    x = np.concatenate([mesh.nodes[part.elements - 1] for part in mesh.parts])
    return np.linalg.det(np.stack([x[:, k] - x[:, 0] for k in (1, 3, 4)], axis=1))


@pytest.mark.parametrize("mesh", Fineness)
@pytest.mark.parametrize("name", rubbing.CASES)
def test_a_case_of_friction_can_be_written_with_and_without_it(name, mesh):
    case = rubbing.CASES[name]
    with_it, without = case.scene.model(mesh, Interface.MIXTURE), case.frictionless.model(mesh, Interface.MIXTURE)
    assert np.all(volumes(with_it.mesh) > 0.0)
    assert with_it.conditions == without.conditions
    (first,), (second,) = with_it.contacts, without.contacts
    assert {param.tag for param in first.params} - {param.tag for param in second.params} >= {"fric_coeff"}


@pytest.mark.parametrize("mesh", Fineness)
@pytest.mark.parametrize("name", CASES)
def test_a_case_can_be_written_for_each_interface(name, mesh):
    for interface in Interface:
        model = CASES[name].scene.model(mesh, interface)
        assert np.all(volumes(model.mesh) > 0.0)
        root = etree.fromstring(model.text().split("?>", 1)[1].encode())
        kinds = {contact.get("type") for contact in root.iter("contact")}
        assert kinds == {interface.contact_type.value}


def test_a_moved_model_is_the_original_turned_and_shifted():
    model = Press(gap=1e-3).model(Fineness.FINE, Interface.MIXTURE)
    moved = variants.moved(model)
    np.testing.assert_allclose(volumes(moved.mesh), volumes(model.mesh), rtol=1e-12)
    columns = ("x", "y", "z")
    np.testing.assert_allclose(variants.turned_back(moved.mesh.nodes, columns), model.mesh.nodes, atol=1e-12)
    axes = [param.value for condition in moved.conditions for param in condition.params if param.tag == "dof"]
    assert "x" in axes  # what was pushed along z
    assert "z" not in axes


def test_renumbered_nodes_are_at_their_places():
    model = Press(gap=1e-3).model(Fineness.FINE, Interface.MIXTURE)
    other, place = variants.renumbered(model)
    np.testing.assert_array_equal(other.mesh.nodes[place], model.mesh.nodes)
    for name, facets in model.mesh.surfaces.items():
        np.testing.assert_array_equal(other.mesh.nodes[other.mesh.surfaces[name] - 1], model.mesh.nodes[facets - 1])


@pytest.mark.parametrize("units", variants.UNITS, ids=lambda units: units.name)
def test_units_there_and_back(units):
    model = Press(gap=1e-3).model(Fineness.COARSE, Interface.MIXTURE)
    other = variants.in_units(model, units)
    values = np.column_stack([other.mesh.nodes, np.full(len(other.mesh.nodes), 1.0 / units.length**-3)])
    back = variants.from_units(values, ("x", "y", "z", "c1"), units)
    np.testing.assert_allclose(back[:, :3], model.mesh.nodes, rtol=1e-12)
    np.testing.assert_allclose(back[:, 3], 1.0, rtol=1e-12)
    # R T c is a pressure: what 1 mM amounts to changes as a stress does
    stress_factor = units.length**2 / units.force
    expected = model.gas_constant * stress_factor / units.length**3
    assert other.gas_constant == pytest.approx(expected)


def test_the_blocks_bear_the_same_stress():
    soft, stiff = Solid(1.0, 0.2), Solid(20.0)
    below, above = stretches(soft, stiff, 0.1)
    assert below + above == pytest.approx(1.9, abs=1e-14)
    assert stress(soft, below) == pytest.approx(stress(stiff, above), rel=1e-10)
    assert stress(Solid(1.0), 1.0 - 1e-6) == pytest.approx(-1e-6, rel=1e-5)
    assert drained(Solid(1.0, 0.49), 1.0 - 1e-6) == pytest.approx(-1e-6, rel=1e-5)


def test_a_rotation_turns_and_keeps_lengths():
    turn = rotation((0.0, 1.0, 0.0), -45.0)
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(turn @ np.array([1.0, 0.0, 1.0]) / np.sqrt(2.0), [0.0, 0.0, 1.0], atol=1e-15)
