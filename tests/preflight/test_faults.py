"""Every rule finds the fault that is seeded for it, and names a place and a cure."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from scenes.ambient import Apart
from scenes.tied_cubes import joint

from harness.errors import ModelError
from harness.models.diffusion import Diffusion
from harness.models.interface import PAPER, ContactSettings, InterfaceType, augmented, automatic
from harness.models.mesh import Box, assemble
from harness.models.parts import Control, Curve, Param, fluid_flux, pressure
from harness.paths import DOCS, REPOSITORY
from harness.preflight.finding import Severity
from studies.models.small import contact

PREFLIGHT = REPOSITORY / "scripts" / "harness" / "preflight"
CONTACT = re.compile(r"<contact( [^>]*?)/?>(?:.*?</contact>)?", re.DOTALL)

BONDS = "<max_traction>1</max_traction><fracture_energy>0.05</fracture_energy>"


def diffusion(interface=InterfaceType.MIXTURE, settings=None, **more):
    return Diffusion(interface, settings, elements=5, **more).model()


def with_params(*params, interface=InterfaceType.MIXTURE):
    return diffusion(interface, ContactSettings(extra=params))


def with_surfaces(model, **surfaces):
    """The model with other facets in its surfaces; the keywords have _ for -."""
    changed = {name.replace("_", "-"): facets for name, facets in surfaces.items()}
    return replace(model, mesh=replace(model.mesh, surfaces=model.mesh.surfaces | changed))


def facets(model, name):
    return model.mesh.surfaces[name]


def side_face(model, part):
    """The facets of a part in the plane x = 1."""
    quads = [[int(e[k]) for k in (1, 2, 6, 5)] for e in model.mesh.parts[part].elements]
    return np.array(quads)


def moved(model, part, shift):
    """The model with one body moved."""
    points = model.mesh.nodes.copy()
    points[np.unique(model.mesh.parts[part].elements) - 1] += shift
    return replace(model, mesh=replace(model.mesh, nodes=points))


def tied_twice():
    """Two cubes with two ties of the same surfaces."""
    ties = tuple(contact(name, "pair", "tied-mixture", "<laugon>LAGMULT</laugon>") for name in ("one", "two"))
    return replace(joint(), contacts=ties).text()


def turned():
    model = diffusion()
    return with_surfaces(model, lower_top=facets(model, "lower-top")[:, ::-1])


def far_side():
    model = diffusion()
    return with_surfaces(model, upper_bottom=facets(model, "upper-top"))


def with_sides():
    model = diffusion()
    return with_surfaces(model, lower_top=np.concatenate([facets(model, "lower-top"), side_face(model, 0)]))


def with_far_side():
    model = diffusion()
    return with_surfaces(model, lower_top=np.concatenate([facets(model, "lower-top"), facets(model, "lower-bottom")]))


def no_face():
    model = diffusion()
    broken = facets(model, "lower-top").copy()
    broken[0, 0] = 1
    return with_surfaces(model, lower_top=broken)


def inner():
    model = diffusion()
    top = model.mesh.parts[0].elements[0][4:8]
    return with_surfaces(model, lower_top=top[None, :])


def merged():
    """Both halves of the contact on one set of nodes."""
    model = diffusion()
    one, two = facets(model, "lower-top"), facets(model, "upper-bottom")
    order = {int(b): int(a) for a, b in zip(np.sort(one.ravel()), np.sort(two.ravel()), strict=True)}
    swap = np.vectorize(lambda node: order.get(int(node), int(node)))
    parts = tuple(replace(part, elements=swap(part.elements)) for part in model.mesh.parts)
    surfaces = {name: swap(rows) for name, rows in model.mesh.surfaces.items()}
    return replace(model, mesh=replace(model.mesh, parts=parts, surfaces=surfaces))


def corner():
    """Surfaces that share an edge."""
    model = diffusion()
    return with_surfaces(model, upper_bottom=side_face(model, 0)[-1:])


def own_body():
    model = diffusion()
    return with_surfaces(model, upper_bottom=side_face(model, 0)[:1])


def collapsed():
    model = diffusion()
    points = model.mesh.nodes.copy()
    points[facets(model, "lower-top")[0] - 1] = points[facets(model, "lower-top")[0, 0] - 1]
    return replace(model, mesh=replace(model.mesh, nodes=points))


def loose(drop, shift=0.0):
    """The model without the conditions in `drop`, the upper body moved up."""
    model = moved(diffusion(), 1, (0.0, 0.0, shift))
    kept = tuple(c for c in model.conditions if (c.kind, c.where) not in drop)
    return replace(model, conditions=kept)


def with_peclet():
    model = diffusion()
    return replace(model, conditions=(*model.conditions, fluid_flux("bottom", -0.1)))


def text_of(model, *changes):
    text = model.text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return text


AMBIENT = (Param("ambient_concentration", 1.0),)


def ambient_at(solute, value):
    return Param("ambient_concentration", value, None, {"sol": solute})


FAULTS = {
    "a tie over a gap": (lambda: joint(gap=0.2).text(), "untied", "up to 0.2"),
    "a tie of fine rigid facets": (
        lambda: text_of(joint(), ('name="up" type="neo-Hookean"', 'name="up" type="rigid body"')),
        "rigid-primary",
        "more conditions",
    ),
    "bonds that would break before they soften": (
        lambda: joint(f"{BONDS}<penalty>2</penalty>").text(),
        "soft-bonds",
        "strength^2/(2 energy)",
    ),
    "facets that are long for bonds": (lambda: joint(BONDS).text(), "cohesive-zone", "jump from node to node"),
    "a joint that is tied twice": (tied_twice, "held-twice", "another tie"),
    "facing into the body": (turned, "inverted-facets", "into the body"),
    "on the far side": (far_side, "facing", "same way"),
    "facet of no element": (no_face, "facet-of-no-element", "no solid element"),
    "facet inside": (inner, "inner-facets", "both sides"),
    "bodies merged": (merged, "shared-facets", "in common"),
    "surfaces share nodes": (corner, "shared-nodes", "share 2 nodes"),
    "surfaces of one body": (own_body, "own-body", "one body"),
    "collapsed facet": (collapsed, "flat-facet", "no area"),
    "empty surface": (
        lambda: with_surfaces(diffusion(), lower_top=np.empty((0, 4), int)),
        "empty-surface",
        "no facets",
    ),
    "overlap": (lambda: moved(diffusion(), 1, (0, 0, -0.1)), "initial-overlap", "node_reloc"),
    "gap beyond FEBio's radius": (
        lambda: moved(diffusion(InterfaceType.SOLUTE), 1, (0, 0, 2.0)),
        "search-radius",
        "apart",
    ),
    "gap beyond a radius": (
        lambda: moved(with_params(Param("search_radius", 0.01)), 1, (0, 0, 0.1)),
        "search-radius",
        "0.15",
    ),
    "overlap beyond a radius": (
        lambda: moved(with_params(Param("search_radius", 0.01)), 1, (0, 0, -0.1)),
        "search-radius",
        "pass through",
    ),
    "leak of the paper's penalty": (lambda: diffusion(InterfaceType.MIXTURE, PAPER), "leak", "jump by about 33 %"),
    "leak of FEBio's default": (
        lambda: with_params(Param("concentration_penalty", 1e-3), interface=InterfaceType.SOLUTE),
        "leak",
        "concentration of solute 1",
    ),
    "leak of the solvent": (lambda: with_params(Param("pressure_penalty", 1e-4)), "leak", "fluid pressure will jump"),
    "overlap of FEBio's default": (lambda: with_params(interface=InterfaceType.SOLUTE), "leak", "overlap by about"),
    "leak of automatic penalties": (lambda: diffusion(InterfaceType.SOLUTE, automatic(1.0)), "leak", "9.1 %"),
    "leak with few augmentations": (
        lambda: diffusion(InterfaceType.SOLUTE, replace(augmented(automatic(0.1), 0.0), maxaug=1)),
        "leak",
        "even after",
    ),
    "stiff penalty": (lambda: with_params(Param("penalty", 1e9)), "stiff-penalty", "open and close"),
    "Peclet number": (with_peclet, "peclet", "element Peclet number"),
    "short step": (lambda: diffusion(InterfaceType.SOLUTE, control=Control(100, 1.0)), "time-step", "often stalls"),
    "ambient pressure missing": (lambda: with_params(*AMBIENT), "ambient-pressure", "-0.0024776"),
    "ambient pressure of the wrong sign": (
        lambda: with_params(*AMBIENT, Param("ambient_pressure", 2.4776e-3)),
        "ambient-pressure",
        "-0.0024776",
    ),
    "ambient pressure in Pa": (
        lambda: with_params(*AMBIENT, Param("ambient_pressure", -2477.6)),
        "ambient-pressure",
        "-0.0024776",
    ),
    "prescribed pressure": (
        lambda: text_of(diffusion(), ("<value>-0.002477572</value>", "<value>0</value>")),
        "ambient-pressure",
        "prescribed",
    ),
    "nodes held against ambient values": (
        lambda: Apart(InterfaceType.SOLUTE, held=(pressure("lower-top", 1.0),)).model(),
        "prescribed-nodes",
        "of 4 nodes",
    ),
    "body not held before touch": (
        lambda: loose({("prescribed displacement", "top")}, 0.01),
        "rigid-motion",
        "before it touches",
    ),
    "body not held at all": (lambda: loose({("zero displacement", "all")}), "rigid-motion", "along x"),
    "misspelt parameter": (
        lambda: with_params(Param("pressure_penlaty", 1.0)),
        "unknown-parameter",
        "pressure_penalty",
    ),
    "no parameter between two tags": (
        lambda: CONTACT.sub(r"<contact\1></contact>", with_params().text()),
        "empty-contact",
        "two tags",
    ),
    "true": (lambda: with_params(Param("auto_penalty", "True")), "switch", "FEBio reads as 0"),
    "negative tolerance": (lambda: with_params(Param("tolerance", -1.0)), "bad-value", "zero or"),
    "no number": (lambda: with_params(Param("penalty", "much")), "bad-value", "zero or"),
    "FEBio's enforcement": (
        lambda: with_params(Param("laugon", "LAGMULT"), interface=InterfaceType.SOLUTE),
        "bad-value",
        "must be PENALTY or AUGLAG",
    ),
    "augmentations": (lambda: with_params(Param("minaug", 5), Param("maxaug", 2)), "bad-value", "minaug"),
    "negative friction": (lambda: with_params(Param("fric_coeff", -0.1)), "bad-value", "fric_coeff"),
    "more solid than all": (
        lambda: with_params(Param("fric_coeff", 0.1), Param("contact_frac", 1.1)),
        "bad-value",
        "a number from 0 to 1",
    ),
    "no stick at all": (
        lambda: with_params(Param("fric_coeff", 0.1), Param("tangential_penalty", 0.0)),
        "bad-value",
        "a number above 0",
    ),
    "friction that falls below zero": (
        lambda: replace(with_params(Param("fric_coeff", 0.1, 1)), curves=(Curve(((0, 1), (1, -1))),)),
        "bad-value",
        "a friction coefficient is never negative",
    ),
    "friction with FEBio's symmetric tangent": (
        lambda: with_params(Param("fric_coeff", 0.1), interface=InterfaceType.MULTIPHASIC),
        "symmetric-friction",
        "the default of this type",
    ),
    "offset": (lambda: with_params(Param("offset", "wide")), "bad-value", "offset"),
    "shell bottoms": (
        lambda: with_params(Param("shell_bottom_primary", 1.0)),
        "shell-bottom",
        "lies on solid elements",
    ),
    "no shell bottoms": (lambda: with_params(Param("shell_bottom_primary", 2.0)), "bad-value", "shell_bottom_primary"),
    "load curve not there": (
        lambda: text_of(
            with_params(Param("ambient_pressure", 1.0)), ("<ambient_pressure>", '<ambient_pressure lc="7">')
        ),
        "load-curve",
        "does not exist",
    ),
    "load curve that FEBio does not take": (
        lambda: Apart(InterfaceType.MULTIPHASIC).model(),
        "load-curve",
        "takes no load curve",
    ),
    "load curve of a radius": (
        lambda: text_of(replace(with_params(Param("search_radius", 1.0, 1)), curves=(Curve(((0, 0), (1, 1))),))),
        "load-curve",
        "cannot change",
    ),
    "module": (lambda: text_of(diffusion(), ("sliding-mixture", "sliding-multiphasic")), "module", "multiphasic"),
    "module without displacements": (
        lambda: text_of(diffusion(), ('<Module type="solute"', '<Module type="fluid"')),
        "module",
        "no displacements",
    ),
    "unknown module": (
        lambda: text_of(diffusion(), ('<Module type="solute"', '<Module type="sollid"')),
        "module",
        "not a module of FEBio",
    ),
    "solute": (lambda: with_params(Param("ambient_concentration", 1.0, None, {"sol": "3"})), "ambient-solute", "3"),
    "name of no solute": (lambda: with_params(ambient_at("Na", 1.0)), "ambient-solute", "solute Na"),
    "permeance of no solute": (
        lambda: with_params(Param("solute_permeance", 1.0, None, {"sol": "3"}), Param("reflection", 1.0)),
        "ambient-solute",
        "<solute_permeance>",
    ),
    "permeance without reflection": (
        lambda: with_params(Param("solute_permeance", 1.0)),
        "membrane",
        "<reflection> is not",
    ),
    "reflection without permeance": (
        lambda: with_params(Param("reflection", 1.0)),
        "membrane",
        "<solute_permeance> is not",
    ),
    "carried by no solvent": (
        lambda: with_params(Param("solute_permeance", 1.0), Param("reflection", 0.5)),
        "membrane",
        "<hydraulic_conductance> is not given",
    ),
    "penalty beside a membrane": (
        lambda: with_params(Param("hydraulic_conductance", 1.0), Param("pressure_penalty", 1.0)),
        "membrane",
        "<pressure_penalty> has no effect",
    ),
    "reflection above 1": (
        lambda: with_params(Param("solute_permeance", 1.0), Param("reflection", 1.5)),
        "bad-value",
        "<reflection>",
    ),
    "ambient concentration nan": (lambda: with_params(ambient_at("s1", "nan")), "bad-value", "zero or"),
    "ambient concentration below zero": (lambda: with_params(ambient_at("s1", -1.0)), "bad-value", "zero or"),
    "load curve below zero": (
        lambda: replace(
            with_params(Param("ambient_concentration", 2.0, 1)), curves=(Curve(((0, 0), (1, 1), (2, -1))),)
        ),
        "bad-value",
        "falls to -2",
    ),
    "ambient concentration twice": (
        lambda: with_params(ambient_at("s1", 1.0), ambient_at("1", 2.0)),
        "given-twice",
        "of solute 1 is given twice",
    ),
    "ambient concentration twice, once without sol": (
        lambda: with_params(*AMBIENT, ambient_at("s1", 2.0)),
        "given-twice",
        "of solute 1 is given twice",
    ),
    "parameter twice": (lambda: with_params(Param("penalty", 1.0), Param("penalty", 2.0)), "given-twice", "<penalty>"),
    "step of no duration": (
        lambda: diffusion(control=Control(10, 0.0)),
        "time-step",
        "no duration",
    ),
    "material not told": (
        lambda: text_of(diffusion(), ('<SolidDomain name="upper" mat="gel"/>', "")),
        "no-material",
        "MeshDomains",
    ),
    "symmetric tangent": (
        lambda: with_params(Param("symmetric_stiffness", 1)),
        "symmetric-tangent",
        "many more iterations",
    ),
    "a linear solver for symmetric matrices": (
        lambda: text_of(diffusion(), ("</qn_method>", '</qn_method><linear_solver type="skyline"/>')),
        "linear-solver",
        "symmetric matrices only",
    ),
    "multipliers and an iterative linear solver": (
        lambda: text_of(
            with_params(Param("laugon", "LAGMULT")),
            ("</qn_method>", '</qn_method><linear_solver type="fgmres"/>'),
        ),
        "linear-solver",
        "zeros on the diagonal",
    ),
}


def on_shells():
    """The upper body's surface on a layer of shells."""
    model = diffusion()
    shared = ",".join(str(node) for node in range(901, 905))
    nodes = "".join(
        f'<node id="{900 + k}">{x},{y},0</node>' for k, (x, y) in enumerate(((0, 0), (0, 1), (1, 1), (1, 0)), 1)
    )
    shell = f'<Elements type="quad4" name="skin"><elem id="900">{shared}</elem></Elements>'
    surface = re.compile(r'(<Surface name="upper-bottom">\s*<quad4 id="1">).*?(</quad4>)', re.DOTALL)
    text = text_of(model, ("</Nodes>", f"{nodes}</Nodes>{shell}"))
    return surface.sub(rf"\g<1>{shared}\g<2>", text)


