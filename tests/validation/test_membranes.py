"""Membranes between the surfaces: films with a conductance, permeances and reflection coefficients of their own."""

from __future__ import annotations

import shutil
from dataclasses import replace

import febio_runs
import numpy as np
import pytest

from harness.closed_forms import composite_slab
from harness.models.composite import AMBIENT, FIRST, SECOND, Composite
from harness.models.diffusion import Diffusion
from harness.models.interface import ContactSettings
from harness.models.mesh import Section
from harness.models.parts import (
    GAS_CONSTANT,
    TEMPERATURE,
    Control,
    Param,
    displace,
    fix,
    initial_concentration,
    initial_pressure,
)
from harness.run import engine, logdata
from harness.run.hosts import STANDALONE
from harness.run.runner import Runner
from studies.closed_forms.film import Faces, Film
from studies.models.membrane import FACES, Membrane, film_params

pytestmark = pytest.mark.mixture_only

STEADY = Control(40, 3e4)
ENFORCEMENTS = {
    "penalty": (),
    "augmented": (Param("laugon", "AUGLAG"),),
    "multipliers": (Param("laugon", "LAGMULT"),),
    "two passes": (Param("two_pass", True),),
}
FILMS = {
    "leaky": Membrane().film,
    "semipermeable": Film(2e-3, 2e-5, 1.0),
    "not reflecting": Film(2e-3, 2e-5, 0.0),
    "against the flow": Film(2e-3, 2e-5, 0.3),
}
REVERSED = Faces(FACES.pressures[::-1], FACES.concentrations, FACES.thermal_energy)


def last_at_contact(run):
    """p~ and c~ on both sides of the film at the end, each of shape (2,)."""
    last = run.nodes
    mesh = run.model.mesh
    sides = [np.unique(mesh.surfaces[name]) - 1 for name in mesh.pairs["lower/upper"]]
    return [np.array([last[name][-1, nodes].mean() for nodes in sides]) for name in ("p", "c1")]


def steady_error(run, expected):
    """Largest relative error of both fluxes and of what both sides of the film have."""
    w, j = (run.elements[name][-1] for name in ("wz", "jz"))
    found = [*w, *j, *np.concatenate(last_at_contact(run))]
    exact = [expected.solvent] * len(w) + [expected.solute] * len(j) + [*expected.pressures, *expected.concentrations]
    return np.abs(np.array(found) / exact - 1.0).max()


@pytest.mark.parametrize("enforcement", ENFORCEMENTS)
def test_steady_flow_through_film_and_layers(runner, enforcement):
    scene = Membrane(control=STEADY, enforcement=ENFORCEMENTS[enforcement])
    assert steady_error(runner(scene.model()), scene.closed_form()) <= 1e-6


@pytest.mark.parametrize("film", FILMS)
def test_steady_flow_through_films_of_all_kinds(runner, film):
    faces = REVERSED if film == "against the flow" else FACES
    scene = Membrane(control=STEADY, film=FILMS[film], faces=faces)
    assert steady_error(runner(scene.model()), scene.closed_form()) <= 1e-6


def test_steady_flow_through_a_film_that_moves(runner):
    """In a stiff solid, whose surfaces are free to move and to be searched for.

    Displacements there are no measure of convergence, and the steps end before changes are rounding.
    """
    scene = Membrane(control=Control(3, 1e6, displacement_tolerance=0.0))
    model = scene.model()
    stiff = {
        name: replace(mixture, solid=replace(mixture.solid, modulus=1e6)) for name, mixture in model.materials.items()
    }
    held = (fix("all", "xy"), fix("bottom", "z"), displace("top", "z", -1e-7), *model.conditions[1:])
    run = runner(replace(model, name="membrane-moving", materials=stiff, conditions=held))
    assert "exchanges traction, solvent, solute 1" in run.log
    assert steady_error(run, scene.closed_form()) <= 1e-6


def test_transient_diffusion_through_a_film(runner):
    """Two layers of different material and a film of finite permeance, closed form 2.4, on two meshes."""
    permeance = 4e-4
    settings = ContactSettings(extra=film_params(Film(1e-3, permeance, 1.0), sol="1"))

    def error(elements, control):
        model = Composite(settings=settings, elements=elements, control=control).model()
        history = runner(replace(model, name=f"film-{elements}")).nodes
        late = history.times >= 500.0
        z = model.mesh.nodes[:, 2].copy()
        z[np.unique(model.mesh.parts[1].elements) - 1] += 1e-12  # both sides of the film are at the same place
        exact = [composite_slab.concentration(z, t, FIRST, SECOND, conductance=permeance) for t in history.times[late]]
        return np.abs(history["c1"][late] / AMBIENT - exact).max()

    coarse, fine = error(10, Control(100, 20.0)), error(20, Control(200, 10.0))
    assert coarse <= 1e-2
    assert fine <= 0.6 * coarse


def test_a_film_of_finite_permeance_is_the_same_law_as_a_penalty(runner):
    conductance, permeance = 1e-3, 4e-4
    film = ContactSettings(extra=film_params(Film(conductance, permeance, 1.0), sol="1"))
    penalty = ContactSettings(pressure_penalty=conductance, concentration_penalty=permeance)
    runs = [
        runner(replace(Composite(settings=settings, elements=5, control=Control(10, 100.0)).model(), name=name)).nodes
        for name, settings in (("as-film", film), ("as-penalty", penalty))
    ]
    np.testing.assert_array_equal(*(run.values for run in runs))


