"""No false alarm on sound models, and a reader that knows what FEBio's files may hold. Nothing here needs FEBio."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from harness.closed_forms.penalty_leak import relative_jump
from harness.errors import ModelError
from harness.models import composite
from harness.models.composite import Composite
from harness.models.confined import Confined
from harness.models.convection import PRESSURES, Convection
from harness.models.diffusion import Diffusion
from harness.models.indentation import Indentation
from harness.models.indentation_mesh import Primary
from harness.models.interface import PAPER, ContactSettings, InterfaceType
from harness.models.layers import Layers
from harness.models.mesh import Section
from harness.models.parts import Param
from harness.paths import MODELS, REPOSITORY
from harness.preflight import elements
from harness.preflight.check import check
from harness.preflight.finding import Severity
from harness.preflight.model import read
from harness.preflight.penalty import leak, penalty
from harness.preflight.sides import TRACTION, Joint, solute
from harness.user_commands import FOR_EVERYBODY, commands
from studies.cli import main
from studies.models.kept_models import LEVELS
from studies.models.quadratic import quadratic

COLLECTION = sorted(MODELS.glob("*.feb"))
EXPECTED = {"joint-before": ["leak"], "membrane": ["ambient-pressure"]}
"""Rules that speak of a model of the collection: `joint-before` is there for `convert` to change, and the faces of
`membrane` have simple effective pressures, whose closed form does not ask what the fluid pressure is."""
SOUND = (InterfaceType.MIXTURE, InterfaceType.SOLUTE, InterfaceType.MULTIPHASIC)


@pytest.mark.parametrize("path", COLLECTION, ids=lambda path: path.stem)
def test_the_collection_raises_no_alarm(path):
    rules = [finding.rule for finding in check(path) if finding.severity is not Severity.NOTE]
    assert rules == EXPECTED.get(path.stem, [])


def generated():
    models = [Diffusion(interface, elements=n).model() for interface in SOUND for n in (5, 10)]
    models += [Convection(interface, peclet=peclet).model() for interface in SOUND for peclet in PRESSURES]
    models += [cls(interface).model() for interface in SOUND for cls in (Composite, Layers)]
    models += [Confined(interface).model() for interface in (InterfaceType.MIXTURE, InterfaceType.BIPHASIC)]
    coarse, slab = Indentation(grid=LEVELS[0], name="coarse"), Indentation(primary=Primary.SLAB, name="slab-primary")
    hex20 = replace(coarse.model(), name="hex20", mesh=quadratic(coarse.model().mesh, 20))
    return [*models, coarse.model(), hex20, slab.model()]


@pytest.mark.parametrize("model", generated(), ids=lambda model: f"{model.name} {model.contacts[0].kind}")
def test_generated_models_raise_no_alarm(findings, model):
    assert [finding for finding in findings(model) if finding.severity is not Severity.NOTE] == []


# ---- what files may hold ----

CUBE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], dtype=float)
SIMPLE = {
    "tet4": (CUBE[[0, 1, 3, 4]], 1 / 6),
    "penta6": (CUBE[[0, 1, 3, 4, 5, 7]], 1 / 2),
    "hex8": (CUBE, 1.0),
    "pyra5": (np.concatenate([CUBE[:4], [(0.5, 0.5, 1.0)]]), 1 / 3),
}


@pytest.mark.parametrize("name", SIMPLE)
def test_faces_point_outwards_and_close(name):
    points, volume = SIMPLE[name]
    faces = points[elements.SHAPES[name].corner_faces]
    areas = elements.area_vectors(faces)
    np.testing.assert_allclose(areas.sum(axis=0), 0.0, atol=1e-14)
    assert np.all(np.einsum("fi,fi->f", areas, faces.mean(axis=1) - points.mean(axis=0)) > 0.0)
    assert elements.volumes(faces[None])[0] == pytest.approx(volume, rel=1e-13)


@pytest.mark.parametrize("name", ["hex8", "HEX8G8", "TET10G8_S3", "TET15G11", "HEX20G8", "PENTA15G8", "ut4"])
def test_names_of_element_types(name):
    stem = re.match(r"[A-Za-z]+\d+", name).group(0).lower()
    assert elements.shape(name).nodes == (4 if name == "ut4" else int(re.search(r"\d+", stem).group(0)))


def test_unknown_element_types():
    assert elements.shape("hex9") is None


PRISMS = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))


TETS = ((0, 1, 2, 6), (0, 5, 1, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 4, 5, 6), (0, 7, 4, 6))


def split(text, kind, cells):
    """Each hex8 of a model's text as several smaller elements, its quad4 facets as triangles of the same diagonal."""
    root_number = iter(range(1, 10**6))

    def elements_of(block):
        rows = [row.split(",") for row in re.findall(r"<elem [^>]*>(.*?)</elem>", block.group(0))]
        made = [
            f'<elem id="{next(root_number)}">{",".join(row[k] for k in cell)}</elem>' for row in rows for cell in cells
        ]
        return re.sub(r"<elem .*</elem>", "".join(made), block.group(0).replace("hex8", kind), flags=re.DOTALL)

    return re.sub(r"<Elements .*?</Elements>", elements_of, text, flags=re.DOTALL)


