"""The knee: its mesh, its model file, and that it bears its load."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import jacobians
import numpy as np
import pytest
from lxml import etree
from scipy.spatial import cKDTree
from typer.testing import CliRunner

from harness.models.interface import InterfaceType
from harness.models.knee import bearing, structured_blocks, whole_mesh
from harness.models.knee.bearing import Load
from harness.models.knee.structured_blocks import Block
from harness.models.knee.tissues import TISSUES, Bodies
from harness.models.knee.whole_knee import Knee
from harness.models.knee.whole_mesh import Size
from harness.models.mesh import Mesh
from harness.preflight import check
from studies import cli

EQUATIONS = {Size.SMALL: 25e3, Size.MEDIUM: 100e3, Size.LARGE: 300e3}


def _normals(knee: Mesh, surface: str) -> np.ndarray:
    return _normals_of(knee.nodes[knee.surfaces[surface] - 1])


def _normals_of(corner: np.ndarray) -> np.ndarray:
    return np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])


@pytest.mark.parametrize("porous", [False, True])
@pytest.mark.parametrize("size", Size)
def test_no_element_is_inverted(size: Size, porous: bool) -> None:
    knee = whole_mesh.meshed(size, porous=porous).mesh
    elements = np.concatenate([part.elements for part in knee.parts])
    assert jacobians.at_corners(knee.nodes, elements - 1).min() > 0.0


@pytest.mark.parametrize(("size", "expected"), EQUATIONS.items())
def test_sizes_have_the_equations_that_they_promise(size: Size, expected: float) -> None:
    knee = whole_mesh.meshed(size).mesh
    bone = [part.elements.ravel() for part in knee.parts if part.material in (whole_mesh.FEMUR, whole_mesh.TIBIA)]
    free_nodes = len(knee.nodes) - len(np.unique(np.concatenate(bone)))
    assert 3 * free_nodes == pytest.approx(expected, rel=0.1)


@pytest.mark.parametrize("size", [Size.COARSE, Size.SMALL])
def test_surfaces_of_each_contact_face_each_other(size: Size) -> None:
    knee = whole_mesh.meshed(size).mesh
    assert len(knee.pairs) == 6
    for primary, secondary in knee.pairs.values():
        centres = [knee.nodes[knee.surfaces[name] - 1].mean(axis=1) for name in (primary, secondary)]
        distance, nearest = cKDTree(centres[1]).query(centres[0])
        close = distance < 3.0
        assert close.any()
        facing = np.einsum("ij,ij->i", _normals(knee, primary)[close], _normals(knee, secondary)[nearest[close]])
        assert np.all(facing < 0.0)


@pytest.mark.parametrize("size", [Size.COARSE, Size.SMALL])
def test_porous_bodies_touch_and_do_not_overlap(size: Size) -> None:
    knee = whole_mesh.meshed(size, porous=True).mesh
    for name, pair in knee.pairs.items():
        facets = [knee.nodes[knee.surfaces[surface] - 1] for surface in pair]
        upper, lower = sorted(facets, key=lambda corners: _normals_of(corners)[:, 2].mean())
        expected = -structured_blocks.TOUCH if name.startswith("femur-tibia") else 0.0
        assert structured_blocks.smallest_gap(lower, upper) == pytest.approx(expected, abs=1e-9)


def test_the_smallest_gap_may_be_anywhere_on_facets() -> None:
    flat = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]]])
    above = flat + np.array([0.0, 0.0, 0.5])
    assert structured_blocks.smallest_gap(flat, above) == pytest.approx(0.5)
    dips = above.copy()
    dips[0, 2, 2] = -0.25
    assert structured_blocks.smallest_gap(flat, dips) == pytest.approx(-0.25)
    assert structured_blocks.smallest_gap(flat, above + np.array([1.5, 1.5, 0.0])) == pytest.approx(0.5)


@pytest.mark.parametrize("size", Size)
def test_porous_bodies_have_three_layers(size: Size) -> None:
    divisions = whole_mesh.POROUS_DIVISIONS[size]
    assert min(layers[2] for layers in (divisions.condyle, divisions.plateau, divisions.meniscus)) >= 3
    thickness = -np.diff(divisions.depths(divisions.condyle[2]))
    assert thickness[0] == pytest.approx(thickness[-1])
    assert thickness[0] < 0.51 * thickness.max()


def test_synovial_fluid_wets_no_bone_and_no_facet_of_a_contact_as_a_whole() -> None:
    knee = whole_mesh.meshed(Size.COARSE, porous=True).mesh
    bath = knee.node_sets[whole_mesh.BATH]
    bone = _nodes_of(knee, whole_mesh.FEMUR) | _nodes_of(knee, whole_mesh.TIBIA)
    assert set(bath.tolist()) <= set(knee.node_sets[whole_mesh.POROUS].tolist()) - bone
    assert len(np.unique(bath)) == len(bath)
    for facets in knee.surfaces.values():
        assert np.isin(facets, bath).all(axis=1).sum() == 0


def test_cartilage_is_as_thick_as_published() -> None:
    knee = whole_mesh.meshed(Size.COARSE).mesh
    for part in knee.parts:
        if part.material in (whole_mesh.FEMORAL, whole_mesh.TIBIAL):
            corner = knee.nodes[part.elements - 1]
            thickness = np.linalg.norm(corner[:, 4:] - corner[:, :4], axis=-1)
            assert thickness.min() > 2.0
            assert thickness.max() < 3.0


def test_cartilage_is_joined_to_bone_by_nodes() -> None:
    knee = whole_mesh.meshed(Size.COARSE).mesh
    parts = {part.name: set(part.elements.ravel().tolist()) for part in knee.parts}
    for cartilage, bone in ((whole_mesh.FEMORAL, whole_mesh.FEMUR), (whole_mesh.TIBIAL, whole_mesh.TIBIA)):
        for side in ("medial", "lateral"):
            assert parts[f"{cartilage}-{side}"] & parts[f"{bone}-{side}"]


def test_fibres_go_around_the_menisci() -> None:
    knee = whole_mesh.meshed(Size.SMALL).mesh
    for part in knee.parts:
        if part.material == whole_mesh.MENISCAL:
            corner = knee.nodes[part.elements - 1]
            along = corner[:, 1] - corner[:, 0]
            outwards = corner.mean(axis=1) - corner.mean(axis=(0, 1))
            turn = np.cross(outwards, along)[:, 2]
            assert np.all(turn > 0.0)


def _nodes_of(knee: Mesh, material: str) -> set[int]:
    return {node for part in knee.parts if part.material == material for node in part.elements.ravel().tolist()}


def test_horns_hang_on_bone() -> None:
    made = whole_mesh.meshed(Size.COARSE)
    knee, horns = made.mesh, made.horns
    assert len(horns) == 4
    for horn in horns:
        assert set(horn.ends[:, 0].tolist()) <= _nodes_of(knee, whole_mesh.MENISCAL)
        assert set(horn.ends[:, 1].tolist()) <= _nodes_of(knee, whole_mesh.TIBIA)
        assert horn.stiffness * len(horn.ends) == pytest.approx(whole_mesh.HORN_STIFFNESS)


def test_a_block_has_the_facets_of_its_ends() -> None:
    points = np.stack(np.meshgrid([0.0, 1.0, 2.0], [0.0, 1.0], [0.0, 1.0, 3.0], indexing="ij"), axis=-1)
    block = Block(points)
    assert block.elements(slice(1, None)).shape == (2, 8)
    heights = [points.reshape(-1, 3)[facets - 1][..., 2] for facets in (block.top, block.bottom)]
    assert np.all(heights[0] == 3.0)
    assert np.all(heights[1] == 0.0)


@pytest.mark.parametrize("interface", [InterfaceType.MIXTURE, InterfaceType.ELASTIC])
def test_all_contacts_are_of_one_kind(interface: InterfaceType) -> None:
    root = etree.fromstring(Knee(interface, Size.COARSE, friction=0.02).model().text().encode())
    assert {contact.get("type") for contact in root.iter("contact")} == {interface.value}
    assert {contact.findtext("fric_coeff") for contact in root.iter("contact")} == {"0.02"}


@pytest.mark.parametrize("bodies", [Bodies.BIPHASIC, Bodies.SOLUTE])
@pytest.mark.parametrize("load", Load)
def test_porous_knees_have_contacts_of_one_kind_and_all_surroundings(bodies: Bodies, load: Load) -> None:
    theirs = TISSUES[bodies].theirs
    for interface in (InterfaceType.MIXTURE, theirs):
        root = etree.fromstring(Knee(interface, Size.COARSE, load, bodies=bodies).model().text().encode())
        contacts = list(root.iter("contact"))
        assert {contact.get("type") for contact in contacts} == {interface.value}
        ambient = {contact.findtext("ambient_concentration") for contact in contacts}
        assert ambient == ({"7"} if bodies is Bodies.SOLUTE else {None})
        assert {bc.get("type") for bc in root.iter("bc") if bc.get("node_set") == whole_mesh.BATH} == (
            {"prescribed fluid pressure"} | ({"prescribed concentration"} if bodies is Bodies.SOLUTE else set())
        )


@pytest.mark.parametrize("bodies", [Bodies.BIPHASIC, Bodies.SOLUTE])
def test_check_finds_no_trouble_with_porous_knees(tmp_path: Path, bodies: Bodies) -> None:
    assert not check.matter(check.check(Knee(size=Size.COARSE, bodies=bodies).model().write(tmp_path)))


def _invoke(*arguments: str):
    return CliRunner().invoke(cli.commands(cli.COMMANDS, ["models"]), ["models", *arguments])


def test_command_writes_the_model_that_its_options_name(tmp_path: Path) -> None:
    file = tmp_path / "gait.feb"
    done = _invoke("knee", "--size", "coarse", "--load", "gait", "--output", str(file))
    assert done.exit_code == 0, done.output
    expected = Knee(size=Size.COARSE, load=Load.GAIT, name="gait").model().text()
    assert file.read_text(encoding="iso-8859-1") == expected
    done = _invoke("knee", "--size", "coarse", "--bodies", "solute", "--output", str(file))
    assert done.exit_code == 0, done.output
    expected = Knee(size=Size.COARSE, bodies=Bodies.SOLUTE, name="gait").model().text()
    assert file.read_text(encoding="iso-8859-1") == expected


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("knee",), "needs a file that ends in .feb"),
        (("knee", "--output", "knee.txt"), "needs a file that ends in .feb"),
        (("knee", "--check", "--output", "knee.feb"), "it belongs to `models` alone"),
        (("--size", "small"), "it belongs to `models knee`"),
        (("knee", "--size", "huge", "--output", "knee.feb"), "'huge' is not one of 'coarse', 'small'"),
        (("hip", "--output", "hip.feb"), "'hip' is not one of 'knee'"),
        (
            ("knee", "--bodies", "solute", "--contact", "febio", "--friction", "0.1", "--output", "knee.feb"),
            "sliding-biphasic-solute has no friction",
        ),
        (("knee", "--friction", "-1", "--output", "knee.feb"), "greater than or equal to 0"),
    ],
)
def test_command_names_the_option_that_it_cannot_use(arguments: tuple[str, ...], complaint: str) -> None:
    done = _invoke(*arguments)
    assert done.exit_code == 2
    assert complaint in " ".join(done.output.replace("│", " ").split())


def _bears_its_load(runner, report: SimpleNamespace, size: Size) -> None:
    """The stance of the elastic knee ends without a retry, and tibia and menisci hold the femur."""
    result = runner(Knee(InterfaceType.MIXTURE, size, name=f"knee-{size.value}").model())
    assert result.report.retries == 0
    plot = report.plot_file.read(result.folder / f"{result.model.name}.xplt")
    forces = plot.states[-1].on_surfaces[report.history.FORCE]
    places = [place for place, surface in enumerate(plot.surfaces) if "-to-femur-" in surface.name]
    upwards = [abs(float(forces[place][0, 2])) for place in places]
    assert min(upwards) > 0.05 * bearing.STANCE
    assert sum(upwards) == pytest.approx(bearing.STANCE, rel=1e-3)  # of the residual that FEBio leaves


@pytest.fixture
def report() -> SimpleNamespace:
    """The modules that read plot files, whose library Python 3.11 or newer has."""
    pytest.importorskip("pyfebio", reason="plot files need the libraries of scripts/requirements-report.txt")
    return SimpleNamespace(**{name: import_module(f"harness.report.{name}") for name in ("history", "plot_file")})


def test_the_coarse_knee_bears_its_load(runner, report: SimpleNamespace) -> None:
    _bears_its_load(runner, report, Size.COARSE)


@pytest.mark.parametrize("bodies", [Bodies.BIPHASIC, pytest.param(Bodies.SOLUTE, marks=pytest.mark.slow)])
def test_the_coarse_porous_knee_begins_without_a_retry(runner, report: SimpleNamespace, bodies: Bodies) -> None:
    """Steps of the stance until femur and tibia are in contact, while stands bear a part of the load."""
    model = Knee(InterfaceType.MIXTURE, Size.COARSE, bodies=bodies, name=f"knee-{bodies.value}").model()
    steps = 4
    short = replace(model.control, end=steps * model.control.step)
    result = runner(replace(model, control=short))
    assert result.report.steps == steps
    assert result.report.retries == 0
    contacts = report.history.contacts(report.plot_file.read(result.folder / f"{result.model.name}.xplt"))
    under = [contact for contact in contacts if "-to-femur-" in contact.surface.name]
    assert {contact.surface.name.rsplit("-", 1)[1] for contact in under} == {"medial", "lateral"}
    assert 0.0 < sum(contact.force[-1] for contact in under) < bearing.STANCE * short.end / bearing.RISE
    assert max(contact.fluid_share[-1] for contact in under) > 0.0


@pytest.mark.slow
def test_the_small_knee_bears_its_load(runner, report: SimpleNamespace) -> None:
    _bears_its_load(runner, report, Size.SMALL)


def test_springs_have_a_name_in_the_plot_file(runner, report: SimpleNamespace) -> None:
    result = runner(Knee(InterfaceType.MIXTURE, Size.COARSE, name="knee-coarse").model())
    plot = report.plot_file.read(result.folder / f"{result.model.name}.xplt")
    assert len(plot.domains) == len(result.model.mesh.parts) + len(result.model.springs)
