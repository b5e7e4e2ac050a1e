"""Segments are exact across meshes that do not match: patch tests, and 3.1 and 3.2 against the conforming reference."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scenes import harmonic, ironing
from scenes.harmonic_errors import errors
from scenes.ironing_reaction import ripple
from scenes.nonmatching import PATCHES, QUADRATIC_PATCHES, NonMatching

from harness.models.convection import Convection
from harness.models.diffusion import Diffusion
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.mesh import Box, Mesh, assemble
from harness.models.parts import Control

pytestmark = pytest.mark.mixture_only

SEGMENTS = ContactSettings(integration="segments", laugon="AUGLAG", tolerance=1e-11, maxaug=12)
MULTIPLIERS = ContactSettings(integration="segments", laugon="LAGMULT")
EXACT = {"augmented": SEGMENTS, "multipliers": MULTIPLIERS}
STRICT = Control(
    5,
    400.0,
    displacement_tolerance=1e-9,
    energy_tolerance=1e-16,
    pressure_tolerance=1e-9,
    concentration_tolerance=1e-9,
)


def relative_errors(result, exact):
    """Largest error of each field at the last time over its largest value."""
    nodes = result.nodes
    return {name: np.max(np.abs(nodes[name][-1] - value)) / np.max(np.abs(value)) for name, value in exact.items()}


def patch(name, settings):
    slug = "".join(letter if letter.isalnum() else "-" for letter in name)
    return NonMatching(
        **{
            **vars((PATCHES | QUADRATIC_PATCHES)[name]),
            "settings": settings,
            "name": f"{slug}-{settings.integration}-{settings.laugon}",
        }
    )


@pytest.mark.parametrize("settings", EXACT.values(), ids=EXACT)
@pytest.mark.parametrize("name", [*PATCHES, *QUADRATIC_PATCHES])
def test_uniform_traction_and_linear_fields_are_exact(runner, name, settings):
    chosen = patch(name, settings)
    result = runner(chosen.model())
    errors = relative_errors(result, chosen.exact(result.model.mesh.nodes[:, 2]))
    assert max(errors.values()) <= 1e-10, errors


@pytest.mark.parametrize("name", ["3 to 4", "triangles to quadrilaterals", "turned, partly covered"])
def test_they_are_in_two_passes_by_default(runner, name):
    made = {**vars(SEGMENTS), "integration": None, "two_pass": True}
    chosen = replace(patch(name, ContactSettings(**made)), name=f"two-pass-{len(name)}")
    result = runner(chosen.model())
    errors = relative_errors(result, chosen.exact(result.model.mesh.nodes[:, 2]))
    assert max(errors.values()) <= 1e-10, errors


def test_gauss_points_are_not(runner):
    chosen = patch("3 to 4", ContactSettings(**{**vars(SEGMENTS), "integration": "gauss"}))
    result = runner(chosen.model())
    errors = relative_errors(result, chosen.exact(result.model.mesh.nodes[:, 2]))
    assert min(errors.values()) >= 1e-3, errors


def cubes(divisions: tuple[int, int]) -> Mesh:
    """Those of the article's problems, of four elements along z and their own numbers across."""
    bodies = zip(("lower", "upper"), (-1.0, 0.0), divisions, strict=True)
    mesh = assemble([Box(name, "gel", (0.0, 0.0, z), (1.0, 1.0, 1.0), (n, n, 4)) for name, z, n in bodies])
    ends = {"bottom": mesh.node_sets["lower-bottom"], "top": mesh.node_sets["upper-top"]}
    return replace(mesh, node_sets=mesh.node_sets | ends, pairs={"lower/upper": ("lower-top", "upper-bottom")})


@pytest.mark.parametrize("settings", EXACT.values(), ids=EXACT)
@pytest.mark.parametrize("divisions", [(2, 3), (3, 2)])
@pytest.mark.parametrize("problem", [Diffusion, Convection])
def test_problems_of_the_article_are_those_of_the_conforming_reference(runner, problem, divisions, settings):
    common = {"elements": 4, "control": STRICT, "module": "multiphasic"}
    reference = runner(
        problem(interface=InterfaceType.CONFORMING, name=f"conforming-{problem.__name__}", **common).model()
    )
    name = f"split-{problem.__name__}-{divisions[0]}-{divisions[1]}-{settings.laugon}"
    split = runner(replace(problem(settings=settings, name=name, **common).model(), mesh=cubes(divisions)))
    heights = np.round(reference.model.mesh.nodes[:, 2], 9)
    place = [int(np.flatnonzero(heights == z)[0]) for z in np.round(split.model.mesh.nodes[:, 2], 9)]
    for name in ("uz", "p", "c1"):
        expected = reference.nodes[name][:, place]
        difference = np.max(np.abs(split.nodes[name] - expected)) / np.max(np.abs(expected))
        assert difference <= 1e-8, name
    if settings is MULTIPLIERS:
        assert split.report.iterations <= 1.05 * reference.report.iterations


@pytest.mark.parametrize(
    ("nodes", "levels", "order"), [(8, (2, 4), 1.95), pytest.param(20, (2, 3), 2.85, marks=pytest.mark.slow)]
)
def test_displacement_and_concentration_converge_with_the_order_of_the_elements(runner, nodes, levels, order):
    settings = ContactSettings(integration="segments", laugon="AUGLAG", tolerance=1e-6)
    coarse, fine = (
        errors(runner(harmonic.Harmonic(level, nodes, settings, name=f"harmonic-{nodes}-{level}").model()))
        for level in levels
    )
    for name, error in coarse.items():
        assert np.log(error / fine[name]) / np.log(levels[1] / levels[0]) >= order, name


@pytest.mark.slow
def test_the_reaction_hardly_ripples_as_an_indenter_slides_over_ten_facets(runner):
    result = runner(ironing.Ironing(ContactSettings(integration="segments")).model())
    assert result.report.retries == 0
    assert ripple(result) <= 1e-3  # measured 4.8e-4
