"""`convert` changes what it must and leaves every other byte, or refuses. Nothing here needs FEBio."""

from __future__ import annotations

import difflib
import re
from dataclasses import replace

import pytest
from scenes import pairs
from scenes.ambient import Apart

from harness.conversion import spans
from harness.conversion.command import convert as command
from harness.conversion.convert import convert
from harness.conversion.fates import DROPPED, Action
from harness.conversion.spans import Edit
from harness.errors import HarnessError, ModelError
from harness.models.confined import Confined
from harness.models.diffusion import Diffusion
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Param, concentration, pressure
from harness.paths import REPOSITORY
from harness.preflight import byte_spans
from harness.preflight.contact_types import CONVERTIBLE, TYPES, UNLIMITED_SEARCH
from harness.preflight.model import read
from studies.models.sheared_blocks import Kind


def text(*params, interface=InterfaceType.SOLUTE):
    return Diffusion(interface, ContactSettings(extra=params), elements=2).model().text()


@pytest.fixture
def converted(tmp_path):
    """What becomes of a text."""

    def run(old):
        path = tmp_path / "model.feb"
        path.write_bytes(old if isinstance(old, bytes) else old.encode("iso-8859-1"))
        return convert(path)

    return run


def changed_lines(old, new):
    lines = difflib.ndiff(old.splitlines(), new.splitlines())
    return [line for line in lines if line.startswith(("+ ", "- "))]


def fates(made):
    return {change.name: change.action for changes in made.changes.values() for change in changes}


def test_tags_over_several_lines_and_comments_in_values_are_read_as_febio_reads_them(converted):
    old = text(Param("penalty", 10)).replace('" surface_pair', '"\n  surface_pair', 1)
    old = old.replace("<penalty>10<", "<penalty><!-- ten -->10<")
    made = converted(old)
    assert fates(made)["penalty"] is Action.KEPT
    assert '"sliding-mixture"\n  surface_pair' in made.data.decode("iso-8859-1")
    assert "<penalty><!-- ten -->10</penalty>" in made.data.decode("iso-8859-1")


def test_defaults_are_written_out_and_the_rest_stays(converted):
    old = text()
    new = converted(old).data.decode("iso-8859-1")
    assert changed_lines(old, new) == [
        '-     <contact name="lower/upper" type="sliding-biphasic-solute" surface_pair="lower/upper"/>',
        '+     <contact name="lower/upper" type="sliding-mixture" surface_pair="lower/upper">',
        "+       <penalty>1</penalty>",
        "+       <pressure_penalty>1</pressure_penalty>",
        "+       <concentration_penalty>1</concentration_penalty>",
        "+     </contact>",
    ]


def test_the_default_radius_is_written_where_it_limits_gaps_that_bear_load(converted):
    for tension, radius in (((), b""), ((Param("tension", 1.0),), b"<search_radius>1</search_radius>")):
        made = converted(in_module(solid(*tension), "sliding-elastic"))
        assert (b"search_radius" in made.data) == bool(radius)
        assert radius in made.data


def test_comments_quotes_spaces_tabs_and_line_ends_stay(converted):
    old = text(Param("penalty", 2.0), Param("knmult", 0.0), Param("search_radius", 2.0))
    old = old.replace('type="sliding-biphasic-solute"', "type = 'sliding-biphasic-solute'")
    old = old.replace("<penalty>", "<!-- measured: see thesis, p. 31 > 30 --><penalty  >").replace("\n", "\r\n")
    old = old.replace("      <knmult>", "\t<knmult>")
    made = converted(old.encode("iso-8859-1"))
    expected = old.replace("'sliding-biphasic-solute'", "'sliding-mixture'").replace("\t<knmult>0</knmult>\r\n", "")
    start = 'surface_pair="lower/upper">'
    written = "".join(f"\r\n      <{name}>1</{name}>" for name in ("pressure_penalty", "concentration_penalty"))
    head, tail = expected.split(start)
    assert made.data.decode("iso-8859-1") == head + start + written + tail