def shells_alone():
    """A model without a solid element: both surfaces on shells."""
    shell = '<Elements type="quad4" name="{0}"><elem id="{1}">{2}</elem></Elements>'
    text = re.sub(r"<Elements .*</Elements>", "", on_shells(), flags=re.DOTALL)
    lower, upper = (re.search(rf'name="{name}">\s*<quad4 id="1">(.*?)<', text).group(1) for name in SURFACES)
    made = shell.format("lower", 1, lower) + shell.format("upper", 2, upper)
    return text.replace("</Nodes>", f"</Nodes>{made}").replace("SolidDomain", "ShellDomain")


def itself():
    """The lower body's surface on both sides of the contact."""
    model = diffusion()
    pairs = {name: (one, one) for name, (one, _) in model.mesh.pairs.items()}
    return replace(model, mesh=replace(model.mesh, pairs=pairs))


SURFACES = ("lower-top", "upper-bottom")


def test_febios_contact_on_shells_alone_is_looked_at(findings):
    found = findings(shells_alone(), ("sliding-mixture", "sliding-elastic"))
    assert not any(finding.severity is Severity.ERROR for finding in found)


def test_an_element_without_stiffness_is_looked_at(findings):
    model = with_params(Param("penalty", 2.0), interface=InterfaceType.SOLUTE)
    assert "stiff-penalty" not in {finding.rule for finding in findings(model, ("<E>10<", "<E>0<"))}


