"""Every pair of kinds of body, in both orders: forces balance; shared fields are continuous and nothing else passes."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from scenes import pairs
from scenes.pairs import Pair

from harness.models.parts import Mixture, Param
from harness.post import compare
from studies.models.sheared_blocks import Kind

BODIES = ("lower", "upper")
SURFACES = ("lower-top", "upper-bottom")
PAIR = "lower/upper"
POROUS = {Kind.BIPHASIC, Kind.SOLUTE, Kind.TRIPHASIC, Kind.MULTIPHASIC}
ORDERS = [*((a, b, "lower") for a, b in itertools.product(Kind, Kind)), *((a, a, "upper") for a in Kind)]
"""The 21 unordered pairs, each with the one and with the other body's surface as primary."""
AREA = 1.0
"""mm^2."""
CONVERGED = 1e-6
"""Relative: what is left of the residual after Newton's method, which is quadratic."""
STEADY = 1e-6
"""Relative: what is left of the transient after ten steps of more than twice its slowest time."""
JUMP, JUMP_TWO_PASSES = 1e-4, 1e-3
"""Jump over the difference across the bodies: 1e-5 of the drop over the adjoining elements, by the default
penalty; with two passes 1e-3 of it."""
IMPERMEABLE = 1e-9
"""Flux through an impermeable contact over the one that the difference would drive."""


def shared_solutes(pair):
    lower, upper = ({solute.sol for solute in body.solutes} for body in (pair.lower, pair.upper))
    return lower & upper


def flows(run, surface):
    """Flows out of the body at the last time, solvent first, then solutes by their number: what, mm^3/s or nmol/s."""
    return dict(zip(run.model.surface_columns[3:], run.surface(surface).values[-1, 0, 3:], strict=True))


def upward_fluxes(run, name, body):
    """Fluxes along z in the elements of a porous body at the last time, shape (n_elements,), named as in `flows`.

    The flux of a solute is the one in FEBio's balance of multiphasic materials. It adds to the solute's own, j_k, the
    electric current SUM_l z_l j_l times the material's `penalty` (by default 1), which is FEBio's way to suppress the
    current. In biphasic-solute materials nothing is charged.
    """
    history = run.part(name)
    fluxes = {"contact solvent flow": history["wz"][-1]}
    own = [history[f"j{k + 1}z"][-1] for k in range(len(body.solutes))]
    charges = [run.model.charges[solute.sol - 1] for solute in body.solutes]
    current = sum(z * j for z, j in zip(charges, own, strict=True))
    for solute, flux in zip(body.solutes, own, strict=True):
        fluxes[f"contact solute flow {solute.sol}"] = flux + current
    return fluxes


def check_forces(run):
    below, above = (run.surface(surface).values[:, 0, :3] for surface in SURFACES)
    size = np.abs(below).max()
    assert np.all(below[1:, 2] < 0.0)
    assert np.abs(below + above).max() <= 1e-12 * size
    assert np.abs(below[:, :2]).max() <= 1e-12 * size
    return below[-1, 2]


def check_reaction(run, end, force):
    """The end of a deformable body is held by what the contact exerts on its other end."""
    reaction = run.nodes["Rz"][-1, run.model.mesh.node_sets[end] - 1].sum()
    assert abs(reaction) == pytest.approx(abs(force), rel=CONVERGED)


def shared_flows(pair):
    shared = {f"contact solute flow {sol}" for sol in shared_solutes(pair)}
    porous = isinstance(pair.lower, Mixture) and isinstance(pair.upper, Mixture)
    return shared | {"contact solvent flow"} if porous else shared


def check_fluxes(run, pair, shared=None):
    """The flow over the contact is the flux in each body; a field that is not shared stands still on either side."""
    below, above = (flows(run, surface) for surface in SURFACES)
    shared = shared_flows(pair) if shared is None else shared
    for what, flow in below.items():
        assert above[what] == pytest.approx(-flow, rel=1e-12, abs=0.0)
        assert (flow > 0.0) == (what in shared), what
        if what not in shared:
            assert flow == 0.0
    for name, body in zip(BODIES, (pair.lower, pair.upper), strict=True):
        if isinstance(body, Mixture):
            for what, flux in upward_fluxes(run, name, body).items():
                np.testing.assert_allclose(
                    flux * AREA, below[what], rtol=STEADY, atol=IMPERMEABLE * driven(what), err_msg=f"{name}: {what}"
                )


def driven(what):
    """Size of the flux (mm/s or nmol/(mm^2 s)) that the difference between the ends drives through one material."""
    if what == "contact solvent flow":
        return pairs.PERMEABILITY * pairs.PRESSURE / (2.0 * pairs.HEIGHT)
    return pairs.POROSITY * pairs.DIFFUSIVITY * (pairs.BELOW - pairs.ABOVE) / (2.0 * pairs.HEIGHT)


