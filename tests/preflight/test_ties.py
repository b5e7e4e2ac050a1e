"""`check` and `convert` on ties: what would not be tied or is held twice, and what becomes of FEBio's types."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from scenes.tied_cubes import joint

from harness.conversion.convert import convert
from harness.conversion.fates import Action
from harness.conversion.tied_contacts import DROPPED
from harness.errors import ModelError
from harness.preflight.check import check
from harness.preflight.contact_types import ANY_DISTANCE, CONVERTIBLE_TIES, STICKY, TIED_TYPES
from harness.preflight.finding import Severity
from studies.models.small import Document, biphasic, contact, elastic, fixed, rigid


def porous(document: Document) -> Document:
    """The same of bodies with fluid."""
    return replace(document, module="biphasic", materials=(biphasic("low", 1), biphasic("up", 2)))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "model.feb"


def found(path, document):
    path.write_text(document.text())
    return [(finding.severity, finding.rule) for finding in check(path)]


# ---- check ----


def test_a_sound_tie_has_no_findings(path):
    assert found(path, joint()) == []


@pytest.mark.parametrize("kind", TIED_TYPES)
def test_all_types_of_ties_are_looked_at(path, kind):
    assert (Severity.ERROR, "unknown-parameter") in found(path, joint("<glue>1</glue>", kind=kind))


def test_surfaces_that_are_too_far_apart_are_named_with_their_distance(path):
    assert found(path, joint(gap=0.2)) == [(Severity.ERROR, "untied")]
    assert "up to 0.2" in check(path)[0].message
    assert found(path, joint("<search_radius>0.25</search_radius>", gap=0.2)) == []


def test_facets_that_are_too_far_away_are_a_warning(path):
    path.write_text(re.sub(r'(<node id="\d+">1,\S+),1\.05</node>', r"\1,1.2</node>", joint(gap=0.05).text()))
    assert [(each.severity, each.rule) for each in check(path)] == [(Severity.WARNING, "untied")]


def test_nodes_with_prescribed_displacements_are_spoken_of(path):
    document = joint()
    held = replace(document, boundary=(*document.boundary, fixed("up-left", "x")))
    assert found(path, held) == [(Severity.NOTE, "held-nodes")]
    assert "4 of 16" in check(path)[0].message


def test_nodes_of_two_ties_with_multipliers_are_a_warning(path):
    document = joint()
    twice = tuple(contact(name, "pair", "tied-mixture", "<laugon>LAGMULT</laugon>") for name in ("one", "two"))
    assert set(found(path, replace(document, contacts=twice))) == {(Severity.WARNING, "held-twice")}


@pytest.mark.parametrize(("cells", "rules"), [((2, 3), ["rigid-primary"]), ((3, 2), [])])
def test_a_fine_rigid_primary_surface_is_a_warning(path, cells, rules):
    document = replace(joint(cells=cells), materials=(elastic("low", 1), rigid("up", 2)), boundary=())
    assert [rule for _, rule in found(path, document)] == rules


def test_facets_in_common_are_an_error(path):
    text = joint().text().replace("<secondary>low-top</secondary>", "<secondary>up-bottom</secondary>")
    path.write_text(text)
    assert "shared-facets" in {finding.rule for finding in check(path)}


@pytest.mark.parametrize(
    ("solver", "params", "rules"),
    [
        ("skyline", "<laugon>LAGMULT</laugon>", []),
        ("cg", "", ["linear-solver"]),
        ("cg", "<penalty>1000</penalty><auto_penalty>1</auto_penalty>", []),
        ("cg", "<penalty>1000</penalty><laugon>LAGMULT</laugon>", ["linear-solver"]),
    ],
)
def test_linear_solvers_that_may_fail_are_a_warning(path, solver, params, rules):
    chosen = f'<Control><solver><linear_solver type="{solver}"/></solver></Control>'
    path.write_text(joint(params).text().replace("<Globals>", f"{chosen}<Globals>"))
    assert [finding.rule for finding in check(path)] == rules


WEAK, TOUGH = "<max_traction>0.08</max_traction>", "<fracture_energy>0.05</fracture_energy>"
SOFT = "<max_traction>1</max_traction><fracture_energy>0.01</fracture_energy>"


@pytest.mark.parametrize(
    ("params", "rules"),
    [
        (WEAK + TOUGH, []),
        ("<max_traction>10</max_traction>", []),
        ("<max_traction>1</max_traction>" + TOUGH, ["cohesive-zone"]),
        (f"{WEAK}<max_shear>1</max_shear>{TOUGH}", ["cohesive-zone"]),
        (f"{SOFT}<penalty>49</penalty>", ["soft-bonds", "cohesive-zone"]),
        (f"{SOFT}<penalty>51</penalty>", ["cohesive-zone"]),
        (f"{SOFT}<penalty>40</penalty><auto_penalty>1</auto_penalty>", ["soft-bonds", "cohesive-zone"]),
        (f"{SOFT}<penalty>60</penalty><auto_penalty>1</auto_penalty>", ["cohesive-zone"]),
        ("<max_traction>1</max_traction><fracture_energy>0.009</fracture_energy>", ["soft-bonds", "cohesive-zone"]),
    ],
)
def test_bonds_that_cannot_soften_or_in_too_few_facets_are_named(path, params, rules):
    assert [rule for _, rule in found(path, joint(params))] == rules


@pytest.mark.parametrize(("strength", "modulus"), [(0.3, 1.0), (1.0, 0.1)])
def test_the_zone_is_the_shorter_of_those_of_a_thick_body_and_of_a_layer(path, strength, modulus):
    params = f"<max_traction>{strength}</max_traction>{TOUGH}<penalty>1e3</penalty>"
    document = replace(joint(params), materials=(elastic("low", 1, modulus), elastic("up", 2, modulus)))
    assert found(path, document) == [(Severity.WARNING, "cohesive-zone")]
    thick = modulus * 0.05 / strength**2
    thin = (thick / 6.0) ** 0.25
    assert f"about {min(thick, thin):.2g}," in check(path)[0].message


# ---- convert ----


def converted(path, document):
    path.write_text(document.text())
    made = convert(path)
    changes = {change.name: change for change in made.changes['contact "tie"']}
    return made.data.decode(), changes


@pytest.mark.parametrize("kind", CONVERTIBLE_TIES)
def test_every_type_becomes_a_tie_with_its_penalties(path, kind):
    new, changes = converted(path, porous(joint("<minaug>1</minaug>", kind=kind)))
    assert 'type="tied-mixture"' in new
    assert "<penalty>1</penalty>" in new
    assert ("<pressure_penalty>1</pressure_penalty>" in new) == TIED_TYPES[kind].solvent
    assert ("<effects>traction</effects>" in new) == (not TIED_TYPES[kind].solvent)
    assert changes["minaug"].action is Action.KEPT
    assert [finding.rule for finding in check(_written(path, new))] == []


def _written(path, text):
    path.write_text(text)
    return path


@pytest.mark.parametrize("kind", CONVERTIBLE_TIES)
def test_every_parameter_has_a_fate(path, kind):
    values = {"laugon": "AUGLAG", "minaug": "1", "maxaug": "5", "search_radius": "1", "offset_shells": "0"}
    values |= dict.fromkeys(("flip_primary", "flip_secondary"), "0")
    params = "".join(f"<{name}>{values.get(name, '1')}</{name}>" for name in sorted(TIED_TYPES[kind].parameters))
    _, changes = converted(path, joint(params, kind=kind))
    assert TIED_TYPES[kind].parameters <= set(changes)
    dropped = {name for name, change in changes.items() if change.action is Action.DROPPED}
    own = {"flip_secondary"} if kind == STICKY else set()
    assert dropped == (DROPPED.keys() & TIED_TYPES[kind].parameters) | own


def test_negative_tolerances_are_none(path):
    new, changes = converted(path, joint("<gaptol>-1</gaptol>", kind="tied-elastic"))
    assert "gaptol" not in new
    assert changes["gaptol"].action is Action.DROPPED


def test_the_largest_distance_becomes_the_search_radius(path):
    new, _ = converted(path, joint("<max_distance>0.3</max_distance>", kind="tied-node-on-facet"))
    assert "<search_radius>0.3</search_radius>" in new
    assert "max_distance" not in new


def test_a_search_without_limit_stays_one(path):
    params = "<gap_offset>1</gap_offset>"
    new, _ = converted(path, joint(params, kind="tied-facet-on-facet", gap=0.2))
    assert "<search_radius>0.22</search_radius>" in new


@pytest.mark.parametrize("kind", [kind for kind in ANY_DISTANCE if kind != STICKY])
def test_a_gap_that_the_type_would_close_under_stress_is_named_and_kept(path, kind):
    new, changes = converted(path, joint(kind=kind, gap=0.02))
    assert "up to 0.02 apart" in changes["gap"].reason
    assert "<search_radius>0.022</search_radius>" in new
    assert "gap" not in converted(path, joint(kind=kind))[1]


def on_shells(kind: str) -> str:
    """The same with the lower body a sheet of shells, which looks away."""
    text = joint(kind=kind).text()
    face = re.search(r'<Surface name="low-top">.*?</Surface>', text, re.DOTALL)
    rows = [row.split(",") for row in re.findall(r"<quad4[^>]*>([^<]*)<", face.group())]
    turned = [",".join(reversed(row)) for row in rows]
    sheet = "".join(f'<elem id="{900 + n}">{row}</elem>' for n, row in enumerate(turned))
    looking = "".join(f'<quad4 id="{n}">{row}</quad4>' for n, row in enumerate(turned, 1))
    text = text.replace(face.group(), f'<Surface name="low-top">{looking}</Surface>')
    return re.sub(
        r'<Elements [^>]*name="low">.*?</Elements>',
        f'<Elements type="quad4" name="low">{sheet}</Elements>',
        text,
        count=1,
        flags=re.DOTALL,
    )


@pytest.mark.parametrize("kind", ANY_DISTANCE)
def test_shells_that_look_away_are_turned_round(path, kind):
    path.write_text(on_shells(kind))
    new = convert(path).data.decode()
    assert "<flip_secondary>1</flip_secondary>" in new
    assert "flip_primary" not in new


def test_shells_that_look_away_are_not_tied(path):
    path.write_text(on_shells("tied-mixture"))
    errors = [each for each in check(path) if each.severity is Severity.ERROR]
    assert [(each.rule, each.suggestion) for each in errors] == [("untied", "Set <flip_secondary>1</flip_secondary>.")]


def test_a_gap_that_nodes_close_without_stress_stays_so(path):
    new, _ = converted(path, joint("<node_reloc>1</node_reloc>", kind="tied-node-on-facet", gap=0.02))
    assert "<node_reloc>1</node_reloc>" in new


def test_sticky_stays_where_nodes_come_to_touch_in_the_run(path):
    document = joint(kind="sticky", gap=0.05)
    path.write_text(document.text())
    with pytest.raises(ModelError, match="sticky ties nodes when they come to touch"):
        convert(path)
    both = replace(document, contacts=(*document.contacts, contact("other", "pair", "tied-elastic")))
    new, changes = converted(path, both)
    assert changes["type"].reason.startswith("stays: sticky ties nodes when")
    assert 'type="sticky"' in new


@pytest.mark.parametrize("reach", ["snap_tol", "gap_offset"])
def test_sticky_that_reaches_over_its_gap_becomes_a_tie(path, reach):
    new, _ = converted(path, joint(f"<{reach}>0.05001</{reach}>", kind="sticky", gap=0.05))
    assert 'type="tied-mixture"' in new
    assert "<search_radius>0.055</search_radius>" in new


def test_sticky_breaks_by_tension_alone(path):
    new, changes = converted(path, joint("<max_traction>0.5</max_traction>", kind="sticky"))
    assert "<max_traction>0.5</max_traction>" in new
    assert "<max_shear>500000</max_shear>" in new
    assert "broken nodes are in sliding contact" in changes["max_traction"].reason
    new, changes = converted(path, joint("<max_traction>0</max_traction>", kind="sticky"))
    assert "max_traction" not in new
    assert changes["max_traction"].action is Action.DROPPED


def test_sticky_of_a_later_step_stays(path):
    document = joint(kind="sticky")
    steps = "".join(f"<step id='{n}'>{inner}</step>" for n, inner in ((1, ""), (2, "".join(document.contacts))))
    text = replace(document, contacts=()).text().replace("<Output>", f"<Step>{steps}</Step><Output>")
    text = text.replace(document.contacts[0], f"<Contact>{document.contacts[0]}</Contact>")
    path.write_text(text)
    with pytest.raises(ModelError, match="later analysis step"):
        convert(path)


@pytest.mark.parametrize("kind", CONVERTIBLE_TIES)
def test_what_stays_of_a_type_is_a_parameter_of_ties(kind):
    assert TIED_TYPES[kind].parameters - DROPPED.keys() - {"max_distance"} <= TIED_TYPES["tied-mixture"].parameters
