"""The embedded engine against febio4 with the plugin: the same models, node by node."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scenes.tied_columns import column

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.models.composite import Composite
from harness.models.confined import Confined
from harness.models.convection import Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Control, Param
from harness.run import engine
from harness.run.hosts import FEBIO4, STANDALONE
from harness.run.runner import Runner, RunResult
from studies.engines import command
from studies.engines.command import differences, strict
from studies.models import small

BAR = command.SMOOTH
"""Largest difference of a nodal variable, relative to its largest value."""
FLOORS = {1.0: 1e-24, 10.0: 1e-22, 100.0: 1e-18}
"""Squared residual at which rounding is all that is left, for each Young's modulus (MPa)."""


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory):
    """Runs a model with both engines."""
    try:
        for host in (FEBIO4, STANDALONE):
            host.binaries(plugin=True)
    except (EngineNotFoundError, PluginNotFoundError) as error:
        pytest.skip(str(error))
    root = tmp_path_factory.mktemp("runs")

    def both(model: Model) -> tuple[RunResult, RunResult]:
        return tuple(Runner(root / host.name, host=host)(model) for host in (FEBIO4, STANDALONE))

    return both


@pytest.mark.slow
def test_diffusion_agrees_at_every_node_and_time(runs):
    found = differences(*runs(strict(Diffusion(control=Control(100, 80.0)).model(), FLOORS[10.0])))
    assert max(found.values()) <= BAR, found


@pytest.mark.parametrize("peclet", [*(pytest.param(k, marks=pytest.mark.slow) for k in (0, 1)), 10])
def test_convection_agrees_at_every_node_and_time(runs, peclet):
    found = differences(*runs(strict(Convection(peclet=peclet, control=Control(100, 200.0)).model(), FLOORS[100.0])))
    assert max(found.values()) <= BAR, found


@pytest.mark.parametrize("laugon", ["PENALTY", "AUGLAG"])
def test_unlike_materials_agree(runs, laugon):
    # Tighter than what the default penalties leave: at 1e-3 rounding would decide whether there is an augmentation.
    model = Composite(settings=ContactSettings(laugon=laugon, tolerance=1e-4), control=Control(10, 50.0)).model()
    found = differences(*runs(strict(model, FLOORS[100.0])))
    assert max(found.values()) <= BAR, found


def test_a_loaded_biphasic_layer_agrees(runs):
    found = differences(*runs(strict(Confined(control=Control(20, 20.0)).model(), FLOORS[1.0])))
    assert max(found.values()) <= BAR, found


@pytest.mark.parametrize("effects", ["traction, solvent", "traction, s1"])
def test_an_effect_left_out_agrees(runs, effects):
    settings = ContactSettings(extra=(Param("effects", effects),))
    one, two = runs(strict(Diffusion(settings=settings, control=Control(20, 50.0)).model(), FLOORS[10.0]))
    found = differences(one, two)
    assert max(found.values()) <= BAR, found
    assert "<effects> omits it" in one.log
    assert "<effects> omits it" in two.log


def test_a_body_without_contact_agrees(runs):
    found = differences(
        *runs(strict(Diffusion(InterfaceType.CONFORMING, control=Control(20, 50.0)).model(), FLOORS[10.0]))
    )
    assert max(found.values()) <= BAR, found


def test_element_data_agree(runs):
    one, two = runs(strict(Composite(control=Control(10, 50.0)).model(), FLOORS[100.0]))
    for name in one.elements.columns:
        size = np.abs(one.elements[name]).max()
        assert np.abs(one.elements[name] - two.elements[name]).max() <= 1e-6 * size, name


def test_the_log_is_read_like_febios(runs):
    one, two = runs(Diffusion(control=Control(20, 50.0)).model())
    assert (one.report.normal, one.report.steps) == (two.report.normal, two.report.steps)
    assert abs(one.report.iterations - two.report.iterations) <= 2


@pytest.mark.parametrize("laugon", ["PENALTY", "AUGLAG"])
@pytest.mark.parametrize("module", ["biphasic", "solute", "multiphasic"])
def test_ties_agree(tmp_path, module, laugon):
    """Columns with a kept gap, drawn, sheared and twisted, with flow and diffusion along them."""
    document, _ = column(module, f"<laugon>{laugon}</laugon>", cells=(2, 3), gap=0.02)
    tables, iterations = [], []
    for host in (FEBIO4, STANDALONE):
        folder = tmp_path / host.name
        folder.mkdir()
        (folder / "tie.feb").write_text(document.text())
        try:
            finished = engine.execute(host.command(folder / "tie.feb", True), folder)
        except (EngineNotFoundError, PluginNotFoundError) as error:
            pytest.skip(str(error))
        tables.append(small.table(folder / "nodes.txt")[-1])
        iterations.append(finished.report.iterations)
    assert iterations[0] == iterations[1]
    size = np.maximum(np.abs(tables[0]).max(axis=0), np.finfo(float).tiny)
    assert (np.abs(tables[0] - tables[1]).max(axis=0) / size).max() <= BAR


@pytest.fixture
def complaints(tmp_path: Path):
    """What the embedded engine says of a model's text that it refuses."""

    def run(text: str) -> list[str]:
        try:
            command = STANDALONE.command(tmp_path / "bad.feb", False)
        except EngineNotFoundError as error:
            pytest.skip(str(error))
        (tmp_path / "bad.feb").write_text(text)
        finished = engine.execute(command, tmp_path, check=False)
        assert not finished.report.normal
        return finished.report.errors

    return run


def test_a_model_that_cannot_be_read_says_why_and_ends_with_1(complaints):
    text = Diffusion(control=Control(2, 50.0)).model().text()
    assert any("line" in said and "<E>" in said for said in complaints(text.replace("<E>10</E>", "<E>ten</E>")))


@pytest.mark.parametrize(
    ("tag", "said"),
    [
        ("<laugon>LAGMULT</laugon>", "allowed"),
        ("<search_radius>1e-3</search_radius>", "nothing is tied"),
        ("<fric_coeff>0.1</fric_coeff>", "<fric_coeff>"),
        ("<effects>traction,salt</effects>", "<effects>"),
    ],
)
def test_a_tie_that_cannot_be_says_why(complaints, tag, said):
    document, _ = column("biphasic", tag, gap=0.02)
    assert any(said in sentence for sentence in complaints(document.text()))


@pytest.mark.parametrize(("tag", "value"), [("laugon", "LAGMULT"), ("node_reloc", True), ("predictor", True)])
def test_what_only_febio4_can_do_is_refused(complaints, tag, value):
    settings = ContactSettings(extra=(Param(tag, value),))
    said = complaints(Diffusion(settings=settings, control=Control(2, 50.0)).model().text())
    assert any("line" in sentence and f"<{tag}>" in sentence and "allowed" in sentence for sentence in said)


def test_negative_concentrations_that_febio_would_clamp_are_reported(tmp_path):
    try:
        STANDALONE.binaries(plugin=True)
    except EngineNotFoundError as error:
        pytest.skip(str(error))
    run = Runner(tmp_path, host=STANDALONE)(Diffusion(control=Control(1, 0.01)).model())
    assert run.nodes["c1"].min() < 0.0
    assert any("negative" in said for said in run.report.warnings)


def test_an_effect_that_cannot_be_is_refused(complaints):
    settings = ContactSettings(extra=(Param("effects", "salt"),))
    said = complaints(Diffusion(settings=settings, control=Control(2, 50.0)).model().text())
    assert any('<effects> names "salt"; allowed' in sentence for sentence in said)