def test_two_parameters_on_a_line(converted):
    old = text(Param("penalty", 2.0), Param("knmult", 0.0))
    old = re.sub(r"</penalty>\s*<knmult>", "</penalty> <knmult>", old)
    new = converted(old).data.decode("iso-8859-1")
    assert "<penalty>2</penalty> \n" in new
    assert "knmult" not in new


def test_characters_that_are_not_ascii_stay(converted):
    old = text().replace("Transient", "Gäu: transient")
    assert "Gäu: transient" in converted(old).data.decode("iso-8859-1")


def test_every_parameter_of_every_type_has_a_fate(converted):
    values = {"laugon": "PENALTY", "penalty_sf": 2.0, "max_penalty_sf": 100.0, "minaug": 1, "maxaug": 5}
    off = ("fric_coeff", "offset", "tension", "shell_bottom_primary", "shell_bottom_secondary")
    kind = TYPES["sliding-biphasic-solute"]
    params = [Param(name, values.get(name, 0.0 if name in off else 1)) for name in sorted(kind.parameters)]
    found = fates(converted(text(*params).replace("<node_reloc>1", "<node_reloc>0")))
    assert set(found) - {"type"} == set(kind.parameters)
    assert {name for name, action in found.items() if action is Action.DROPPED} == (
        set(DROPPED) & set(kind.parameters)
    ) | {"symmetric_stiffness"}


def test_names_of_solutes_stay(converted):
    old = text(Param("ambient_concentration", 0.0, None, {"sol": "s1"}), interface=InterfaceType.MULTIPHASIC)
    new = converted(old).data.decode("iso-8859-1")
    assert '<ambient_concentration sol="s1">0</ambient_concentration>' in new


def with_curve(old, name):
    """A text in which a parameter has a load curve."""
    assert f"<{name}>" in old
    controller = '<load_controller id="1" type="loadcurve"><points><pt>0,1</pt><pt>1,2</pt></points></load_controller>'
    return old.replace(f"<{name}>", f'<{name} lc="1">').replace(
        "<Output>", f"<LoadData>{controller}</LoadData><Output>"
    )


@pytest.mark.parametrize(
    "name", ["penalty", "pressure_penalty", "concentration_penalty", "tolerance", "gaptol", "ctol"]
)
def test_load_curves_of_penalties_and_tolerances_stay(converted, name):
    new = converted(with_curve(text(Param(name, 2.0)), name)).data.decode("iso-8859-1")
    assert f'<{name} lc="1">2</{name}>' in new


@pytest.mark.parametrize("kind", [kind for kind in CONVERTIBLE if not TYPES[kind].solvent])
def test_fluid_stays_where_the_type_leaves_it(converted, kind):
    porous = fates(converted(in_module(Confined(InterfaceType.BIPHASIC, ContactSettings(), elements=2).model(), kind)))
    assert {porous["effects"], porous["free_draining"]} == {Action.MAPPED}
    assert not {"effects", "free_draining"} & set(fates(converted(in_module(solid(), kind))))


RUBBING = (Param("fric_coeff", 0.1), Param("contact_frac", 0.2), Param("smooth_fls", True))


def confined(*params):
    return Confined(InterfaceType.BIPHASIC, ContactSettings(extra=params), elements=2).model().text()


def test_friction_stays_with_its_values(converted):
    made = converted(confined(*RUBBING))
    new, found = made.data.decode("iso-8859-1"), fates(made)
    assert "<fric_coeff>0.1</fric_coeff>" in new
    assert "<contact_frac>0.2</contact_frac>" in new
    assert found["smooth_fls"] is Action.DROPPED
    reasons = {change.name: change.reason for changes in made.changes.values() for change in changes}
    assert "at nodes" in reasons["fric_coeff"]
    assert "instead of a coefficient with a quotient" in reasons["fric_coeff"]
    assert "ambient" in reasons["contact_frac"]


def test_parameters_of_friction_go_where_there_is_none(converted):
    found = fates(converted(confined(Param("fric_coeff", 0.0), *RUBBING[1:])))
    assert {found["contact_frac"], found["smooth_fls"]} == {Action.DROPPED}


