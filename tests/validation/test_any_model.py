"""Wherever a user puts a contact: penalties that give way, rigid pairs, steps, modules, shells."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from scenes.tied_columns import steps

from studies.models import small
from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed, moved, rigid, step

pytestmark = pytest.mark.mixture_only

RAMP = curve(1, (0, 0), (1, 1))
EQUAL = 1e-9
"""mm. What is left between runs of the same problem: FEBio logs a dozen digits."""


def displacements(folder):
    """ux, uy, uz at the end, shape (nodes, 3)."""
    return small.table(folder / "nodes.txt")[-1]


# ------------------------------------------------------------ penalties that give way


def overlapping(params: str = "", overlap: float = 0.6, steps: int = 2) -> Document:
    """A stiff block that begins deep in a soft one, over all of its upper side."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (6, 6, 6), "soft")
    parts.box("up", (-0.2, -0.2, 1 - overlap), (1.2, 1.2, 1.6 - overlap), (2, 2, 2), "hard")
    return Document(
        parts.mesh({"pair": ("low-top", "up-bottom")}),
        (elastic("soft", 1, 1, 0.3), elastic("hard", 2, 100, 0.3)),
        control=control("solid", steps, 0.5, retries=5),
        boundary=(fixed("low-bottom", "x", "y", "z"), fixed("up-top", "x", "y", "z")),
        contacts=(contact("c", "pair", params=params),),
    )


FACTOR = "<auto_penalty>1</auto_penalty><penalty>1000</penalty>"
"""The default, set by the user."""


def test_an_automatic_penalty_gives_way_where_a_step_fails_and_one_that_is_given_does_not(solve):
    _, soft = solve("automatic", overlapping())
    assert soft.output.count("divides automatic penalties of the traction by up to 1000") == 1
    assert re.search(r"largest overlap of an accepted step was \S+, which is \S+ of an element's edge", soft.output)
    _, hard = solve("given", overlapping(FACTOR), ends=False)
    assert not hard.report.normal
    assert "divides automatic penalties" not in hard.output


def test_a_penalty_that_gave_way_recovers(solve):
    """In the end the answer is that of the full penalty, which a load curve lets begin at the stiffness of the body."""
    folder, found = solve("recovered", overlapping(steps=8))
    assert found.report.retries > 0
    assert "still divided" not in found.output
    ramp = "<auto_penalty>1</auto_penalty><penalty lc='1'>1</penalty>"
    document = overlapping(ramp, steps=8)
    document.curves = (curve(1, (0.5, 1), (1, 10), (1.5, 100), (2, 1000)),)
    expected, raised = solve("ramp", document)
    assert raised.report.retries == 0
    np.testing.assert_allclose(displacements(folder), displacements(expected), atol=1e-4 * 0.3)
    soft, _ = solve("soft", overlapping("<auto_penalty>1</auto_penalty><penalty>100</penalty>", overlap=0.1))
    hard, _ = solve("hard", overlapping(FACTOR, overlap=0.1))
    assert np.abs(displacements(soft) - displacements(hard)).max() > 1e-4 * 0.3


def test_where_no_step_fails_nothing_gives_way(solve):
    automatic, found = solve("automatic", overlapping(overlap=0.1))
    given, _ = solve("given", overlapping(FACTOR, overlap=0.1))
    assert found.report.retries == 0
    assert (automatic / "nodes.txt").read_text() == (given / "nodes.txt").read_text()


def test_bodies_that_overlap_deeply_at_the_start_are_not_thrown_apart(solve):
    _, found = solve("deep", overlapping(FACTOR, overlap=0.3))
    assert found.report.retries == 0


# ------------------------------------------------------------ materials that contract

CONTRACTS = (
    '<material id="1" name="muscle" type="trans iso Mooney-Rivlin"><density>1</density><c1>0.05</c1><c2>0</c2>'
    "<k>50</k><c3>0.01</c3><c4>20</c4><c5>1</c5><lam_max>1.2</lam_max>"
    '<fiber type="vector"><vector>1,0,0</vector></fiber><active_contraction type="active_contraction">'
    "<ascl>1</ascl><Tmax>0.3</Tmax><ca0>4.35</ca0><camax>4.35</camax><beta>10</beta><l0>1.58</l0><refl>2.04</refl>"
    "</active_contraction></material>"
)
"""Fibres along x are near saturation: their contraction, which shortening hardly changes, exceeds the stiffness."""