def triangles(text):
    """Facets as two triangles each."""

    def facets_of(surface):
        rows = [row.split(",") for row in re.findall(r"<quad4 [^>]*>(.*?)</quad4>", surface.group(0))]
        pairs = [pair for a, b, c, d in rows for pair in ((a, b, c), (a, c, d))]
        made = "".join(f'<tri3 id="{k}">{",".join(nodes)}</tri3>' for k, nodes in enumerate(pairs, 1))
        return re.sub(r"<quad4 .*</quad4>", made, surface.group(0), flags=re.DOTALL)

    return re.sub(r"<Surface .*?</Surface>", facets_of, text, flags=re.DOTALL)


def leaks(found):
    return [finding.message for finding in found if finding.rule == "leak"]


@pytest.mark.parametrize(("kind", "cells"), [("penta6", PRISMS), ("tet4", TETS), ("TET4G4", TETS)])
def test_prisms_and_tetrahedra_leak_as_hexahedra_do(findings, kind, cells):
    model = Diffusion(InterfaceType.MIXTURE, PAPER, elements=4).model()
    found = findings(triangles(split(model.text(), kind, cells)))
    assert leaks(found) == leaks(findings(model)) != []
    assert not any(finding.severity is Severity.ERROR for finding in found)


LAYERS = (composite.FIRST, composite.SECOND)


def test_the_leak_of_unlike_layers_is_that_of_resistances_in_series(tmp_path):
    resistances = [layer.thickness / (layer.porosity * layer.solubility * layer.diffusivity) for layer in LAYERS]
    expected = relative_jump(resistances, 4e-4)
    made = read(Composite(InterfaceType.MIXTURE, PAPER, elements=3).model().write(tmp_path))
    joint = Joint(made, made.contacts[0])
    assert leak(joint, solute(1), penalty(joint, solute(1)).value) == pytest.approx(expected, rel=1e-12)


def test_a_body_of_two_materials_leaks_as_its_layers_in_series(tmp_path):
    """Two materials in the upper body: its two lower elements keep theirs, the two upper ones get that of the other."""
    model = Composite(InterfaceType.MIXTURE, PAPER, elements=4).model()
    lower, upper = model.mesh.parts
    cut = (replace(upper, elements=upper.elements[:2]), replace(upper, name="lid", material=lower.material))
    parts = (lower, cut[0], replace(cut[1], elements=upper.elements[2:]))
    made = read(replace(model, mesh=replace(model.mesh, parts=parts)).write(tmp_path))
    first, second = (layer.porosity * layer.solubility * layer.diffusivity for layer in LAYERS)
    half = composite.SECOND.thickness / 2
    joint = Joint(made, made.contacts[0])
    assert joint.secondary.resistance(solute(1)) == pytest.approx(half / first + half / second, rel=1e-12)