def test_a_part_of_a_mesh_that_febio_does_not_read_is_named(findings):
    with pytest.raises(ModelError, match=r"<Instance name=.*FEBio 4 reads no <Instance>"):
        findings(diffusion(), ("<Mesh>", '<Mesh><Instance name="one" part="two"/>'))


# ---- what is sound ----


def aside(shift):
    """The upper body beside the lower one, above its surface: they can meet once it has moved back."""
    return moved(diffusion(), 1, (2.0, 0.0, shift))


@pytest.mark.parametrize("gap", [0.0, 0.01, 5.0])
def test_bodies_that_meet_after_a_motion_are_no_error(findings, gap):
    found = [finding for finding in findings(aside(gap)) if finding.rule == "facing"]
    assert [finding.severity for finding in found] == [Severity.NOTE]


@pytest.mark.parametrize("module", ["fluid-FSI", "fluid-solutes", "multiphasic-FSI"])
@pytest.mark.parametrize("kind", ["sliding-mixture", "sliding-elastic", "sliding-biphasic"])
def test_modules_that_include_others_have_their_contacts(findings, module, kind):
    changes = (('<Module type="solute"', f'<Module type="{module}"'), ("sliding-mixture", kind))
    assert "module" not in {finding.rule for finding in findings(diffusion(), *changes)}