def test_osmosis_at_rest(runner):
    """Two swelling bodies, each with its own solute, and a film that lets the solvent pass alone: [p] = R T [c]."""
    film = film_params(Film(1e-3, 0.0, 1.0), sol="1")
    model = Diffusion(settings=ContactSettings(extra=film), elements=4, control=Control(40, 2e4)).model()
    # The lower face meets a bath; the upper body is sealed but for the film.
    bodies = {part.name: np.unique(part.elements) for part in model.mesh.parts}
    begin = (
        *(initial_concentration(name, value) for name, value in (("lower", 1.0), ("upper", 2.0))),
        *(initial_pressure(name, -GAS_CONSTANT * TEMPERATURE) for name in bodies),
    )
    mesh = replace(model.mesh, node_sets={**model.mesh.node_sets, **bodies})
    model = replace(
        model, name="osmosis", mesh=mesh, conditions=(*model.conditions, *begin), element_columns=("p", "c")
    )
    run = runner(model)
    p, c = (run.elements[name][-1] for name in ("p", "c"))
    count = len(model.mesh.parts[0].elements)
    jump_p, jump_c = (values[:count].mean() - values[count:].mean() for values in (p, c))
    assert abs(jump_c) > 0.5
    assert abs(jump_p / (GAS_CONSTANT * TEMPERATURE * jump_c) - 1.0) <= 1e-8


@pytest.mark.parametrize(
    ("params", "effects"),
    [
        ((Param("hydraulic_conductance", 0.0),), "traction, solutes"),
        ((Param("solute_permeance", 0.0), Param("reflection", 1.0)), "traction, solvent"),
    ],
)
def test_a_film_that_stops_a_field_is_a_contact_without_it(runner, params, effects):
    runs = [
        runner(
            replace(
                Diffusion(settings=ContactSettings(extra=extra), elements=5, control=Control(10, 100.0)).model(),
                name=name,
            )
        ).nodes
        for name, extra in (
            (f"stopped-{len(params)}", params),
            (f"without-{len(params)}", (Param("effects", effects),)),
        )
    ]
    np.testing.assert_array_equal(*(run.values for run in runs))


def test_a_film_that_lets_everything_pass_is_no_film(runner):
    free = Membrane(control=STEADY, film=Film(1e10, 1e10, 1.0), enforcement=ENFORCEMENTS["multipliers"]).model()
    none = Membrane(control=STEADY, settings=ContactSettings(laugon="LAGMULT")).model()
    one, two = (runner(replace(model, name=name)).nodes for model, name in ((free, "free"), (none, "no-film")))
    for column in ("p", "c1"):
        size = np.abs(two[column]).max()
        assert np.abs(one[column] - two[column]).max() <= 1e-8 * size


def test_what_leaves_one_side_enters_the_other(runner, tmp_path):
    model = Membrane(control=Control(10, 5e3), elements=6, section=Section((1.0, 1.0), (2, 3))).model()
    path = model.write(tmp_path)
    logged = ("contact solvent flow", "contact solute flow 1")
    names = model.mesh.pairs["lower/upper"]
    lines = "".join(
        f'<surface_data surface="{name}" data="{";".join(logged)}" file="{name}.txt" delim=" "/>' for name in names
    )
    path.write_text(path.read_text().replace("</logfile>", f"{lines}</logfile>"))
    febio_runs.run(path, plugin=engine.required_plugin())
    one, two = (logdata.read_history(tmp_path / f"{name}.txt", logged).values[:, 0] for name in names)
    assert np.all(np.abs(one[1:]).max(axis=0) > 0.0)
    np.testing.assert_allclose(one, -two, rtol=1e-12, atol=1e-12 * np.abs(one).max(axis=0).min())


def test_restart(runner, tmp_path):
    model = replace(Membrane(control=Control(20, 5e3), elements=5, plot=True).model(), name="film-restart")
    run = runner(model, options=("-dump=1", "-dump_stride=12"))
    folder = shutil.copytree(run.folder, tmp_path / "continued")
    (folder / model.node_file).unlink()
    febio_runs.restart(folder / "film-restart.dmp", plugin=engine.required_plugin())
    whole, part = run.nodes, logdata.read_history(folder / model.node_file, model.node_columns)
    np.testing.assert_allclose(part.values, whole.values[13:], atol=1e-10, rtol=0.0)


def test_the_embedded_engine_has_the_same_film(runner, tmp_path):
    scene = Membrane(control=STEADY)
    STANDALONE.binaries(plugin=True)
    run = Runner(tmp_path, host=STANDALONE)(scene.model())
    assert steady_error(run, scene.closed_form()) <= 1e-6


def _model(*params):
    return Diffusion(settings=ContactSettings(extra=params), elements=2, control=Control(1, 100.0)).model()


@pytest.mark.parametrize(
    ("params", "said"),
    [
        ((Param("hydraulic_conductance", -1.0),), "<hydraulic_conductance>"),
        ((Param("solute_permeance", -1.0), Param("reflection", 1.0)), "<solute_permeance>"),
        ((Param("solute_permeance", 1.0), Param("reflection", 1.5)), "<reflection>"),
        ((Param("solute_permeance", 1.0),), "A membrane needs both"),
        ((Param("reflection", 1.0),), "A membrane needs both"),
        ((Param("solute_permeance", 1.0), Param("reflection", 0.5)), "<hydraulic_conductance> is not given"),
        ((Param("solute_permeance", 1.0, None, {"sol": "3"}), Param("reflection", 1.0)), "does not have"),
    ],
)
def test_films_that_mean_nothing(runner, tmp_path, params, said):
    path = _model(*params).write(tmp_path)
    finished = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
    assert not finished.report.normal
    assert said in path.with_suffix(".log").read_text()


def test_a_penalty_beside_a_film_is_noticed(runner):
    params = (Param("hydraulic_conductance", 1e-3), Param("pressure_penalty", 1e-3))
    assert "<pressure_penalty> has no effect" in runner(replace(_model(*params), name="penalty-beside-film")).log
