"""What a model may say wrongly: FEBio stops before the first step, and the message names the culprit."""

from __future__ import annotations

from dataclasses import replace

import febio_runs
import pytest
from scenes.ambient import Apart

from harness.models.diffusion import Diffusion
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.parts import Control, Param
from harness.run import engine

pytestmark = pytest.mark.mixture_only


@pytest.fixture
def complaint(runner, tmp_path):
    """What FEBio says about a model, or about the text of one."""

    def run(model, change=lambda text: text):
        path = model.write(tmp_path)
        path.write_text(change(path.read_text()))
        finished = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
        assert not finished.report.normal
        assert finished.report.steps == 0
        assert "Segmentation" not in finished.output
        assert finished.report.errors
        return " ".join(finished.report.errors)

    return run


def _model(*params):
    settings = ContactSettings(extra=params)
    return Diffusion(InterfaceType.MIXTURE, settings, elements=2, control=Control(2, 200.0), name="bad").model()


@pytest.mark.parametrize("tag", ["penalty", "pressure_penalty", "concentration_penalty"])
@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf")])
def test_meaningless_penalties(complaint, tag, value):
    assert tag in complaint(_model(Param(tag, value)))


@pytest.mark.parametrize("tag", ["tolerance", "gaptol", "ptol", "ctol", "search_tol", "search_radius"])
def test_negative_tolerances(complaint, tag):
    assert tag in complaint(_model(Param(tag, -1.0)))


def test_unknown_parameter(complaint):
    assert "pressure_penlaty" in complaint(_model(Param("pressure_penlaty", 1.0)))


def test_unknown_enforcement(complaint):
    assert "laugon" in complaint(_model(Param("laugon", "MAGIC")))


@pytest.mark.parametrize("tag", ["flip_primary", "flip_secondary"])
def test_a_sound_surface_turned_round(complaint, tag):
    assert tag in complaint(_model(Param(tag, True)))


@pytest.mark.parametrize(
    ("tag", "value"),
    [("fric_coeff", -0.1), ("contact_frac", -0.1), ("contact_frac", 1.1), ("tangential_penalty", 0.0)],
)
def test_friction_that_means_nothing(complaint, tag, value):
    rubbing = () if tag == "fric_coeff" else (Param("fric_coeff", 0.1),)
    assert tag in complaint(_model(*rubbing, Param(tag, value)))


def test_friction_with_multipliers_as_unknowns(complaint):
    said = complaint(_model(Param("fric_coeff", 0.1), Param("laugon", "LAGMULT")))
    assert "fric_coeff" in said
    assert "LAGMULT" in said


def test_multipliers_on_both_surfaces(complaint):
    said = complaint(_model(Param("laugon", "LAGMULT"), Param("two_pass", True)))
    assert "two_pass" in said
    assert "LAGMULT" in said


def test_ambient_concentration_of_an_unknown_solute(complaint):
    said = complaint(_model(Param("ambient_concentration", 1.0, None, {"sol": "3"})))
    assert "ambient_concentration" in said
    assert "3" in said


@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf")])
def test_meaningless_ambient_concentration(complaint, value):
    assert "ambient_concentration" in complaint(_model(Param("ambient_concentration", value)))


def test_ambient_concentration_given_twice(complaint):
    one = Param("ambient_concentration", 1.0, None, {"sol": "1"})
    assert "more than one value" in complaint(_model(one, Param("ambient_concentration", 2.0)))


def test_ambient_concentration_of_a_name_that_no_solute_has(complaint):
    said = complaint(_model(Param("ambient_concentration", 1.0, None, {"sol": "Xy"})))
    assert "ambient_concentration" in said
    assert "sol" in said


def test_missing_surface_pair(complaint):
    said = complaint(_model(), lambda text: text.replace('surface_pair="lower/upper"', 'surface_pair="nothing"'))
    assert "surface_pair" in said


def test_no_surface_pair(complaint):
    assert "surface_pair" in complaint(_model(), lambda text: text.replace(' surface_pair="lower/upper"', ""))


def test_empty_surface(complaint):
    def empty(text):
        start = text.index('<Surface name="lower-top">')
        stop = text.index("</Surface>", start) + len("</Surface>")
        return text[:start] + '<Surface name="lower-top"/>' + text[stop:]

    assert complaint(_model(), empty)


def test_inverted_facets(complaint):
    model = _model()
    mesh = model.mesh
    turned = replace(mesh, surfaces=mesh.surfaces | {"lower-top": mesh.surfaces["lower-top"][:, ::-1]})
    assert "invert" in complaint(replace(model, mesh=turned)).lower()


def test_facets_that_belong_to_no_element(complaint):
    model = Apart(InterfaceType.MIXTURE, control=Control(2, 200.0), name="bad").model()
    mesh = model.mesh
    mixed = mesh.surfaces["lower-top"].copy()
    mixed[0, 0] = mesh.node_sets["upper-bottom"][0]
    assert complaint(replace(model, mesh=replace(mesh, surfaces=mesh.surfaces | {"lower-top": mixed})))
