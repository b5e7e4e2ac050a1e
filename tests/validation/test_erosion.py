"""Elements that erode at a contact: it goes on with the facets that are left, or that lie bare.

Erosion happens where a step has been solved, which is then solved again. Bodies here are elastic and without friction,
so that the answer is that of a model which has never had the elements.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace

import febio_runs
import numpy as np
import pytest

from harness.models.blocks import FACES
from harness.run import engine
from studies.models import small
from studies.models.small import (
    Document,
    Parts,
    biphasic,
    contact,
    control,
    curve,
    elastic,
    fixed,
    moved,
)

pytestmark = pytest.mark.mixture_only

RAMP = curve(1, (0, 0), (1, 1))
CELLS = 3
"""Of the upper body, along x and y; it has two layers."""


TIGHT = "<dtol>1e-8</dtol><etol>1e-14</etol>"
"""Of the solver, so that runs of the same problem can be compared."""


def erosion(criterion: str, surfaces: str = "yes", params: str = "") -> str:
    """A mesh adaptor that erodes elements by a criterion; surfaces: no, yes (facets go with them) or grow."""
    inner = f"<max_iters>1</max_iters><erode_surfaces>{surfaces}</erode_surfaces>{params}{criterion}"
    return f'<mesh_adaptor type="erosion">{inner}</mesh_adaptor>'


def these_elements(numbers: Iterable[int]) -> str:
    """A criterion of a mesh adaptor: elements by their numbers."""
    listed = ",".join(map(str, numbers))
    return f'<criterion type="element_selection"><value>1</value><element_list>{listed}</element_list></criterion>'


def pressed(
    params: str = "", *, steps: int = 2, fluid: bool = False, retries: int = 0, turned: bool = False
) -> Document:
    """A block on a wider one, pressed down: the upper one, whose elements erode, comes first."""
    parts = Parts()
    parts.box("up", (0, 0, 1), (1, 1, 2), (CELLS, CELLS, 2), "up")
    parts.box("low", (-0.3, -0.3, 0), (1.3, 1.3, 1), (4, 4, 2), "low")
    pair = ("low-top", "up-bottom") if turned else ("up-bottom", "low-top")
    material = biphasic if fluid else elastic
    module, analysis = ("biphasic", "TRANSIENT") if fluid else ("solid", "STATIC")
    return Document(
        parts.mesh({"pair": pair}),
        (material("up", 1, 1), material("low", 2, 2)),
        module=module,
        control=control(module, steps, 1 / steps, retries=retries, analysis=analysis).replace(
            "<max_refs>", f"{TIGHT}<max_refs>"
        ),
        boundary=(fixed("low-bottom", "x", "y", "z"), fixed("up-top", "x", "y"), moved("up-top", "z", -0.1)),
        contacts=(contact("c", "pair", params=params),),
        curves=(RAMP,),
        surface_data={"up-bottom": "contact_force.z;contact area"},
    )


def without_elements(document: Document, numbers, bare=()) -> Document:
    """The model that has never had these elements of the upper block, nor their facets; others of it lie bare."""
    mesh = document.mesh
    for number in numbers:
        mesh = re.sub(rf'<elem id="{number}">.*\n', "", mesh)
    facets = [
        face
        for face in re.findall(r'<quad4 id="\d+">([\d,]+)</quad4>', _surface(mesh, "up-bottom"))
        if not any(set(face.split(",")) <= set(_element(document.mesh, n)) for n in numbers)
    ]
    inner = "".join(f'<quad4 id="{n}">{face}</quad4>' for n, face in enumerate([*facets, *bare], 1))
    new = f'<Surface name="up-bottom">{inner}</Surface>'
    return replace(document, mesh=mesh.replace(_surface(mesh, "up-bottom"), new))


def _surface(mesh: str, name: str) -> str:
    return re.search(rf'<Surface name="{name}">.*?</Surface>', mesh)[0]


def _element(mesh: str, number: int) -> list[str]:
    return re.search(rf'<elem id="{number}">([\d,]+)</elem>', mesh)[1].split(",")


def bare_facets(document: Document, numbers) -> list[str]:
    """What lies bare of the neighbours of elements of the upper block, as FEBio's growing surfaces have it."""
    ids = {n: _element(document.mesh, n) for n in range(1, 2 * CELLS**2 + 1)}
    faces = {n: [[each[a] for a in face] for face in FACES] for n, each in ids.items()}
    eroded = {frozenset(face) for n in numbers for face in faces[n]}
    return [",".join(face) for n in ids if n not in numbers for face in faces[n] if frozenset(face) in eroded]