def rubbing(kind, *params):
    """A body that a load presses onto another one, and nothing but friction holds sideways."""
    model = loose({("zero displacement", "all")})
    extra = "".join(f"<{name}>{value}</{name}>" for name, value in (("fric_coeff", 0.3), *params))
    tag = f'<contact name="lower/upper" type="{kind}" surface_pair="lower/upper">{extra}</contact>'
    return re.sub(r"<contact .*?(?:/>|</contact>)", tag, model.text(), flags=re.DOTALL)


NEEDED = {"sliding-node-on-facet": (("fric_penalty", 1.0),)}
"""What friction of a type needs beside its coefficient."""


@pytest.mark.parametrize("kind", ["sliding-mixture", "sliding-elastic", "sliding-biphasic", "sliding-node-on-facet"])
def test_friction_holds_a_body_in_contact(findings, kind):
    def said(text):
        found = [finding for finding in findings(text) if finding.rule == "rigid-motion"]
        return " ".join(finding.message for finding in found)

    with_friction = rubbing(kind, *NEEDED.get(kind, ()))
    assert "the contact does not either" not in said(with_friction)
    assert "the contact does not either" in said(with_friction.replace("0.3<", "0<"))


def test_a_load_curve_counts_where_a_penalty_is_judged(findings):
    curves = (Curve(((0, 0), (1, 1))),)
    soft, stiff = (replace(with_params(Param("penalty", value, 1)), curves=curves) for value in (1e-3, 1e9))
    assert "leak" in {finding.rule for finding in findings(soft)}
    assert "stiff-penalty" in {finding.rule for finding in findings(stiff)}