def check_jumps(run, pair, tolerance=JUMP):
    if isinstance(pair.lower, Mixture) and isinstance(pair.upper, Mixture):
        assert compare.jump(run, "p", PAIR) < tolerance * pairs.PRESSURE
    for sol in shared_solutes(pair):
        assert compare.jump(run, f"c{sol}", PAIR) < tolerance * (pairs.BELOW - pairs.ABOVE)


@pytest.mark.parametrize(("lower", "upper", "primary"), ORDERS)
def test_two_kinds_of_body(runner, lower, upper, primary):
    pair = pairs.of_kinds(lower, upper, primary)
    run = runner(pair.model())
    force = check_forces(run)
    for end, kind in (("bottom", lower), ("top", upper)):
        if kind is not Kind.RIGID:
            check_reaction(run, end, force)
    check_fluxes(run, pair)
    check_jumps(run, pair)
    assert (lower in POROUS and upper in POROUS) == ("traction, solvent" in run.log)


def test_two_rigid_bodies_press_with_penalty_times_overlap(runner):
    force = check_forces(runner(pairs.of_kinds(Kind.RIGID, Kind.RIGID).model()))
    assert -force == pytest.approx(pairs.RIGID_PENALTY * pairs.CLOSING * AREA, rel=1e-9)


A, B, C = 1, 2, 3
LISTS = [((A, B, C), (C, A)), ((C, A), (A, B, C))]


@pytest.mark.parametrize("two_pass", [False, True], ids=["one pass", "two passes"])
@pytest.mark.parametrize(("lower", "upper"), LISTS, ids=["ABC on CA", "CA on ABC"])
def test_solutes_in_another_order_and_one_that_one_side_lacks(runner, lower, upper, two_pass):
    """A is charged. A and C pass from body to body, B stays on its side."""
    pair = Pair(
        pairs.mixture(Kind.MULTIPHASIC, lower),
        pairs.mixture(Kind.MULTIPHASIC, upper),
        "multiphasic",
        f"solutes-{len(lower)}-on-{len(upper)}{'-two-pass' if two_pass else ''}",
        pairs.ContactSettings(two_pass=two_pass),
        charges=(1, 0, 0),
    )
    assert shared_solutes(pair) == {A, C}
    run = runner(pair.model())
    check_forces(run)
    check_fluxes(run, pair)
    check_jumps(run, pair, JUMP_TWO_PASSES if two_pass else JUMP)


def three_on_two(effects, name):
    """Solutes {1, 2, 3} on {3, 1}, all neutral, with the parameter <effects>."""
    settings = pairs.ContactSettings(extra=(Param("effects", effects),))
    bodies = (pairs.mixture(Kind.MULTIPHASIC, sols) for sols in LISTS[0])
    return Pair(*bodies, "multiphasic", name, settings, charges=(0, 0, 0))


CHOICES = {
    "traction": set(),
    "traction, solvent": {"contact solvent flow"},
    "traction, solvent , solute 1": {"contact solvent flow", "contact solute flow 1"},
    "traction, s3": {"contact solute flow 3"},
    "traction, solutes": {"contact solute flow 1", "contact solute flow 3"},
    "all": {"contact solvent flow", "contact solute flow 1", "contact solute flow 3"},
}


@pytest.mark.parametrize("effects", CHOICES)
def test_what_is_left_out_is_not_exchanged(runner, effects):
    pair = three_on_two(effects, f"effects-{list(CHOICES).index(effects)}")
    run = runner(pair.model())
    check_forces(run)
    check_fluxes(run, pair, CHOICES[effects])
    left_out = shared_flows(pair) - CHOICES[effects]
    assert run.log.count("<effects> omits it") == len(left_out)


@pytest.mark.parametrize(
    ("effects", "said"),
    [
        (
            "solvent, solute 2",
            '<effects> includes solute 2, which this contact cannot exchange: "upper-bottom" does not have it',
        ),
        ("s2", '<effects> includes s2, which this contact cannot exchange: "upper-bottom" does not have it'),
        (
            "solvent, salt",
            '<effects> names "salt"; allowed: "all", or some of the names traction, friction, solutes, solvent, '
            "solute 1 (s1)",
        ),
        ("solvent,,s1", '<effects> names ""; allowed'),
    ],
)
def test_what_cannot_be_exchanged_is_refused(runner, effects, said):
    run = runner(three_on_two(effects, "refused").model(), check=False)
    assert not run.report.normal
    assert run.report.steps == 0
    assert said in " ".join(run.report.errors)


def test_the_solvent_is_refused_where_one_side_is_impermeable(runner):
    pair = pairs.of_kinds(Kind.BIPHASIC, Kind.ELASTIC)
    settings = pairs.ContactSettings(extra=(Param("effects", "solvent"),))
    run = runner(replace(pair, settings=settings, name="refused-solvent").model(), check=False)
    assert not run.report.normal
    assert '"upper-bottom" is impermeable' in " ".join(run.report.errors)
