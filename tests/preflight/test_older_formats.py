"""`check` and `convert` read models of the formats 2.5 and 3.0 as those of 4.0. Nothing here needs FEBio."""

from __future__ import annotations

import difflib
import re
from dataclasses import replace

import pytest
from older_formats import VERSIONS, in_instances, older
from scenes.pairs import of_kinds

from harness.conversion.convert import convert
from harness.errors import ModelError
from harness.models.diffusion import Diffusion
from harness.models.interface import PAPER, InterfaceType
from harness.models.parts import Curve, concentration, fix, pressure
from harness.paths import REPOSITORY
from harness.preflight.check import check
from harness.preflight.model import read
from harness.preflight.xml_file import place
from harness.run import febfile
from studies.models.sheared_blocks import Kind

GALLERY = ("before-migration", "diffusion", "indentation", "joint", "platens", "sliding-joint")


def of_gallery(name):
    return (REPOSITORY / "models" / f"{name}.feb").read_text(encoding="iso-8859-1")


def diffusion():
    return Diffusion(InterfaceType.SOLUTE, PAPER, elements=2).model()


def held():
    """Pressures and concentrations at nodes of the contact, one of them in time."""
    model = diffusion()
    more = (pressure("lower-top", 1.0, 1), concentration("upper-bottom", 0.7), fix("lower-top", "x"))
    return replace(model, conditions=(*model.conditions, *more), curves=(Curve(((0.0, 0.0), (10.0, 1.0))),)).text()


def in_a_step(text):
    """The contact and the conditions in an analysis step."""
    found = [re.search(rf"<{name}>.*?</{name}>", text, re.DOTALL).group(0) for name in ("Contact", "Boundary")]
    for section in found:
        text = text.replace(section, "")
    return text.replace("<Output>", f'<Step><step id="1" name="one">{"".join(found)}</step></Step><Output>')


def adrift(*, rigid):
    """A body that nothing holds in z until it touches, elastic or rigid."""
    text = of_kinds(Kind.RIGID, Kind.BIPHASIC).model().text() if rigid else diffusion().text()
    driven = "<rigid_bc [^>]*rigid_displacement.*?</rigid_bc>" if rigid else "<bc [^>]*displacement top.*?</bc>"
    assert re.search(driven, text, re.DOTALL)
    return re.sub(driven, "", text, flags=re.DOTALL)


TEXTS = {
    **{name: of_gallery(name) for name in GALLERY},
    "held": held(),
    "in a step": in_a_step(held()),
    "adrift": adrift(rigid=False),
    "adrift, rigid": adrift(rigid=True),
    "rigid": of_kinds(Kind.RIGID, Kind.BIPHASIC).model().text(),
}


def said(path):
    """What `check` finds, but for places."""
    return sorted((f.severity.value, f.rule, f.message, f.suggestion) for f in check(path))


def write(folder, text, version="4.0"):
    path = folder / f"model-{version}.feb"
    path.write_text(text if version == "4.0" else older(text, version), encoding="iso-8859-1")
    return path


def in_file(folder, text):
    path = folder / "other.feb"
    path.write_text(text)
    return path


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", TEXTS)
def test_check_says_the_same(tmp_path, name, version):
    assert said(write(tmp_path, TEXTS[name], version)) == said(write(tmp_path, TEXTS[name]))


def test_there_is_something_to_say(tmp_path):
    rules = {rule for text in TEXTS.values() for _, rule, _, _ in said(write(tmp_path, text))}
    assert {"leak", "prescribed-nodes", "rigid-motion", "time-step"} <= rules


@pytest.mark.parametrize("version", VERSIONS)
def test_places_are_those_of_the_file(tmp_path, version):
    path = write(tmp_path, TEXTS["held"], version)
    lines = path.read_text(encoding="iso-8859-1").splitlines()
    found = [finding for finding in check(path) if finding.rule in ("leak", "prescribed-nodes")]
    assert len(found) > 2
    for finding in found:
        tag = re.match(r"<\w+", finding.place.tag).group(0)
        assert tag in ("<scale", "<contact", "<concentration_penalty", "<pressure_penalty", "<penalty")
        assert tag in lines[finding.place.line - 1]