def at_the_end(folder, mesh):
    """Displacements of the nodes that the elements of a mesh have."""
    used = {int(n) for ids in re.findall(r'<elem id="\d+">([\d,]+)</elem>', mesh) for n in ids.split(",")}
    return small.table(folder / "nodes.txt")[-1][[n - 1 for n in sorted(used)]]


CORNER, EDGE, MIDDLE = (1,), (3, 5), (9,)
"""Elements of the lower layer, which have the odd numbers."""
SETTINGS = {
    "penalty": "",
    "gauss": "<integration>gauss</integration>",
    "augmented": "<laugon>AUGLAG</laugon><penalty>5</penalty><auto_penalty>1</auto_penalty><maxaug>30</maxaug>"
    "<tolerance>1e-6</tolerance>",
    "two passes": "<two_pass>1</two_pass><auto_penalty>1</auto_penalty><penalty>10</penalty>",
}


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("numbers", [CORNER, EDGE])
@pytest.mark.parametrize("setting", SETTINGS)
def test_facets_of_eroded_elements_bear_nothing(solve, setting, numbers, turned):
    document = pressed(SETTINGS[setting], turned=turned)
    eroded = replace(document, adaptors=(erosion(these_elements(numbers)),))
    folder, found = solve("eroded", eroded)
    assert f"Deactivated elements: {len(numbers)}" in found.output
    expected, _ = solve("without", without_elements(document, numbers))
    cut = without_elements(document, numbers).mesh
    one, two = at_the_end(folder, cut), at_the_end(expected, cut)
    np.testing.assert_allclose(one, two, atol=1e-6 if setting == "augmented" else 1e-8)
    forces = [small.table(each / "surface-up-bottom.txt")[-1] for each in (folder, expected)]
    np.testing.assert_allclose(*forces, rtol=1e-5 if setting == "augmented" else 1e-7)


@pytest.mark.parametrize("numbers", [CORNER, EDGE, MIDDLE])
def test_surfaces_grow_over_what_lies_bare(solve, numbers):
    """By Gauss points: with segments the sides of a hole come and go, which face the other body at right angles."""
    document = pressed(SETTINGS["gauss"])
    eroded = replace(document, adaptors=(erosion(these_elements(numbers), "grow"),))
    folder, _ = solve("eroded", eroded)
    cut = without_elements(document, numbers, bare_facets(document, numbers))
    expected, _ = solve("without", cut)
    np.testing.assert_allclose(at_the_end(folder, cut.mesh), at_the_end(expected, cut.mesh), atol=1e-8)


def test_facets_stay_where_they_are_not_to_erode(solve):
    """As in FEBio's interfaces: facets of elements that are gone hold the other body, and the log says so."""
    document = replace(pressed(), adaptors=(erosion(these_elements(CORNER), "no"),))
    _, found = solve("eroded", document)
    assert "facets of eroded elements remain in contact" in found.output


def test_a_contact_ends_with_its_last_facet(solve):
    bottom = range(1, 2 * CELLS**2, 2)
    document = replace(pressed(), adaptors=(erosion(these_elements(bottom)),))
    folder, found = solve("eroded", document)
    assert 'surface "up-bottom" has no facets left, and the contact is switched off' in found.output
    low = small.table(folder / "nodes.txt")[-1][3 * (CELLS + 1) ** 2 :]
    assert np.abs(low).max() < 1e-12


def test_fluid_passes_where_facets_are_left(solve):
    document = pressed(fluid=True)
    folder, _ = solve("eroded", replace(document, adaptors=(erosion(these_elements(CORNER), "grow"),)))
    assert np.isfinite(small.table(folder / "nodes.txt")).all()


