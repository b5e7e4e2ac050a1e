"""The knee: its mesh, its model file, and that it bears its load."""

from __future__ import annotations

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
from harness.models.knee import bearing, whole_mesh
from harness.models.knee.bearing import Load
from harness.models.knee.structured_blocks import Block
from harness.models.knee.whole_knee import Knee
from harness.models.knee.whole_mesh import Size
from harness.models.mesh import Mesh
from studies import cli

EQUATIONS = {Size.SMALL: 25e3, Size.MEDIUM: 100e3, Size.LARGE: 300e3}


def _normals(knee: Mesh, surface: str) -> np.ndarray:
    corner = knee.nodes[knee.surfaces[surface] - 1]
    return np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])


@pytest.mark.parametrize("size", Size)
def test_no_element_is_inverted(size: Size) -> None:
    knee, _ = whole_mesh.meshed(size)
    elements = np.concatenate([part.elements for part in knee.parts])
    assert jacobians.at_corners(knee.nodes, elements - 1).min() > 0.0


@pytest.mark.parametrize(("size", "expected"), EQUATIONS.items())
def test_sizes_have_the_equations_that_they_promise(size: Size, expected: float) -> None:
    knee, _ = whole_mesh.meshed(size)
    bone = [part.elements.ravel() for part in knee.parts if part.material in (whole_mesh.FEMUR, whole_mesh.TIBIA)]
    free_nodes = len(knee.nodes) - len(np.unique(np.concatenate(bone)))
    assert 3 * free_nodes == pytest.approx(expected, rel=0.1)


@pytest.mark.parametrize("size", [Size.COARSE, Size.SMALL])
def test_surfaces_of_each_contact_face_each_other(size: Size) -> None:
    knee, _ = whole_mesh.meshed(size)
    assert len(knee.pairs) == 6
    for primary, secondary in knee.pairs.values():
        centres = [knee.nodes[knee.surfaces[name] - 1].mean(axis=1) for name in (primary, secondary)]
        distance, nearest = cKDTree(centres[1]).query(centres[0])
        close = distance < 3.0
        assert close.any()
        facing = np.einsum("ij,ij->i", _normals(knee, primary)[close], _normals(knee, secondary)[nearest[close]])
        assert np.all(facing < 0.0)


def test_cartilage_is_as_thick_as_published() -> None:
    knee, _ = whole_mesh.meshed(Size.COARSE)
    for part in knee.parts:
        if part.material in (whole_mesh.FEMORAL, whole_mesh.TIBIAL):
            corner = knee.nodes[part.elements - 1]
            thickness = np.linalg.norm(corner[:, 4:] - corner[:, :4], axis=-1)
            assert thickness.min() > 2.0
            assert thickness.max() < 3.0


def test_cartilage_is_joined_to_bone_by_nodes() -> None:
    knee, _ = whole_mesh.meshed(Size.COARSE)
    parts = {part.name: set(part.elements.ravel().tolist()) for part in knee.parts}
    for cartilage, bone in ((whole_mesh.FEMORAL, whole_mesh.FEMUR), (whole_mesh.TIBIAL, whole_mesh.TIBIA)):
        for side in ("medial", "lateral"):
            assert parts[f"{cartilage}-{side}"] & parts[f"{bone}-{side}"]


def test_fibres_go_around_the_menisci() -> None:
    knee, _ = whole_mesh.meshed(Size.SMALL)
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
    knee, horns = whole_mesh.meshed(Size.COARSE)
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


def _invoke(*arguments: str):
    return CliRunner().invoke(cli.commands(cli.COMMANDS, ["models"]), ["models", *arguments])


def test_command_writes_the_model_that_its_options_name(tmp_path: Path) -> None:
    file = tmp_path / "gait.feb"
    done = _invoke("knee", "--size", "coarse", "--load", "gait", "--output", str(file))
    assert done.exit_code == 0, done.output
    expected = Knee(size=Size.COARSE, load=Load.GAIT, name="gait").model().text()
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


@pytest.mark.slow
def test_the_small_knee_bears_its_load(runner, report: SimpleNamespace) -> None:
    _bears_its_load(runner, report, Size.SMALL)


def test_springs_have_a_name_in_the_plot_file(runner, report: SimpleNamespace) -> None:
    result = runner(Knee(InterfaceType.MIXTURE, Size.COARSE, name="knee-coarse").model())
    plot = report.plot_file.read(result.folder / f"{result.model.name}.xplt")
    assert len(plot.domains) == len(result.model.mesh.parts) + len(result.model.springs)