@pytest.mark.parametrize("named", ["c1", "s1", "c1,c2"])
def test_conditions_name_solutes_by_number_or_name(findings, named):
    """A zero concentration on nodes of the contact is found, whatever the solute is called."""
    tag = '<bc name="held" type="zero concentration" node_set="@surface:lower-top">'
    condition = f"{tag}<c_dof>{named}</c_dof></bc></Boundary>"
    model = with_params(*AMBIENT, interface=InterfaceType.SOLUTE)
    found = findings(model, ("</Boundary>", condition))
    assert any(finding.rule == "prescribed-nodes" and "solute 1" in finding.message for finding in found)


def coarse_primary():
    boxes = [Box("lower", "gel", (0.0, 0.0, -1.0), (1.0, 1.0, 1.0), (1, 1, 2))]
    boxes.append(Box("upper", "gel", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (5, 5, 2)))
    mesh = replace(assemble(boxes), pairs={"lower/upper": ("lower-top", "upper-bottom")})
    sets = mesh.node_sets | {"bottom": mesh.node_sets["lower-bottom"], "top": mesh.node_sets["upper-top"]}
    return replace(diffusion(), mesh=replace(mesh, node_sets=sets))


NOTES = {
    "a tie of nodes that are held": (
        lambda: text_of(
            joint(),
            ('<bc type="zero displacement" node_set="low-bottom">', '<bc type="zero displacement" node_set="up-left">'),
        ),
        "held-nodes",
    ),
    "rigid bodies": (
        lambda: text_of(diffusion(), ('type="biphasic-solute">', 'type="rigid body">')),
        "rigid-penalty",
    ),
    "side faces": (with_sides, "side-faces"),
    "the far side": (with_far_side, "side-faces"),
    "shells": (on_shells, "shell-facets"),
    "shells alone": (shells_alone, "shell-facets"),
    "itself": (itself, "self-contact"),
    "coarse primary": (coarse_primary, "finer-primary"),
    "a penalty of zero": (lambda: with_params(Param("penalty", 0.0)), "left-out"),
    "ambient values without open nodes": (
        lambda: with_params(Param("free_draining", 0.0), Param("ambient_pressure", 0.0)),
        "not-drained",
    ),
    "a solid fraction without friction": (lambda: with_params(Param("contact_frac", 0.1)), "no-friction"),
    "few reformations": (lambda: text_of(diffusion(), ("<max_refs>15<", "<max_refs>5<")), "max-refs"),
    "solutes not exchanged": (lambda: text_of(diffusion(), ("sliding-mixture", "sliding-biphasic")), "impermeable"),
    "fluid not exchanged": (lambda: text_of(diffusion(), ("sliding-mixture", "sliding-elastic")), "impermeable"),
    "a property that is a formula": (
        lambda: text_of(diffusion(), ("<perm>0.0001<", '<perm type="math">1e-4*X<')),
        "not-compared",
    ),
    "short step with this plugin": (lambda: diffusion(control=Control(100, 1.0)), "time-step"),
}