def test_a_material_that_contracts_in_the_undeformed_state_has_a_penalty(solve):
    """Its elasticity is not positive definite there."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (3, 3, 3), "muscle")
    parts.box("up", (-0.2, -0.2, 0.99), (1.2, 1.2, 1.6), (2, 2, 1), "hard")
    document = Document(
        parts.mesh({"pair": ("low-top", "up-bottom")}),
        (CONTRACTS, elastic("hard", 2, 100, 0.3)),
        control=control("solid", 2, 0.1, retries=2),
        boundary=(*(fixed(f"low-{side}") for side in ("bottom", "left", "right")), fixed("up-top")),
        contacts=(contact("c", "pair"),),
    )
    _, found = solve("muscle", document)
    assert found.report.steps == 2


# ------------------------------------------------------------ two rigid bodies

ALL = "<Rx_dof>1</Rx_dof><Ry_dof>1</Ry_dof><Rz_dof>1</Rz_dof><Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof><Rw_dof>1</Rw_dof>"


def rigid_pair(properties: str = "", params: str = "") -> Document:
    """A rigid block pushed 0.01 mm into another."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (2, 2, 1), (2, 2, 1), "one")
    parts.box("up", (0.5, 0.5, 1.1), (1.5, 1.5, 2), (2, 2, 1), "two")
    free = ALL.replace("<Rz_dof>1</Rz_dof>", "")
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (rigid("one", 1, properties), rigid("two", 2, properties)),
        control=control("solid", 2, 0.5, retries=2),
        rigid=(
            f'<rigid_bc type="rigid_fixed"><rb>one</rb>{ALL}</rigid_bc>',
            f'<rigid_bc type="rigid_fixed"><rb>two</rb>{free}</rigid_bc>',
            '<rigid_bc type="rigid_displacement"><rb>two</rb><dof>z</dof><value lc="1">-0.11</value></rigid_bc>',
        ),
        contacts=(contact("c", "pair", params=params),),
        curves=(RAMP,),
        rigid_data={2: "Fz"},
    )


def test_two_rigid_bodies_take_their_penalty_from_the_modulus_of_their_materials(solve):
    """A block over 1 mm^2, overlapping by 0.01 mm: in series k = 2/(1/(E/0.9) + 1/E) over the thicknesses 0.9 and 1."""
    folder, found = solve("rigid", rigid_pair("<E>100</E><v>0.3</v>"))
    assert "both surfaces are rigid. The automatic penalty uses a modulus of 109.89" in found.output
    modulus = 100 / (1 - 0.3**2)
    expected = 1000 * 2 / (0.9 / modulus + 1 / modulus) * 0.01
    force = small.table(folder / "rigid-2.txt")[-1, 0, 0]
    np.testing.assert_allclose(abs(force), expected, rtol=1e-6)


def test_rigid_bodies_without_a_modulus_say_what_to_do(solve):
    _, found = solve("rigid", rigid_pair("<E>0</E>"), ends=False)
    assert not found.report.normal
    assert "no material has a modulus" in " ".join(found.report.errors)


# ------------------------------------------------------------ contacts that begin and end with a step


def biphasic_steps(active: set[int], steps: int) -> Document:
    """A porous block pressed on a porous slab in the first second, which is squeezed from one side in the second."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (2, 1, 1), (4, 2, 2), "one")
    parts.box("up", (0, 0, 1), (1, 1, 2), (2, 2, 2), "two")
    in_step = {n: f"<Contact>{contact('c', 'pair')}</Contact>" if n in active else "" for n in range(1, steps + 1)}
    return Document(
        parts.mesh({"pair": ("low-top", "up-bottom")}),
        (small.biphasic("one", 1), small.biphasic("two", 2)),
        module="biphasic",
        boundary=(
            fixed("low-bottom", "x", "y", "z"),
            '<bc type="zero fluid pressure" node_set="low-bottom"></bc>',
            fixed("up-top", "x", "y"),
            moved("up-top", "z", -0.1),
            moved("low-left", "x", 0.05, 2),
        ),
        steps=[step(n, control("biphasic", 4, 0.25, analysis="TRANSIENT") + inner) for n, inner in in_step.items()],
        curves=(curve(1, (0, 0), (1, 1), (2, 1)), curve(2, (0, 0), (1, 0), (2, 1))),
        node_data="p",
    )


def pressure_beside_contact(folder):
    """The largest pressure on the slab's surface beside the block, at each time."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (2, 1, 1), (4, 2, 2), "one")
    beside = [n - 1 for n in parts.node_sets["low-top"] if parts.nodes[n - 1][0] > 1.4]
    return small.table(folder / "nodes.txt")[:, beside, 0].max(axis=1)