def test_quadratic_elements_leak_as_linear_ones_do(findings):
    model = Diffusion(InterfaceType.MIXTURE, PAPER, elements=4).model()
    assert leaks(findings(replace(model, mesh=quadratic(model.mesh, 20)))) == leaks(findings(model)) != []


JOINT = """<?xml version="1.0" encoding="ISO-8859-1"?>
<febio_spec version="4.0">
  <Module type="solid"/>
  <Control><analysis>STATIC</analysis><time_steps>10</time_steps><step_size>0.1</step_size>
    <solver type="solid"><symmetric_stiffness>symmetric</symmetric_stiffness></solver></Control>
  <Material>
    <material id="1" name="bone" type="rigid body"><density>1</density><center_of_mass>0,0,0</center_of_mass></material>
    <material id="2" name="cartilage" type="trans iso Mooney-Rivlin"><c1>1</c1><c2>0</c2><k>1000</k></material>
    <material id="3" name="shell" type="isotropic elastic"><E>10</E><v>0.3</v></material>
  </Material>
  <Mesh>
    <Nodes name="all">{nodes}</Nodes>
    <Elements type="hex8" name="femur"><elem id="1">1,2,3,4,5,6,7,8</elem></Elements>
    <Elements type="hex8" name="femoral"><elem id="2">5,6,7,8,9,10,11,12</elem></Elements>
    <Elements type="hex8" name="tibial"><elem id="3">13,14,15,16,17,18,19,20</elem></Elements>
    <Elements type="quad4" name="skin"><elem id="4">17,18,19,20</elem></Elements>
    <PartList name="cartilages">femoral,tibial</PartList>
    <ElementSet name="top">3</ElementSet>
    <Edge name="rim"><line2 id="1">17,18</line2></Edge>
    <Surface name="one"><quad4 id="1">9,10,11,12</quad4></Surface>
    <Surface name="two"><quad4 id="1">13,16,15,14</quad4></Surface>
    <SurfacePair name="knee"><primary>one</primary><secondary>two</secondary></SurfacePair>
  </Mesh>
  <MeshDomains>
    <SolidDomain name="femur" mat="bone"/><SolidDomain name="femoral" mat="cartilage"/>
    <SolidDomain name="tibial" mat="cartilage"/>
    <ShellDomain name="skin" mat="shell"><shell_thickness>0.1</shell_thickness></ShellDomain>
  </MeshDomains>
  <Boundary>
    <bc name="a" type="zero displacement" node_set="@edge:rim"><x_dof>1</x_dof><y_dof>1</y_dof><z_dof>1</z_dof></bc>
    <bc name="b" type="zero displacement" node_set="@elem_set:top"><x_dof>1</x_dof><y_dof>1</y_dof><z_dof>0</z_dof></bc>
    <bc name="c" type="zero shell displacement" node_set="@part_list:cartilages"><sx_dof>1</sx_dof></bc>
  </Boundary>
  <Rigid>
    <rigid_bc name="d" type="rigid_fixed"><rb>bone</rb><Rx_dof>1</Rx_dof><Ry_dof>1</Ry_dof>
      <Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof><Rw_dof>1</Rw_dof></rigid_bc>
    {drive}
  </Rigid>
  <Contact><contact name="knee" type="sliding-elastic" surface_pair="knee"><auto_penalty>1</auto_penalty>
    <penalty>100</penalty></contact></Contact>
</febio_spec>"""
"""A joint as FEBio Studio writes it: a rigid bone that shares nodes with its cartilage, shells, sets of all kinds."""

DRIVE = '<rigid_bc name="e" type="rigid_displacement"><rb>bone</rb><dof>z</dof><value lc="1">1</value></rigid_bc>'