@pytest.mark.parametrize(("penalty", "stays"), [((), False), ((Param("fric_penalty", 10.0),), True)])
def test_friction_of_the_node_based_type_needs_its_penalty(converted, penalty, stays):
    made = converted(in_module(solid(Param("fric_coeff", 0.1), *penalty), "sliding-node-on-facet"))
    assert ("<fric_coeff>0.1</fric_coeff>" in made.data.decode("iso-8859-1")) == stays


def test_friction_of_types_without_fluid_acts_on_all_traction(converted):
    rubbing = Param("fric_coeff", 0.1)
    porous, elastic = (
        converted(made.replace('type="sliding-biphasic"', 'type="sliding-elastic"')).data.decode("iso-8859-1")
        for made in (confined(rubbing), in_module(solid(rubbing), "sliding-elastic"))
    )
    assert "<contact_frac>1</contact_frac>" in porous
    assert "<effects>traction,friction</effects>" in porous
    assert "<contact_frac>" not in elastic


@pytest.mark.parametrize("kind", UNLIMITED_SEARCH)
def test_types_without_normals_are_taken(converted, kind):
    """Hidden parameters go."""
    hidden = {"sliding-facet-on-facet": ("dxtol", "fric_penalty", "fric_coeff"), "sliding-node-on-facet": ("ktmult",)}
    made = converted(in_module(solid(*(Param(name, 1.0) for name in hidden[kind])), kind))
    new = made.data.decode("iso-8859-1")
    assert "<penalty>1</penalty>" in new
    assert {name for name, action in fates(made).items() if action is Action.DROPPED} == set(hidden[kind])


@pytest.mark.parametrize("kind", [InterfaceType.SOLUTE, InterfaceType.BIPHASIC])
@pytest.mark.parametrize("name", ["penalty", "pressure_penalty", "search_radius"])
def test_zeros_stay_and_are_spoken_of(converted, kind, name):
    model = Diffusion if kind is InterfaceType.SOLUTE else Confined
    made = converted(model(kind, ContactSettings(extra=(Param(name, 0.0),)), elements=2).model().text())
    assert f"<{name}>0</{name}>".encode() in made.data
    reason = next(c.reason for changes in made.changes.values() for c in changes if c.name == name)
    assert "as in FEBio" in reason or reason.startswith("FEBio finds no facets")


def test_contacts_in_steps(converted):
    old = re.sub(
        r"<Contact>.*?</Contact>", r'<Step><step id="1" name="one">\g<0></step></Step>', text(), flags=re.DOTALL
    )
    assert b'type="sliding-mixture"' in converted(old).data


def test_nodes_held_at_the_ambient_value_are_spoken_of(converted):
    made = converted(Apart(InterfaceType.SOLUTE, held=(pressure("lower-top", -1e-3, 1),)).model().text())
    assert [change.name for change in made.changes["boundary conditions"]] == ["fluid pressure"]
    assert "4 nodes" in made.changes["boundary conditions"][0].reason


def test_nodes_held_at_another_value_stay_and_are_spoken_of(converted):
    old = Apart(InterfaceType.SOLUTE, held=(pressure("lower-top", 1.0), concentration("upper-bottom", 0.7))).model()
    made = converted(old.text())
    assert [change.name for change in made.changes["boundary conditions"]] == [
        "fluid pressure",
        "concentration of solute 1",
    ]
    for change in made.changes["boundary conditions"]:
        assert change.action is Action.KEPT
        assert "sets the ambient value where they are open" in change.reason


def test_the_plot_file_is_spoken_of(converted):
    old = text().replace("</Output>", '<plotfile type="febio"><var type="concentration gap"/></plotfile></Output>')
    made = converted(old)
    assert "contact solute jump" in made.changes["output"][0].reason


def solid(*params):
    """Two elastic blocks."""
    pair = replace(pairs.of_kinds(Kind.ELASTIC, Kind.ELASTIC), settings=ContactSettings(extra=params))
    return pair.model()


def in_module(model, kind, module=None):
    made = (
        model.text()
        .replace("sliding-biphasic-solute", kind)
        .replace("sliding-mixture", kind)
        .replace('type="sliding-biphasic"', f'type="{kind}"')
    )
    return made.replace('<Module type="solute"', f'<Module type="{module}"') if module else made