def test_the_nodes_of_a_contact_that_has_ended_are_free(solve):
    """Beside contact the pressure is the ambient one; after the contact's step the slab is impermeable there."""
    always = pressure_beside_contact(solve("always", biphasic_steps({1, 2}, 2))[0])
    assert np.all(always == 0.0)
    ended = pressure_beside_contact(solve("ended", biphasic_steps({1}, 2))[0])
    assert np.all(ended[:5] == 0.0)
    assert np.all(ended[5:] > 0.01)
    again = pressure_beside_contact(solve("again", biphasic_steps({1, 3}, 3))[0])
    assert np.all(again[5:9] > 0.01)
    assert np.all(again[9:] == 0.0)


# ------------------------------------------------------------ modules

LIGHT = "<density>1e-12</density>"
SOLUTE = (
    "<solute id='1' name='s1'><charge_number>0</charge_number><molar_mass>1</molar_mass><density>1</density></solute>"
)


def pressed(module: str, analysis: str = "STATIC") -> Document:
    """Two elastic blocks without inertia, one pressed into the other."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (2, 2, 2), "one")
    parts.box("up", (0, 0, 1.01), (1, 1, 2), (3, 3, 2), "two")
    materials = [elastic(name, n).replace("<density>1</density>", LIGHT) for n, name in enumerate(("one", "two"), 1)]
    return Document(
        parts.mesh({"pair": ("low-top", "up-bottom")}),
        materials,
        module=module,
        control=control(module, 4, 0.25, analysis=analysis),
        boundary=(fixed("low-bottom", "x", "y", "z"), fixed("up-top", "x", "y"), moved("up-top", "z", -0.06)),
        contacts=(contact("c", "pair"),),
        curves=(RAMP,),
        globals=f"<Solutes>{SOLUTE}</Solutes>" if module in ("solute", "multiphasic", "multiphasic-FSI") else "",
    )


@pytest.mark.parametrize(
    ("module", "analysis"),
    [
        ("biphasic", "TRANSIENT"),
        ("solute", "TRANSIENT"),
        ("multiphasic", "TRANSIENT"),
        ("fluid-FSI", "DYNAMIC"),
        ("multiphasic-FSI", "DYNAMIC"),
    ],
)
def test_every_module_whose_nodes_move_transmits_traction(solve, module, analysis):
    expected, _ = solve("solid", pressed("solid"))
    found, run = solve("other", pressed(module, analysis))
    assert "exchanges traction." in run.output
    np.testing.assert_allclose(displacements(found), displacements(expected), atol=1e-5 * 0.06)


# ------------------------------------------------------------ self-contact


def slotted(pair: tuple[str, str], params: str = "") -> Document:
    """A block with a slot whose upper arm is pressed down until the slot closes at its mouth."""
    parts = small.slotted_block("soft")
    return Document(
        parts.mesh({"pair": pair}),
        (elastic("soft", 1, 1, 0.3),),
        control=control("solid", 5, 0.2, retries=5),
        boundary=(fixed("bottom", "x", "y", "z"), moved("tip", "z", -0.35)),
        contacts=(contact("c", "pair", params=params),),
        curves=(RAMP,),
    )


def test_a_surface_in_contact_with_itself_does_what_two_passes_do(solve):
    expected = displacements(solve("pair", slotted(("lower", "upper"), "<two_pass>1</two_pass>"))[0])
    apart = displacements(solve("none", slotted(("lower", "upper"), "<penalty>0</penalty>"))[0])
    itself = displacements(solve("itself", slotted(("slot", "slot")))[0])
    assert np.abs(apart - expected).max() > 0.05
    np.testing.assert_allclose(itself, expected, atol=EQUAL)


@pytest.mark.parametrize("pair", [("outer", "outer"), ("slot", "outer"), ("lower", "outer")])
def test_surfaces_that_share_facets_with_all_sides_of_a_body_hold_it_apart(solve, pair):
    """The whole outside of the body: its far sides are not taken for an overlap.

    Gaps at the edges of the slot are means over the facets around it, so that the answer is near that of the slot.
    """
    expected = displacements(solve("pair", slotted(("lower", "upper"), "<two_pass>1</two_pass>"))[0])
    folder, found = solve("all", slotted(pair))
    assert found.report.retries == 0
    np.testing.assert_allclose(displacements(folder), expected, atol=2e-3 * 0.35)


def test_self_contact_has_no_room_for_multipliers(solve):
    _, found = solve("lagmult", slotted(("outer", "outer"), "<laugon>LAGMULT</laugon>"), ends=False)
    assert "the sides can meet only half of these" in " ".join(found.report.errors)


def test_facets_within_a_body_are_no_self_contact(solve):
    document = slotted(("lower", "lower"))
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (1, 1, 1), "soft")
    parts.box("block", (0, 0, 0), (1, 1, 2), (1, 1, 2), "soft")
    parts.parts.pop(0)
    parts.surfaces = {"inner": [tuple(sorted(n for n, x in enumerate(parts.nodes, 1) if x[2] == 1.0 and n > 8))]}
    a, b, c, d = parts.surfaces["inner"][0]
    parts.surfaces["inner"] = [(a, b, d, c)]
    parts.node_sets = {"bottom": [9], "tip": [10]}
    document.mesh = parts.mesh({"pair": ("inner", "inner")})
    _, found = solve("inner", document, ends=False)
    assert "lies inside a body" in " ".join(found.report.errors)


# ------------------------------------------------------------ shells

THICKNESS = 0.2


def under_plate(*, faces_up: bool, primary: bool = False, is_rigid: bool = False) -> Document:
    """A block that is pushed up against a plate of shells which is held at its far face; the plate's nodes lie on its
    upper face or, turned round, on the lower one, which meets the block.
    """
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (2, 2, 2), "one")
    level = 1.01 + (THICKNESS if faces_up else 0.0)
    parts.plate("plate", "two", level, THICKNESS, faces_up=faces_up)
    far = (
        fixed("plate", "x", "y", "z")
        if faces_up
        else '<bc type="zero shell displacement" node_set="plate">'
        "<sx_dof>1</sx_dof><sy_dof>1</sy_dof><sz_dof>1</sz_dof></bc>"
    )
    side = "primary" if primary else "secondary"
    bottom = f"<shell_bottom_{side}>1</shell_bottom_{side}>" if faces_up else ""
    return Document(
        parts.mesh({"pair": ("plate", "low-top") if primary else ("low-top", "plate")}),
        (elastic("one", 1), rigid("two", 2) if is_rigid else elastic("two", 2)),
        control=control("solid", 4, 0.25),
        boundary=(fixed("low-bottom", "x", "y"), moved("low-bottom", "z", 0.06), *(() if is_rigid else (far,))),
        rigid=(f'<rigid_bc type="rigid_fixed"><rb>two</rb>{ALL}</rigid_bc>',) if is_rigid else (),
        contacts=(contact("c", "pair", params=bottom),),
        curves=(RAMP,),
        surface_data={"low-top": "contact_force.z"},
    )


def under_solid_plate() -> Document:
    """The same with a layer of solid elements for the shells."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (2, 2, 2), "one")
    parts.box("plate", (0, 0, 1.01), (1, 1, 1.01 + THICKNESS), (3, 3, 1), "two")
    return Document(
        parts.mesh({"pair": ("low-top", "plate-bottom")}),
        (elastic("one", 1), elastic("two", 2)),
        control=control("solid", 4, 0.25),
        boundary=(fixed("low-bottom", "x", "y"), moved("low-bottom", "z", 0.06), fixed("plate-top", "x", "y", "z")),
        contacts=(contact("c", "pair"),),
        curves=(RAMP,),
        surface_data={"low-top": "contact_force.z"},
    )