def joint(drive, gap):
    heights = (0.0, 1.0, 2.0, 2.0 + gap, 3.0 + gap)
    corners = [(x, y, z) for z in heights for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    nodes = "".join(f'<node id="{k}">{x},{y},{z}</node>' for k, (x, y, z) in enumerate(corners, 1))
    return JOINT.format(nodes=nodes, drive=drive)


def test_a_joint_with_a_rigid_bone(findings):
    assert [finding.rule for finding in findings(joint(DRIVE, 0.5))] == []
    found = findings(joint("", 0.5))
    assert [finding.rule for finding in found] == ["rigid-motion"]
    assert "along z before it touches" in found[0].message


def test_a_tip_that_touches_is_in_contact(findings):
    """A body under a load alone whose lowest corner overlaps, while the middles of its facets are apart."""
    model = Confined(InterfaceType.MIXTURE, elements=2, section=Section((1.0, 1.0), (2, 2))).model()
    points = model.mesh.nodes.copy()
    upper = np.unique(model.mesh.parts[1].elements) - 1
    points[upper, 2] += 0.05 * np.hypot(points[upper, 0] - 0.5, points[upper, 1] - 0.5)
    text = replace(model, mesh=replace(model.mesh, nodes=points)).text()
    assert "rigid-motion" not in {finding.rule for finding in findings(text)}
    points[upper, 2] += 1e-3
    assert "rigid-motion" in {
        finding.rule for finding in findings(replace(model, mesh=replace(model.mesh, nodes=points)))
    }


def test_the_depth_is_that_of_the_cartilage_and_not_of_the_bone(tmp_path):
    path = tmp_path / "model.feb"
    path.write_text(joint(DRIVE, 0.5))
    made = read(path)
    modulus = 6.0  # of 6 (c1 + c2)
    assert Joint(made, made.contacts[0]).primary.resistance(TRACTION) == pytest.approx(1.0 / modulus, rel=1e-12)


def test_files_in_pieces(tmp_path):
    whole = Diffusion(InterfaceType.MIXTURE, PAPER, elements=2).model().text()
    head = '<?xml version="1.0" encoding="ISO-8859-1"?>\n<febio_spec version="4.0">'
    for name in ("Mesh", "Material"):
        section = re.search(rf"<{name}>.*?</{name}>", whole, re.DOTALL).group(0)
        (tmp_path / f"{name}.feb").write_text(f"{head}{section}</febio_spec>")
        inside = '<Mesh from="Mesh.feb"/>' if name == "Mesh" else "<Include>Material.feb</Include>"
        whole = whole.replace(section, inside)
    path = tmp_path / "model.feb"
    path.write_text(whole, encoding="iso-8859-1")
    assert len(read(path).mesh.points) == 24
    assert leaks(check(path))
    (tmp_path / "Mesh.feb").unlink()
    with pytest.raises(ModelError, match=r"line \d+: <Mesh>: includes 'Mesh.feb', and there is no file"):
        check(path)


def test_a_file_that_includes_itself(tmp_path):
    path = tmp_path / "model.feb"
    path.write_text('<?xml version="1.0"?><febio_spec version="4.0"><Include>model.feb</Include></febio_spec>')
    with pytest.raises(ModelError, match="include itself"):
        check(path)


def test_lines_beyond_65535(findings):
    model = Diffusion(InterfaceType.MIXTURE, PAPER, elements=2).model()
    far = model.text().replace("<Contact>", "\n" * 70000 + "<Contact>")
    assert all(finding.place.line > 70000 for finding in findings(far) if finding.rule == "leak")


BROKEN = {
    "no XML": ("<febio_spec", "is not XML"),
    "no declaration": ("<febio_spec version='4.0'/>", "does not begin with <\\?xml"),
    "another root": ("<?xml version='1.0'?><model/>", "begins with <febio_spec>"),
    "an older version": ("<?xml version='1.0'?><febio_spec version='2.0'/>", "2.5, 3.0, 4.0 can be read"),
    "no module": ("<?xml version='1.0'?><febio_spec version='4.0'/>", "has no <Module"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_files_that_are_no_models(findings, name):
    text, message = BROKEN[name]
    with pytest.raises(ModelError, match=message):
        findings(text)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("hex8", "hex9", r"line \d+: <Elements name=.*type 'hex9', which is unknown; there is hex8"),
        (
            "<primary>lower-top",
            "<primary>lid",
            r"line \d+: <primary>: names surface 'lid', which does not exist; there is",
        ),
        ('node_set="top"', 'node_set="lid"', r"names node set 'lid', which does not exist; there is bottom, top"),
        ('mat="gel"', 'mat="bone"', r"names material 'bone', which does not exist; there is gel"),
        ('surface_pair="lower/upper"', "", "has no attribute 'surface_pair'"),
        ('type="sliding-mixture"', 'type="sliding-mixtures"', "is of type 'sliding-mixtures', which is unknown"),
        ("<quad4 ", "<quad5 ", "not XML"),
    ],
)
def test_what_does_not_exist_is_named(findings, old, new, message):
    with pytest.raises(ModelError, match=message):
        findings(Diffusion(InterfaceType.MIXTURE, elements=2).model(), (old, new))


# ---- the command ----


def command(*arguments):
    return CliRunner().invoke(commands(FOR_EVERYBODY), [str(argument) for argument in arguments])


def test_exit_codes_and_json(tmp_path):
    assert command("check", MODELS / "diffusion.feb").exit_code == 0
    path = Diffusion(InterfaceType.SOLUTE, PAPER, elements=2, name="leaky").model().write(tmp_path)
    finished = command("check", path, "--json")
    assert finished.exit_code == 1
    found = json.loads(finished.stdout)
    assert found["model"] == str(path)
    assert set(found["findings"][0]) == {"severity", "rule", "file", "line", "tag", "message", "suggestion"}


def test_a_file_that_cannot_be_read(tmp_path):
    finished = subprocess.run(
        [sys.executable, "-m", "studies", "check", str(tmp_path / "none.feb")],
        env={**os.environ, "PYTHONPATH": str(REPOSITORY / "scripts"), "COLUMNS": "200"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert finished.returncode == 2
    assert "none.feb: cannot be read" in finished.stderr
    assert "Traceback" not in finished.stderr


def test_a_fault_of_ours_is_one_sentence_and_a_file(tmp_path, monkeypatch, capsys):
    def fault(path):
        raise IndexError("index -1 is out of bounds")

    monkeypatch.setattr("harness.preflight.check.check", fault)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setattr(sys, "argv", ["mixcontact", "check", str(MODELS / "diffusion.feb")])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 4
    said = capsys.readouterr().err
    (written,) = tmp_path.glob("mixcontact-fault-*.txt")
    assert "please report it" in said
    assert str(written) in said
    assert "Traceback" not in said
    assert "IndexError: index -1 is out of bounds" in written.read_text()


def test_converting_from_the_command_line(tmp_path):
    path = Diffusion(InterfaceType.SOLUTE, elements=2, name="old").model().write(tmp_path)
    before = path.read_bytes()
    finished = command("convert", path)
    assert finished.exit_code == 0
    assert "auto_penalty" in finished.stdout
    assert path.read_bytes() == before
    made = (tmp_path / "old-mixture.feb").read_bytes()
    assert "exists already" in str(command("convert", path).exception)
    assert command("convert", path, "--in-place").exit_code == 0
    assert path.read_bytes() == made
    assert "nothing to convert" in str(command("convert", path, "--output", tmp_path / "new.feb").exception)


@pytest.mark.parametrize(
    ("effects", "names"),
    [
        ("all", ["traction", "fluid pressure", "concentration of solute 1"]),
        ("traction", ["traction"]),
        ("solvent", ["traction", "fluid pressure"]),
        ("solute 1", ["traction", "concentration of solute 1"]),
        (" s1 ", ["traction", "concentration of solute 1"]),
    ],
)
def test_what_a_contact_exchanges(effects, names, tmp_path):
    settings = ContactSettings(extra=(Param("effects", effects),))
    model = read(Diffusion(InterfaceType.MIXTURE, settings, elements=1).model().write(tmp_path))
    assert [field.name for field in Joint(model, model.contacts[0]).fields] == names