def changed_lines(old, new):
    lines = difflib.ndiff(old.decode("iso-8859-1").splitlines(), new.decode("iso-8859-1").splitlines())
    return [line for line in lines if line.startswith(("+ ", "- "))]


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", ["before-migration", "held", "in a step"])
def test_convert_changes_the_contact_alone(tmp_path, name, version):
    old, newest = write(tmp_path, TEXTS[name], version), write(tmp_path, TEXTS[name])
    made, expected = convert(old), convert(newest)
    assert changed_lines(old.read_bytes(), made.data) == changed_lines(newest.read_bytes(), expected.data)
    what = [[(change.name, change.reason) for change in changes] for changes in made.changes.values()]
    assert what == [[(change.name, change.reason) for change in changes] for changes in expected.changes.values()]


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(
    ("old_name", "name"),
    [("facet-to-facet sliding", "sliding-facet-on-facet"), ("sliding_with_gaps", "sliding-node-on-facet")],
)
def test_names_of_older_formats_are_taken(tmp_path, version, old_name, name):
    text = of_kinds(Kind.ELASTIC, Kind.ELASTIC).model().text().replace('"sliding-mixture"', f'"{name}"')
    path = write(tmp_path, text, version)
    path.write_text(path.read_text(encoding="iso-8859-1").replace(f'"{name}"', f'"{old_name}"'))
    unnamed = re.sub(rf'<contact name="[^"]*" type="{old_name}"', f'<contact type="{old_name}"', path.read_text())
    assert place(read(in_file(tmp_path, unnamed)).contacts[0].tag).tag == f'<contact type="{old_name}">'
    made = convert(path)
    assert made.data.count(b'type="sliding-mixture"') == 1
    assert next(iter(made.changes.values()))[0].reason == f"{old_name} becomes sliding-mixture"
    newest = write(tmp_path, text.replace(f'"{name}"', f'"{old_name}"'))
    with pytest.raises(ModelError, match=r"has no sliding contact|is unknown"):
        convert(newest)


NODE_SETS = {
    "a list": "1,2,3,4",
    "a range": "1:4",
    "ranges in a tag": "<node_list>1:3</node_list><n id='4'/>",
    "other sets": "<NodeSet node_set='half'/><node id='3'/><node id='4'/>",
    "other sets by their names": "<node_set>half</node_set><node id='3'/><node id='4'/>",
}


@pytest.mark.parametrize("name", NODE_SETS)
def test_node_sets_are_read_in_all_their_forms(tmp_path, name):
    text = older(TEXTS["diffusion"], "2.5")
    old = re.search(r'<NodeSet name="bottom">.*?</NodeSet>', text, re.DOTALL).group(0)
    half = '<NodeSet name="half"><node id="1"/><node id="2"/></NodeSet>'
    path = tmp_path / "model.feb"
    path.write_text(text.replace(old, f'{half}<NodeSet name="bottom">{NODE_SETS[name]}</NodeSet>'))
    assert read(path).mesh.node_sets["bottom"].tolist() == [0, 1, 2, 3]


def test_parts_without_names_and_materials_by_name(tmp_path):
    text = older(of_kinds(Kind.RIGID, Kind.BIPHASIC).model().text(), "2.5")
    path = tmp_path / "model.feb"
    path.write_text(re.sub(r'(<Elements[^>]*?) name="\w+"', r"\1", text))
    kinds = [material.kind for material in read(path).block_materials]
    assert kinds == ["rigid body", "biphasic"]
    names = re.findall(r'<material id="(\d)" name="(\w+)"', text)
    for number, name in names:
        text = text.replace(f'mat="{number}"', f'mat="{name}"')
    path.write_text(text)
    assert [material.kind for material in read(path).block_materials] == kinds


@pytest.mark.parametrize("version", VERSIONS)
def test_run_knows_the_contacts_and_the_end(tmp_path, version):
    newest, path = (write(tmp_path, TEXTS["diffusion"], each) for each in ("4.0", version))
    assert replace(febfile.inspect(path), path=newest) == febfile.inspect(newest)


def test_run_knows_the_contacts_of_included_files(tmp_path):
    text = older(TEXTS["diffusion"], "2.5")
    contact = re.search(r"<Contact>.*?</Contact>", text, re.DOTALL).group(0)
    (tmp_path / "contact.feb").write_text(f'<?xml version="1.0"?><febio_spec version="2.5">{contact}</febio_spec>')
    path = tmp_path / "model.feb"
    path.write_text(text.replace(contact, "<Include>contact.feb</Include>"))
    assert febfile.inspect(path).contacts == ("sliding-mixture",)


def test_files_that_a_file_names_stand_beside_the_model(tmp_path):
    """FEBio looks there, wherever the file that names them is."""
    text = older(TEXTS["diffusion"], "3.0")
    contact = re.search(r"<Contact>.*?</Contact>", text, re.DOTALL).group(0)
    head = '<?xml version="1.0"?><febio_spec version="3.0">'
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "outer.feb").write_text(f"{head}<Include>contact.feb</Include></febio_spec>")
    (tmp_path / "contact.feb").write_text(f"{head}{contact}</febio_spec>")
    path = tmp_path / "model.feb"
    path.write_text(text.replace(contact, "<Include>parts/outer.feb</Include>"))
    assert len(read(path).contacts) == 1