@pytest.mark.parametrize("name", NOTES)
def test_notes(findings, name):
    make, rule = NOTES[name]
    found = [finding for finding in findings(make()) if finding.rule == rule]
    assert found
    assert all(finding.severity is Severity.NOTE for finding in found)


def test_every_rule_has_a_fault_and_a_line_in_the_page():
    code = "".join(path.read_text(encoding="utf-8") for path in (PREFLIGHT / "rules").glob("*.py"))
    rules = set(re.findall(r'(?:error|warning|note)\(\s*"([a-z-]+)"', code))
    assert len(rules) > 25
    seeded = {rule for _, rule, _ in FAULTS.values()} | {rule for _, rule in NOTES.values()}
    assert seeded == rules
    page = (DOCS / "reference" / "check.md").read_text(encoding="utf-8")
    table = page[page.index("| rule |") : page.index("### Leaks")]
    assert {
        name for row in re.findall(r"^\| (`[^|]*) \|", table, re.M) for name in re.findall(r"`([^`]+)`", row)
    } == rules


@pytest.mark.parametrize("name", FAULTS)
def test_seeded_faults_are_found(findings, name):
    make, rule, word = FAULTS[name]
    found = [finding for finding in findings(make()) if finding.rule == rule]
    assert found, f"{rule} is silent"
    assert any(word in finding.message + finding.suggestion for finding in found), found
    for finding in found:
        assert finding.severity is not Severity.NOTE
        assert finding.place.line > 1
        assert finding.suggestion.endswith(".")
        assert not finding.message.endswith(".")


def test_parameters_of_friction_act_with_it(findings):
    rubbing = with_params(Param("contact_frac", 0.1), Param("fric_coeff", 0.1))
    assert "no-friction" not in {finding.rule for finding in findings(rubbing)}