def test_friction_goes_on_with_the_nodes_that_are_left(solve):
    """Sticking nodes keep their tractions: dragging goes on from where it was."""
    params = "<fric_coeff>0.5</fric_coeff><auto_penalty>1</auto_penalty><penalty>50</penalty>"
    document = pressed(params, steps=4)
    drag = moved("up-top", "x", 0.02, 2)
    boundary = (*document.boundary[:1], fixed("up-top", "y"), document.boundary[2], drag)
    document = replace(document, boundary=boundary, curves=(RAMP, curve(2, (0, 0), (0.5, 0), (1, 1))))
    _, whole = solve("whole", document)
    folder, found = solve("eroded", replace(document, adaptors=(erosion(these_elements(CORNER)),)))
    assert found.report.retries == whole.report.retries == 0
    assert np.isfinite(small.table(folder / "nodes.txt")).all()


def test_multipliers_as_unknowns_are_refused_with_a_mesh_adaptor(solve):
    document = replace(pressed("<laugon>LAGMULT</laugon>"), adaptors=(erosion(these_elements(CORNER)),))
    _, found = solve("lagmult", document, ends=False)
    assert found.report.steps == 0
    assert "LAGMULT" in " ".join(found.report.errors)
    assert "mesh adaptor (erosion)" in " ".join(found.report.errors)


def test_a_step_that_fails_after_elements_have_eroded_is_tried_again(solve):
    """FEBio restores its solver with the unknowns that the step began with; since then nodes have lost theirs."""
    stress = '<criterion type="min-max filter"><min>0.25</min><clamp>0</clamp><data type="stress"/></criterion>'
    document = replace(
        pressed("<penalty>3000</penalty>", steps=16, retries=8),  # which no failed step reduces
        adaptors=(erosion(stress, params="<max_elems>4</max_elems><sort>1</sort>"),),
    )
    boundary = (*document.boundary[:2], moved("up-top", "z", -0.4))
    ends = []
    for most in (25, 4):
        text = document.control.replace(TIGHT, "<dtol>0.003</dtol>").replace("<max_refs>25", f"<max_refs>{most}")
        folder, found = solve(str(most), replace(document, control=text, boundary=boundary))
        eroded = sum(map(int, re.findall(r"Deactivated elements: (\d+)", found.output)))
        ends.append((found.report.retries, eroded, small.table(folder / "nodes.txt")[-1]))
    (smooth, first, one), (failed, second, two) = ends
    assert smooth == 0 < failed
    assert first == second == 8
    low = slice(3 * (CELLS + 1) ** 2, None)
    np.testing.assert_allclose(one[low], two[low], atol=1e-9)


@pytest.mark.parametrize(("params", "says"), [("", True), ("<penalty>5</penalty>", False)])
def test_a_criterion_of_overlaps_asks_for_a_penalty(solve, params, says):
    criterion = '<criterion type="contact gap"><gap>0.01</gap></criterion>'
    _, found = solve("gap", replace(pressed(params), adaptors=(erosion(criterion),)))
    assert ('criterion "contact gap" measures the overlap of the surfaces' in found.output) == says
    assert ("Deactivated elements: " in found.output) != says


@pytest.mark.parametrize("surfaces", ["yes", "grow"])
@pytest.mark.parametrize("setting", ["penalty", "augmented"])
def test_a_run_goes_on_from_an_archive_after_elements_have_eroded(solve, setting, surfaces):
    document = replace(pressed(SETTINGS[setting], steps=4), adaptors=(erosion(these_elements(CORNER), surfaces),))
    plotted = '<Output><plotfile type="febio"><var type="displacement"/><var type="contact pressure"/></plotfile>'
    text = document.text().replace("<plot_level>PLOT_NEVER</plot_level>", "").replace("<Output>", plotted)
    folder, _ = solve("run", text, options=("-dump=1", "-dump_stride=3"))
    whole = small.table(folder / "nodes.txt")
    febio_runs.restart(folder / "model.dmp", plugin=engine.required_plugin())
    continued = small.table(folder / "nodes.txt")
    np.testing.assert_allclose(continued[-1], whole[-1], atol=1e-9)