REFUSED = {
    "a set that does not exist": (
        "2.5",
        '<NodeSet name="bottom">',
        '<NodeSet name="bottom"><NodeSet node_set="roof"/>',
        r"line \d+: <NodeSet>: names node set 'roof', which does not exist; there is none before it",
    ),
    "a node without a number": (
        "3.0",
        '<NodeSet name="bottom">',
        '<NodeSet name="bottom"><n/>',
        r"line \d+: <n>: has no attribute 'id', which FEBio needs",
    ),
    "a side without a surface": ("2.5", "<master surface", "<master face", r"<master>: has no attribute 'surface'"),
    "a part without a material": ("2.5", ' mat="1"', "", r"<Elements name=.*: has no attribute 'mat'"),
    "a material that does not exist": ("2.5", 'mat="1"', 'mat="9"', r"<Elements name=.*names material '9'"),
    "a condition of no set": ("2.5", '<fix bc="x,y" node_set="all"', '<fix bc="x,y"', r'<fix bc="x,y">: has no attr'),
    "a condition of nothing": ("2.5", '<fix bc="x,y"', "<fix", r"line \d+: <fix>: has no attribute 'bc'"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_read_is_explained(tmp_path, name):
    version, old, new, message = REFUSED[name]
    text = older(TEXTS["diffusion"], version)
    assert old in text
    path = tmp_path / "model.feb"
    path.write_text(text.replace(old, new))
    with pytest.raises(ModelError, match=message):
        check(path)


UNTURNED = "<rotate>0,0,0,1</rotate>"
INSTANCES = {
    "a part": ('<Instance part="lower"', '<Instance part="roof"', r"names part 'roof', which .*; there is lower"),
    "a surface": ('surface="lower.lower-top"', 'surface="roof"', r"names surface 'roof', .*; there is lower\.bottom"),
    "a rotation": (UNTURNED, '<rotate type="axis"/>', r"<rotate .*'axis'; there is quaternion, vector, E"),
    "too few numbers": (UNTURNED, "<rotate>1,2</rotate>", r"<rotate>: is '1,2'; 4 numbers"),
    "a node without a number": ('<node id="1">', "<node>", r"<node>: has no attribute 'id'"),
    "no word for a number": ('<elem id="1">', '<elem id="one">', r"<elem id=\"one\">: its id is not a number"),
}


@pytest.mark.parametrize("name", INSTANCES)
def test_what_instances_lack_is_explained(tmp_path, name):
    old, new, message = INSTANCES[name]
    text = re.sub(r">\s+<", "><", in_instances(TEXTS["diffusion"], "2.5", UNTURNED, ""))
    assert old in text
    path = tmp_path / "model.feb"
    path.write_text(text.replace(old, new))
    with pytest.raises(ModelError, match=rf"model\.feb, line \d+: .*{message}"):
        check(path)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", ["diffusion", "held", "adrift", "adrift, rigid"])
def test_instances_of_parts_are_one_mesh(tmp_path, name, version):
    path, newest = tmp_path / "parts.feb", write(tmp_path, TEXTS[name])
    path.write_text(in_instances(TEXTS[name], version), encoding="iso-8859-1")
    assert said(path) == said(newest)
    meshes = [read(each).mesh for each in (path, newest)]
    assert (meshes[0].points == meshes[1].points).all()
    assert meshes[0].node_sets["bottom"].tolist() == meshes[1].node_sets["bottom"].tolist()
    for side in ("primary", "secondary"):
        one, other = (getattr(mesh.pairs["lower/upper"], side).corners for mesh in meshes)
        assert (one == other).all()


def test_parts_of_other_files_and_parts_that_are_instances(tmp_path):
    text = in_instances(TEXTS["diffusion"], "2.5")
    part = re.search(r'<Part name="lower">.*?</Part>', text, re.DOTALL).group(0)
    instance = re.search(r'<Instance part="lower">.*?</Instance>', text, re.DOTALL).group(0)
    text = text.replace(instance, "").replace(part, '<Part name="lower" type="instance" from="part.feb"/>')
    path, other = tmp_path / "model.feb", tmp_path / "part.feb"
    path.write_text(text)
    geometry = '<?xml version="1.0"?><febio_spec version="2.5"><Geometry>{}</Geometry></febio_spec>'
    other.write_text(geometry.format(part.replace('name="body"', 'name="body" mat="gel"')))
    assert said(path) == said(write(tmp_path, TEXTS["diffusion"]))
    other.write_text(geometry.format(""))
    with pytest.raises(ModelError, match=r'<Part name="lower">: refers to .*part\.feb, which has no such'):
        check(path)


def test_convert_leaves_instances_as_they_are(tmp_path):
    path = tmp_path / "model.feb"
    path.write_text(in_instances(TEXTS["held"], "2.5"), encoding="iso-8859-1")
    lines = changed_lines(path.read_bytes(), convert(path).data)
    assert lines == changed_lines(TEXTS["held"].encode(), convert(write(tmp_path, TEXTS["held"])).data)


def test_files_of_one_model_have_one_format(tmp_path):
    (tmp_path / "contact.feb").write_text('<?xml version="1.0"?>\n<febio_spec version="2.5"></febio_spec>')
    path = tmp_path / "model.feb"
    path.write_text(TEXTS["diffusion"].replace("<Output>", "<Include>contact.feb</Include><Output>"))
    with pytest.raises(ModelError, match=r"contact\.feb, line 2: <febio_spec>: has version '2\.5'; .*one version"):
        check(path)
