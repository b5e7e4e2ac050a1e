"""The page that `report` makes of a run."""

from __future__ import annotations

import re
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest

from harness.errors import DataFileError
from harness.models.interface import InterfaceType
from harness.models.parts import Param
from harness.run.runner import Runner, RunResult
from studies.models.pressed_blocks import PressedBlocks

CONTACTS = (InterfaceType.MIXTURE.value, InterfaceType.ELASTIC.value)
AUTOMATIC = (Param("auto_penalty", True), Param("penalty", 10.0))


@pytest.fixture
def report() -> SimpleNamespace:
    """The modules of `report`, whose libraries Python 3.11 or newer has."""
    for name in ("pyfebio", "pyvista"):
        pytest.importorskip(name, reason="`report` needs the libraries of scripts/requirements-report.txt")
    return SimpleNamespace(
        **{
            name: import_module(f"harness.report.{name}")
            for name in ("contents", "history", "page", "plot_file", "vtk_files")
        }
    )


def _run(runner: Runner, contact: str) -> RunResult:
    params = () if contact == InterfaceType.MIXTURE.value else AUTOMATIC
    scene = PressedBlocks(lower=3, upper=2, through=2, contact=contact, params=params, name=f"reported-{contact}")
    return runner(replace(scene.model(), plot=True, further_columns=("Rz",)))


@pytest.mark.parametrize("contact", CONTACTS)
def test_force_and_area_are_those_of_the_run(runner: Runner, contact: str, report: SimpleNamespace) -> None:
    result = _run(runner, contact)
    plot = report.plot_file.read(result.folder / f"{result.model.name}.xplt")
    surfaces = report.history.contacts(plot)
    # What holds the upper block down is what passes the contact; a facet's mean pressure gives it to a few percent.
    top = result.model.mesh.node_sets["upper-top"] - 1
    reaction = abs(result.nodes["Rz"][-1][top].sum())
    assert {each.surface.name for each in surfaces} >= {"lower-top"}
    for each in surfaces:
        assert each.area[-1] == pytest.approx(1.0, rel=0.02)
        assert each.force[-1] == pytest.approx(reaction, rel=0.05)
        assert each.peak[-1] >= each.mean[-1] > 0


@pytest.mark.parametrize("contact", CONTACTS)
def test_page_holds_its_pictures(runner: Runner, contact: str, tmp_path: Path, report: SimpleNamespace) -> None:
    result = _run(runner, contact)
    made = report.contents.make(result.folder / f"{result.model.name}.feb", tmp_path)
    text = report.page.write(made, tmp_path).read_text(encoding="utf-8")
    pictures = sorted(file.stem for file in tmp_path.glob("*.png"))
    assert {"force", "area", "pressure"} <= set(pictures)
    assert text.count("data:image/png;base64,") == len(pictures)
    assert not re.search(r'(src|href)="(?!data:)', text)  # nothing from the network or from another file
    assert contact in text


@pytest.mark.parametrize("contact", CONTACTS)
def test_surfaces_are_written_for_pyvista_and_paraview(
    runner: Runner, contact: str, tmp_path: Path, report: SimpleNamespace
) -> None:
    """The force is the sum of pressure times area over the triangles of a file, where all facets are level."""
    result = _run(runner, contact)
    plot = report.plot_file.read(result.folder / f"{result.model.name}.xplt")
    surfaces = report.history.contacts(plot)
    files = report.vtk_files.write_surfaces(plot, surfaces, len(plot.states) - 1, tmp_path)
    assert [file.name for file in files] == [
        f"surface-{place}-{each.surface.name}.vtp" for place, each in enumerate(surfaces, start=1)
    ]
    for file, each in zip(files, surfaces, strict=True):
        mesh = pytest.importorskip("pyvista").read(file)
        area = mesh.compute_cell_sizes(length=False, volume=False)["Area"]
        assert (mesh["contact pressure"] * area).sum() == pytest.approx(each.mean[-1] * each.area[-1], rel=1e-6)


def test_run_without_contact_pressure_says_what_to_ask_for(
    runner: Runner, tmp_path: Path, report: SimpleNamespace
) -> None:
    result = _run(runner, CONTACTS[0])
    model = tmp_path / "bare.feb"
    text = (result.folder / f"{result.model.name}.feb").read_text(encoding="iso-8859-1")
    model.write_text(text, encoding="iso-8859-1")
    (tmp_path / "bare.log").write_text("", encoding="utf-8")
    with pytest.raises(DataFileError, match=r"bare\.xplt: .*plotfile"):
        report.contents.make(model, tmp_path)