def block_force(folder):
    """The contact force on the block at each time."""
    return small.table(folder / "surface-low-top.txt")[:, 0, 0]


@pytest.mark.parametrize("faces_up", [True, False], ids=["back face", "front face"])
@pytest.mark.parametrize("primary", [True, False], ids=["primary", "secondary"])
def test_a_plate_of_shells_is_a_layer_of_its_thickness(solve, faces_up, primary):
    shells, _ = solve("shells", under_plate(faces_up=faces_up, primary=primary))
    solids, _ = solve("solids", under_solid_plate())
    assert abs(block_force(solids)[-1]) > 0.04
    np.testing.assert_allclose(block_force(shells), block_force(solids), rtol=1e-6, atol=1e-12)


def test_both_faces_of_rigid_shells_are_hard(solve):
    back, _ = solve("back", under_plate(faces_up=True, is_rigid=True))
    front, _ = solve("front", under_plate(faces_up=False, is_rigid=True))
    assert abs(block_force(front)[-1]) > 0.05
    np.testing.assert_allclose(block_force(back), block_force(front), rtol=1e-9, atol=1e-12)


def test_friction_turns_rigid_shells_about_the_face_that_it_acts_on(solve):
    def reaction(name: str, *, faces_up: bool):
        document = under_plate(faces_up=faces_up, is_rigid=True)
        bottom = "<shell_bottom_secondary>1</shell_bottom_secondary>" if faces_up else ""
        document.contacts = (contact("c", "pair", params=f"<fric_coeff>0.3</fric_coeff>{bottom}"),)
        rubs = (fixed("low-bottom", "y"), moved("low-bottom", "x", 0.05), moved("low-bottom", "z", 0.06))
        document.boundary = rubs
        document.rigid_data = {2: "Fx;Fz;Mx;My;Mz"}
        folder, _ = solve(name, document)
        return small.table(folder / "rigid-2.txt")[-1, 0]

    back, front = reaction("back", faces_up=True), reaction("front", faces_up=False)
    assert abs(front[0]) * THICKNESS > 1e-3 * abs(front[3])
    np.testing.assert_allclose(back, front, rtol=1e-6, atol=1e-9)