BIPHASIC = Confined(InterfaceType.BIPHASIC, ContactSettings(), elements=2).model()
SOLUTE = Diffusion(InterfaceType.SOLUTE, ContactSettings(), elements=2).model()
REFUSED = {
    "friction of a type without it": (text(Param("fric_coeff", 0.1)), "no parameter <fric_coeff>"),
    "friction that pushes": (
        Confined(InterfaceType.BIPHASIC, ContactSettings(extra=(Param("fric_coeff", -0.1),)), elements=2)
        .model()
        .text(),
        "fric_coeff",
    ),
    "solutes behind sliding-biphasic": (in_module(SOLUTE, "sliding-biphasic"), "impermeable to solutes"),
    "a material that the type takes for a solid": (
        in_module(SOLUTE, "sliding-biphasic-solute").replace(' type="biphasic-solute">', ' type="multiphasic">'),
        "treats it as a solid without fluid",
    ),
    "nothing to convert": (text(interface=InterfaceType.MIXTURE), "has nothing to convert"),
    "an unknown parameter": (text(Param("penlaty", 2.0)), "no parameter <penlaty>"),
    "a load curve of a radius": (
        with_curve(text(Param("search_radius", 2.0)), "search_radius"),
        "cannot change in a run",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_other_physics_is_refused(converted, name):
    old, reason = REFUSED[name]
    with pytest.raises(ModelError, match=reason):
        converted(old)


def test_enforcement_is_read_without_case_as_febio_does(converted):
    made = converted(text(Param("laugon", "auglag")))
    assert fates(made)["laugon"] is Action.KEPT


def test_true_is_off_as_in_febio(converted):
    made = converted(text(Param("auto_penalty", "True"), Param("symmetric_stiffness", "True")))
    assert {fates(made)[name] for name in ("auto_penalty", "symmetric_stiffness")} == {Action.KEPT}


def test_a_contact_without_parameters_becomes_one_that_febio_reads(converted):
    made = converted(re.sub(r"(<contact [^>]*>).*?</contact>", r"\1</contact>", text(), flags=re.DOTALL))
    assert b"<penalty>1</penalty>" in made.data


def test_refusals_name_lines_of_the_file_that_is_there(converted, tmp_path):
    """Lines that would be written come before the one that is refused, and others go."""
    old = text(Param("knmult", 1.0), Param("maxaug", 1.0), Param("minaug", 2.0))
    line = 1 + old[: old.index("<maxaug>")].count("\n")
    with pytest.raises(ModelError, match=rf"model\.feb, line {line}: <maxaug>: <maxaug> is less than <minaug>"):
        converted(old)


@pytest.mark.parametrize("line", range(1, 8))
def test_lines_of_edited_files_are_found_again(line):
    old = b"one\ntwo\nthree\nfour\nfive\n"
    edits = [Edit(4, 4, b"new\nnewer\n"), Edit(8, 14, b"")]
    new = spans.apply(old, edits).split(b"\n")
    found = old.split(b"\n")[spans.line_before(old, edits, line) - 1]
    at_line = new[line - 1] if line <= len(new) else b""
    assert found == (b"two" if at_line.startswith(b"new") else at_line)


HEAD = '<?xml version="1.0"?>\n<febio_spec version="4.0">\n'
READ_BY = ('<Contact from="contact.feb"/>', "<Include>contact.feb</Include>")


def in_pieces(folder, read_by, *between):
    """A model whose contact stands in a file of its own, which it reads itself or by way of other files."""
    folder.mkdir(exist_ok=True)
    whole = text(Param("penalty", 2.0), Param("knmult", 0.0))
    contact = re.search(r"<Contact>.*?</Contact>", whole, re.DOTALL).group(0)
    (folder / "contact.feb").write_text(f"{HEAD}{contact}</febio_spec>")
    for name in between:
        (folder / name).write_text(f"{HEAD}<!-- other pieces -->{read_by}</febio_spec>")
        read_by = f"<Include> {name}</Include>"
    path = folder / "model.feb"
    path.write_text(whole.replace(contact, read_by), encoding="iso-8859-1")
    return path


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def written(made, folder, name):
    """Writes a converted model as the command does."""
    for path, data in made.included.items():
        path.write_bytes(data)
    (folder / name).write_bytes(made.data)


@pytest.mark.parametrize("read_by", READ_BY)
def test_an_included_contact_comes_into_a_new_file_beside_it(tmp_path, converted, read_by):
    path = in_pieces(tmp_path / "pieces", read_by)
    before = contents(path.parent)
    made = convert(path)
    assert contents(path.parent) == before
    old, new = (data.decode("iso-8859-1") for data in (before["model.feb"], made.data))
    assert new == old.replace("contact.feb", "contact-mixture.feb")
    ((name, piece),) = made.included.items()
    assert name == path.parent / "contact-mixture.feb"
    whole = text(Param("penalty", 2.0), Param("knmult", 0.0))
    one = converted(whole).data.decode("iso-8859-1")
    assert changed_lines(before["contact.feb"].decode(), piece.decode()) == changed_lines(whole, one)
    assert [title for title in made.changes if "in " in title] == [
        f'contact "lower/upper" in {path.parent / "contact.feb"}'
    ]
    written(made, path.parent, "new.feb")
    assert [contact.kind.name for contact in read(path.parent / "new.feb").contacts] == ["sliding-mixture"]


def test_files_between_read_the_new_file(tmp_path):
    path = in_pieces(tmp_path, READ_BY[0], "inner.feb", "outer.feb")
    before = contents(tmp_path)
    made = convert(path)
    assert {name.name for name in made.included} == {
        "contact-mixture.feb",
        "inner-mixture.feb",
        "outer-mixture.feb",
    }
    for name, other in (("inner", "contact"), ("outer", "inner")):
        old = before[f"{name}.feb"].replace(f"{other}.feb".encode(), f"{other}-mixture.feb".encode())
        assert made.included[tmp_path / f"{name}-mixture.feb"] == old
    written(made, tmp_path, "new.feb")
    assert [contact.kind.name for contact in read(tmp_path / "new.feb").contacts] == ["sliding-mixture"]


@pytest.mark.parametrize("encoding", ["utf-8", "iso-8859-1"])
@pytest.mark.parametrize("read_by", READ_BY)
def test_names_that_are_not_ascii_stay(tmp_path, read_by, encoding):
    path = in_pieces(tmp_path, read_by)
    (tmp_path / "contact.feb").rename(tmp_path / "Kontakt ä.feb")
    old = path.read_text(encoding="iso-8859-1").replace("contact.feb", "Kontakt ä.feb").replace("ISO-8859-1", encoding)
    path.write_text(old, encoding=encoding)
    made = convert(path)
    assert made.data.decode(encoding) == old.replace("Kontakt ä.feb", "Kontakt ä-mixture.feb")
    assert [name.name for name in made.included] == ["Kontakt ä-mixture.feb"]


def test_names_with_entities_are_refused(tmp_path):
    path = in_pieces(tmp_path, READ_BY[0])
    path.write_text(path.read_text(encoding="iso-8859-1").replace('"contact.feb"', '"contact&#46;feb"'))
    with pytest.raises(
        ModelError, match=r"model\.feb, line \d+: <Contact>: writes the name 'contact\.feb' with entities"
    ):
        convert(path)


def test_other_included_files_are_read_as_before(tmp_path):
    path = in_pieces(tmp_path, READ_BY[1])
    whole = path.read_text(encoding="iso-8859-1")
    mesh = re.search(r"<Mesh>.*?</Mesh>", whole, re.DOTALL).group(0)
    (tmp_path / "mesh.feb").write_text(f"{HEAD}{mesh}</febio_spec>")
    path.write_text(whole.replace(mesh, '<Mesh from="mesh.feb"/>'), encoding="iso-8859-1")
    made = convert(path)
    assert b'<Mesh from="mesh.feb"/>' in made.data
    assert {name.name for name in made.included} == {"contact-mixture.feb"}


@pytest.mark.parametrize("in_place", [False, True])
def test_the_command_writes_all_files_and_leaves_included_ones(tmp_path, in_place):
    path = in_pieces(tmp_path, READ_BY[0])
    before = contents(tmp_path)
    command(path, in_place=in_place)
    new = contents(tmp_path)
    target = "model.feb" if in_place else "model-mixture.feb"
    assert set(new) - set(before) == {"contact-mixture.feb", target} - set(before)
    assert {name for name in before if new[name] != before[name]} == ({"model.feb"} if in_place else set())
    assert b"contact-mixture.feb" in new[target]


def test_a_model_of_pieces_stays_in_its_folder(tmp_path):
    path = in_pieces(tmp_path, READ_BY[1])
    before = contents(tmp_path)
    with pytest.raises(HarnessError, match=r"reads contact\.feb from its folder"):
        command(path, tmp_path / "elsewhere" / "model.feb")
    assert contents(tmp_path) == before


def test_no_folder_is_made_and_no_file_of_the_model_is_written_over(tmp_path):
    path = tmp_path / "model.feb"
    path.write_text(text())
    with pytest.raises(HarnessError, match="there is no folder"):
        command(path, tmp_path / "elsewhere" / "model.feb")
    with pytest.raises(HarnessError, match="is a folder"):
        command(path, tmp_path)
    with pytest.raises(HarnessError, match=r"ends in \.feb"):
        command(path, tmp_path / "converted.txt")
    assert contents(tmp_path).keys() == {"model.feb"}
    pieces = in_pieces(tmp_path / "pieces", READ_BY[1])
    with pytest.raises(HarnessError, match=r"reads .*contact\.feb; name another --output"):
        command(pieces, pieces.parent / "contact.feb")


def test_nothing_of_a_name_that_is_taken_is_lost(tmp_path):
    path = in_pieces(tmp_path, READ_BY[1])
    (tmp_path / "contact-mixture.feb").write_text("something else")
    before = contents(tmp_path)
    with pytest.raises(HarnessError, match=r"contact-mixture\.feb, for the contacts of an included file, exists"):
        command(path)
    assert contents(tmp_path) == before


def test_converting_again_finds_the_same_file(tmp_path):
    path = in_pieces(tmp_path, READ_BY[1])
    for name in ("one.feb", "two.feb"):
        command(path, tmp_path / name)
    assert (tmp_path / "one.feb").read_bytes() == (tmp_path / "two.feb").read_bytes()


@pytest.mark.parametrize("name", CONVERTIBLE)
def test_what_stays_of_a_type_is_a_parameter_of_the_contact(name):
    assert TYPES[name].parameters - DROPPED.keys() <= TYPES["sliding-mixture"].parameters


COLUMNS = [kind for kind in CONVERTIBLE if kind not in ("sliding-biphasic-mixed", "sliding2")]


def test_the_migration_page_tells_the_same():
    page = (REPOSITORY / "docs" / "reference" / "from-febio.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (`.+?) \|(.*?)\|(.*?)\|(.*?)\|(.*?)\|(.*?)\|(.*?)\|", page, re.MULTILINE)
    assert len(rows) > 20
    for cell, *marks in rows:
        for name in re.findall(r"`([^`]+)`", cell):
            there = [mark.strip() == "x" for mark in marks]
            assert there == [name in TYPES[kind].parameters for kind in COLUMNS], name
    assert TYPES["sliding-biphasic-mixed"].parameters == TYPES["sliding-biphasic"].parameters
    assert TYPES["sliding2"].parameters - {"dual_proj"} < TYPES["sliding-biphasic"].parameters


@pytest.mark.parametrize("text", ["<a><b/></a>", "<a><b /></a>", "<a>\n<b/>\n</a>"])
def test_an_element_that_is_closed_in_itself_ends_there(text):
    child = byte_spans.locate(text.encode()).children[0]
    assert child.closed_in_itself
    assert text[child.start : child.end] in ("<b/>", "<b />")
    assert spans.apply(text.encode(), spans.insertion(text.encode(), child, ["<c/>"])).count(b"</b>") == 1
