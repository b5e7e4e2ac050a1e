"""Models and their files; no run is needed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lxml import etree
from scenes.ambient import Apart, HalfWet
from scenes.patches import Patches

import harness.collection.command
from harness.errors import ModelError
from harness.models.blocks import boundary
from harness.models.diffusion import Diffusion
from harness.models.interface import PAPER, InterfaceType, automatic
from harness.models.mesh import Layer, Section, conforming_column, split_column
from harness.models.parts import Control, Param, fix
from harness.paths import MODELS, REPOSITORY
from harness.post import compare
from harness.run import febfile
from studies.models import kept_models as collection
from studies.models import spherical_shells
from studies.models.tetrahedra import tetrahedra

LAYERS = [Layer("a", "m", 1.0, 3), Layer("b", "m", 0.5, 2), Layer("c", "m", 2.0, 1)]
SECTION = Section((2.0, 1.0), (3, 2))


def volumes(mesh):
    """Signed volume of each hexahedron, from its edges at the first node."""
    corner = [mesh.nodes[part.elements - 1] for part in mesh.parts]
    found = [np.linalg.det(np.stack([x[:, k] - x[:, 0] for k in (1, 3, 4)], axis=1)) for x in corner]
    return np.concatenate(found)


@pytest.mark.parametrize("build", [split_column, conforming_column])
def test_columns_fill_their_space(build):
    mesh = build(LAYERS, bottom=-1.0, section=SECTION)
    assert np.all(volumes(mesh) > 0.0)
    assert volumes(mesh).sum() == pytest.approx(2.0 * 3.5)
    assert mesh.nodes[:, 2].min() == -1.0
    assert mesh.nodes[:, 2].max() == pytest.approx(2.5)


@pytest.mark.parametrize("build", [split_column, conforming_column])
def test_surfaces_face_outwards(build):
    mesh = build(LAYERS, bottom=0.0, section=SECTION)
    for name, facets in mesh.surfaces.items():
        x = mesh.nodes[facets - 1]
        normal = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
        assert np.all(normal[:, 2] > 0.0) == name.endswith("top"), name


def test_a_conforming_column_has_the_nodes_of_the_split_one():
    split, conforming = (build(LAYERS, bottom=0.0, section=SECTION) for build in (split_column, conforming_column))
    same = compare.counterparts(split, conforming)
    np.testing.assert_allclose(split.nodes, conforming.nodes[same], atol=1e-12)
    assert len(split.nodes) - len(conforming.nodes) == 2 * 12
    assert set(same) == set(range(len(conforming.nodes)))
    for name in ("bottom", "top", "b-top", "c-bottom"):
        assert set(same[split.node_sets[name] - 1] + 1) == set(conforming.node_sets[name])


def test_facing_nodes_are_at_one_place():
    mesh = split_column(LAYERS, bottom=0.0, section=SECTION)
    below, above = compare.facing(mesh, "a/b")
    np.testing.assert_allclose(mesh.nodes[below - 1], mesh.nodes[above - 1])


@pytest.mark.parametrize(("thickness", "elements"), [(0.0, 1), (-1.0, 2), (1.0, 0)])
def test_a_layer_needs_a_size(thickness, elements):
    with pytest.raises(ModelError, match="'thin' needs a size"):
        split_column([Layer("thin", "m", thickness, elements)], bottom=0.0)


def test_committed_models_are_what_the_generator_writes():
    made = {f"{model.name}.feb": model.text() for model in collection.every_model()}
    assert made == {path.name: path.read_text() for path in MODELS.glob("*.feb")}


def test_a_wheel_has_the_models_where_the_command_looks_for_them():
    place = Path(harness.collection.command.__file__).with_name("models").relative_to(REPOSITORY / "scripts")
    assert f'models = "{place.as_posix()}"\n' in (REPOSITORY / "pyproject.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("path", sorted(MODELS.glob("*.feb")), ids=lambda path: path.stem)
def test_a_model_refers_to_each_of_its_load_controllers(path):
    root = etree.parse(path).getroot()
    controllers = {controller.get("id") for controller in root.iterfind("LoadData/load_controller")}
    assert controllers == {tag.get("lc") for tag in root.iter() if tag.get("lc") is not None}


@pytest.mark.parametrize("model", collection.models(), ids=lambda model: model.name)
def test_model_files_say_what_a_reader_needs(model):
    head = model.text().split("-->")[0]
    for words in (
        "The units are mm, N, s, nmol",
        f"models/{model.name}.feb",
        "-import build/lib/libFEBioMixtureContact.so",
    ):
        assert words in head
    assert max(map(len, head.splitlines())) <= 121


@pytest.mark.parametrize("interface", list(InterfaceType))
def test_the_interface_is_a_parameter(interface):
    root = etree.fromstring(Diffusion(interface, PAPER, elements=2).model().text().encode())
    types = [contact.get("type") for contact in root.iter("contact")]
    assert types == ([interface.value] if interface.is_contact else [])
    module = root.find("Module")
    assert module is not None
    assert module.get("type") == interface.module


def test_only_the_settings_that_are_given_are_written():
    contact = Diffusion(InterfaceType.MIXTURE, elements=1).model().contacts[0]
    assert contact.params == ()
    contact = Diffusion(InterfaceType.MIXTURE, automatic(10.0), elements=1).model().contacts[0]
    assert {p.tag: p.value for p in contact.params} == {
        "laugon": "PENALTY",
        "auto_penalty": True,
        "penalty": 10.0,
        "pressure_penalty": 10.0,
        "concentration_penalty": 10.0,
    }


@pytest.mark.parametrize("module", ["solute", "multiphasic"])
def test_the_scenes_are_complete(module):
    interface = InterfaceType.MULTIPHASIC if module == "multiphasic" else InterfaceType.SOLUTE
    for scene in (Apart(interface), HalfWet(interface), Patches(interface), Patches(interface, divided=False)):
        assert "<SurfacePair" in scene.model().text()


def test_names_that_lead_nowhere_are_refused():
    model = Diffusion(InterfaceType.MIXTURE, elements=1).model()
    with pytest.raises(ModelError, match=r"refers to 'roof'; there is .*bottom"):
        replace(model, conditions=(fix("roof", "z"),)).text()
    with pytest.raises(ModelError, match="module 'salt' is not one of solid, biphasic, solute, multiphasic"):
        replace(model, module="salt").text()
    contact = replace(model.contacts[0], params=(Param("ambient_pressure", 1.0, 3),))
    with pytest.raises(ModelError, match=r"<ambient_pressure> = 1 refers to load curve 3, but there are 0"):
        replace(model, contacts=(contact,)).text()


def test_a_model_file_is_read_back(tmp_path):
    path = Diffusion(InterfaceType.MIXTURE, elements=1, control=Control(7, 2.5)).model().write(tmp_path)
    file = febfile.inspect(path)
    assert (file.module, file.contacts, file.end) == ("solute", ("sliding-mixture",), 17.5)


XML = '<?xml version="1.0"?>'
MODEL = XML + '<febio_spec version="4.0"><Module type="solute"/>{}</febio_spec>'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is not XML"),
        ("<febio_spec version='4.0'><Module></febio_spec>", "is not XML"),
        (XML + "<model/>", "line 1: <model>: a model begins with <febio_spec>"),
        (XML + "<febio_spec version='2.0'/>", "has version '2.0'; 2.5, 3.0, 4.0 can be read"),
        (XML + "<febio_spec version='4.0'/>", "has no <Module type="),
        (MODEL.format("<Contact><contact surface_pair='a'/></Contact>"), "<contact> has no type"),
        (
            MODEL.format("<Contact><contact type='sliding-mixture' surface_pair='a'/></Contact>"),
            "'a', which does not exist",
        ),
        (MODEL.format("<Control><time_steps>ten</time_steps></Control>"), "<time_steps>: is 'ten'; a number is needed"),
    ],
)
def test_bad_model_files_are_explained(tmp_path, text, message):
    path = tmp_path / "bad.feb"
    path.write_text(text)
    with pytest.raises(ModelError, match=message.replace("(", r"\(")) as raised:
        febfile.inspect(path)
    assert str(path) in str(raised.value)


def test_missing_and_misnamed_model_files_are_explained(tmp_path):
    with pytest.raises(ModelError, match="cannot be read"):
        febfile.inspect(tmp_path / "none.feb")
    with pytest.raises(ModelError, match=r"ends in \.feb"):
        febfile.inspect(tmp_path / "none.xml")


@pytest.mark.parametrize("elements", [2, 4])
def test_tetrahedra_fill_hexahedra_and_their_faces_match(elements):
    shell = spherical_shells.hemisphere(elements, np.linspace(1.0, 2.0, elements))
    cut = tetrahedra(shell)
    corners = cut.nodes[cut.elements]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6.0
    assert np.all(volume > 0.0)
    assert len(cut.elements) == 6 * len(shell.elements)
    # What is on the boundary are triangles of the boundary before: no inner face is left without its neighbour.
    outside = {frozenset(facet) for facet in boundary(shell).tolist()}
    triangles = boundary(cut)
    assert len(triangles) == 2 * len(outside)
    assert all(any(set(triangle) <= quad for quad in outside) for triangle in triangles.tolist())
    x = cut.nodes[triangles]
    outward = np.einsum("ij,ij->i", np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), x[:, 0])
    assert volume.sum() == pytest.approx(outward.sum() / 6.0)