def test_the_back_face_of_a_solid_is_an_error(solve):
    document = under_solid_plate()
    document.contacts = (contact("c", "pair", params="<shell_bottom_secondary>1</shell_bottom_secondary>"),)
    _, found = solve("solid", document, ends=False)
    assert "<shell_bottom_secondary> is set, but element" in " ".join(found.report.errors)


# ------------------------------------------------------------ tension


def drawn(kind: str, params: str) -> Document:
    """Two blocks that touch, drawn apart by their ends."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (2, 2, 2), "one")
    parts.box("up", (0, 0, 1), (1, 1, 2), (2, 2, 2), "two")
    return Document(
        parts.mesh({"pair": ("low-top", "up-bottom")}),
        (elastic("one", 1, 1, 0.3), elastic("two", 2, 2, 0.3)),
        control=control("solid", 4, 0.25),
        boundary=(fixed("low-bottom", "x", "y", "z"), fixed("up-top", "x", "y"), moved("up-top", "z", 0.1)),
        contacts=(contact("c", "pair", kind, f"<tension>1</tension><penalty>100</penalty>{params}"),),
        curves=(RAMP,),
    )


def test_tension_is_that_of_sliding_elastic(solve):
    """At equal penalties, 100 MPa/mm: where it is uniform, the gap of either is t/eps, and where meshes match, so are
    its means around nodes.
    """
    own = displacements(solve("own", drawn("sliding-mixture", "<integration>gauss</integration>"))[0])
    febio = displacements(solve("febio", drawn("sliding-elastic", "<search_radius>1</search_radius>"))[0])
    free = displacements(solve("free", drawn("sliding-mixture", "").text().replace("<tension>1</tension>", ""))[0])
    assert np.abs(free - febio).max() > 0.02
    np.testing.assert_allclose(own, febio, atol=0.01 * 0.1)


@pytest.mark.parametrize("integration", ["", "<integration>gauss</integration>"], ids=["default", "gauss"])
def test_uniform_tension_is_that_of_sliding_elastic_to_rounding(solve, integration):
    """Without Poisson's effect, traction and gap are uniform."""
    found = []
    for kind, params in (("sliding-mixture", integration), ("sliding-elastic", "<search_radius>1</search_radius>")):
        blocks = (elastic("one", 1, 1, 0.0), elastic("two", 2, 2, 0.0))
        uniform = replace(drawn(kind, params), materials=blocks, control=steps("solid", 4, 0.25))
        found.append(displacements(solve(kind, uniform)[0]))
    assert np.abs(found[1]).max() == pytest.approx(0.1)
    assert np.abs(found[0] - found[1]).max() <= 1e-8 * 0.1
