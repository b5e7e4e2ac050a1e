"""Ties between bodies with fluid and a solute that break: balances, what crosses a crack, runs that are interrupted."""

from __future__ import annotations

import re
import shutil
from dataclasses import replace
from pathlib import Path

import febio_runs
import numpy as np
import pytest
from scenes.breaking_blocks import CYCLES, soaked_blocks
from scenes.contents import Soaked
from scenes.delamination import (
    Strips,
    double_cantilever_beam,
    path_of_peeling,
    peeled,
    soaked,
    soaked_beam,
    two_strips,
    with_energy,
)

from harness.run import engine
from studies.models import small
from studies.models.small import Document, curve

pytestmark = pytest.mark.mixture_only

BRITTLE = "<max_traction>0.05</max_traction>"
COHESIVE = f"{BRITTLE}<fracture_energy>0.001</fracture_energy>"
FRICTION = "<fric_coeff>0.3</fric_coeff>"
BATH = 0.7
AMBIENT = f'<ambient_concentration sol="1">{BATH}</ambient_concentration>'
SEALED = "<free_draining>0</free_draining>"
LASTING = "<auto_penalty>1</auto_penalty><penalty>50</penalty>"
"""A penalty that no failed step reduces."""
ALL_KEPT = 1e-12
"""Of the content."""


def times_of(folder: Path, file: str) -> np.ndarray:
    """Times of the logged states."""
    lines = (folder / file).read_text().splitlines()
    return np.array([float(line.split("=")[1]) for line in lines if line.startswith("*Time")])


# ------------------------------------------------------------ balances


def losses(
    folder: Path, document: Document, strips: Strips, force: np.ndarray, moved: np.ndarray
) -> tuple[float, float]:
    """The part of the work without an energy, and the part of the solute that is lost or made.

    The work is stored in the solid, dissipated by bonds, or done on the fluid. `force` and `moved`: of what is moved,
    shape (times, components).
    """
    steps = 0.5 * (force[1:] + force[:-1]) * np.diff(moved, axis=0)
    work = np.concatenate([[0], np.cumsum(steps.sum(axis=1))])
    inside = Soaked(document, small.table(folder / "nodes.txt"))
    rows = small.table(folder / "surface-up-tied.txt")[:, 0]
    stored = small.table(folder / "sed.txt")[..., 0].sum(axis=1) * strips.element
    left = work - stored - inside.work_on_fluid() - rows[:, [3, 4, 6]].sum(axis=1)
    assert rows[-1, 5] > 0
    assert inside.work_on_fluid()[-1] > 0.05 * work[-1]
    content = inside.solute.sum(axis=1)
    return float(np.abs(left / work[-1]).max()), float(np.abs(content / content[0] - 1).max())


def lost_by_beam(solve, steps: int) -> tuple[float, float]:
    """The losses of a double cantilever beam."""
    strips = Strips(steps=steps, more=SEALED)
    document = soaked_beam(strips)
    folder, finished = solve(f"beam-{steps}", with_energy(document.text()))
    assert finished.report.retries == 0
    nodes = small.table(folder / "nodes.txt")
    ends = {
        name: np.array(re.search(rf'<NodeSet name="{name}-left">([^<]*)<', document.mesh).group(1).split(","), int) - 1
        for name in ("low", "up")
    }
    load = nodes[:, ends["low"], 6].sum(axis=1) - nodes[:, ends["up"], 6].sum(axis=1)
    opening = 0.5 * strips.opening * times_of(folder, "nodes.txt")
    return losses(folder, document, strips, load[:, None], opening[:, None])


def lost_by_peeling(solve, steps: int) -> tuple[float, float]:
    """The losses of a strip that is peeled off at an angle."""
    strips = Strips(cells=2, length=12.0, crack=4.0, energy=5.0, strength=7.0, opening=8.0, steps=steps, more=SEALED)
    angle = np.radians(60)
    document = soaked(peeled(strips, angle), strips)
    folder, _ = solve(f"peel-{steps}", with_energy(document.text()))
    places = np.array(two_strips(strips).nodes)
    end = np.abs(places[:, [0, 2]] - (0.0, 0.5 * strips.thickness)).max(axis=1) < 1e-9
    force = small.table(folder / "nodes.txt")[:, end, 5:].sum(axis=1)
    path = path_of_peeling(strips, angle)
    times = times_of(folder, "nodes.txt")
    moved = np.column_stack([np.interp(times, path[:, 0], path[:, k]) for k in (1, 2)])
    return losses(folder, document, strips, np.sign(force[-1] @ (moved[-1] - moved[-2])) * force, moved)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lost", "steps"), [(lost_by_beam, 40), (lost_by_peeling, 80)], ids=["double cantilever beam", "peeling"]
)
def test_work_and_solute_are_kept_while_a_crack_runs(solve, lost, steps):
    work, solute = lost(solve, steps)
    assert work <= 1e-3
    assert solute <= ALL_KEPT
    assert work < lost(solve, steps // 2)[0]


# ------------------------------------------------------------ what crosses


CROSSED = {
    "brittle": f"{BRITTLE}{FRICTION}",
    "AUGLAG": f"<laugon>AUGLAG</laugon>{BRITTLE}",
    "LAGMULT": f"<laugon>LAGMULT</laugon>{BRITTLE}",
    "cohesive": f"{COHESIVE}{FRICTION}",
}


@pytest.mark.parametrize("bath", [SEALED, AMBIENT], ids=["sealed", "bath"])
@pytest.mark.parametrize("name", CROSSED)
def test_fluid_and_solute_cross_bonds_and_closed_cracks_alone(solve, name, bath):
    document = soaked_blocks(CROSSED[name] + bath)
    folder, _ = solve("crossed", document)
    up, low = (small.table(folder / f"surface-{each}.txt")[1:, 0] for each in ("up-bottom", "low-top"))
    assert np.all(up[:, 6:] + low[:, 6:] == 0)
    was_broken = np.append(False, up[:-1, 5] == 1)
    opens = was_broken & (up[:, 2] == 0)
    assert np.count_nonzero(opens) > 5
    assert np.all(up[opens, 6:] == 0)
    presses = was_broken & (up[:, 2] > 0.01)
    assert np.count_nonzero(presses) > 5
    assert np.all(np.abs(up[presses, 6:]).max(axis=0) > 1e-4)
    nodes = small.table(folder / "nodes.txt")
    if bath == SEALED:
        content = Soaked(document, nodes).solute.sum(axis=1)
        assert np.abs(content / content[0] - 1).max() <= ALL_KEPT
        return
    face = np.array(re.search(r'<NodeSet name="up-bottom">([^<]*)<', document.mesh).group(1).split(","), int) - 1
    assert np.abs(nodes[1:][opens][:, face, 4] - BATH).max() <= 1e-12
    assert np.abs(nodes[1:][opens][:, face, 3]).max() <= 1e-12


# ------------------------------------------------------------ interrupted runs

CONTINUED = {
    "brittle": f"{BRITTLE}{AMBIENT}",
    "brittle, friction": f"{BRITTLE}{AMBIENT}{FRICTION}",
    "LAGMULT": f"<laugon>LAGMULT</laugon>{BRITTLE}{AMBIENT}",
    "cohesive": f"{COHESIVE}{AMBIENT}",
    "cohesive, friction": f"{COHESIVE}{AMBIENT}{FRICTION}",
    "viscous, friction": f"{COHESIVE}{AMBIENT}{FRICTION}<viscosity>0.05</viscosity>",
}
LOGGED = ("nodes.txt", "surface-up-bottom.txt", "surface-low-top.txt")


def differences(one: Path, two: Path) -> dict[str, float]:
    """Largest differences of the states that both runs have logged."""
    found = {}
    for file in LOGGED:
        states = [small.table(folder / file) for folder in (one, two)]
        last = min(len(each) for each in states)
        found[file] = float(np.abs(states[0][-last:] - states[1][-last:]).max())
    return found


@pytest.mark.slow
@pytest.mark.parametrize("stride", [11, 21, 27])
@pytest.mark.parametrize("name", CONTINUED)
def test_a_run_that_is_continued_is_as_one_that_was_not(solve, tmp_path, name, stride):
    """Continued after 33, 21 and 27 of 40 steps: in the middle of sliding, as contact begins, and as sliding turns."""
    text = soaked_blocks(CONTINUED[name]).text().replace("PLOT_NEVER", "PLOT_MAJOR_ITRS")
    folder, _ = solve("whole", text, options=("-dump=1", f"-dump_stride={stride}"))
    part = shutil.copytree(folder, tmp_path / "part")
    for file in LOGGED:
        (part / file).unlink()
    febio_runs.restart(part / "model.dmp", plugin=engine.required_plugin())
    assert max(differences(folder, part).values()) <= 1e-9


@pytest.mark.parametrize("name", ["LAGMULT", "cohesive, friction"])
def test_two_threads_make_the_same_run(solve, monkeypatch, name):
    """To rounding: FEBio adds the loads of elements in the order of its threads."""
    monkeypatch.setenv("OMP_WAIT_POLICY", "passive")
    runs = []
    for threads in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        runs.append(solve(threads, soaked_blocks(CONTINUED[name])))
    assert runs[0][1].report.iterations == runs[1][1].report.iterations
    assert differences(runs[0][0], runs[1][0])["nodes.txt"] <= 1e-10


def stepper(retries: int, longest: str) -> str:
    """A time stepper whose steps end where a curve or the failed attempts demand."""
    inner = f"<max_retries>{retries}</max_retries><opt_iter>1000000</opt_iter><dtmin>0</dtmin>{longest}"
    return (
        f'<time_stepper type="default">{inner}<aggressiveness>1</aggressiveness><cutback>0.5</cutback></time_stepper>'
    )


def interrupted(params: str, spike: float) -> Document:
    """Blocks that no step reaches at one time, because their displacement is far beyond all others."""
    points = [(t, z) for t, z in CYCLES if t != spike]
    times, path = np.array(CYCLES).T
    near = [(t, float(np.interp(t, times, path))) for t in (spike - 1e-3, spike + 1e-3)]
    document = soaked_blocks(params)
    down = curve(1, *sorted([*points, *near, (spike, -50.0)]))
    control = document.control.replace("<solver", f"{stepper(5, '<dtmax>0.125</dtmax>')}<solver")
    return replace(document, curves=(down, document.curves[1]), control=control)


@pytest.mark.slow
@pytest.mark.parametrize("spike", [0.25, 0.375, 2.5])
@pytest.mark.parametrize("name", ["brittle, friction", "cohesive, friction", "viscous, friction"])
def test_an_attempt_that_fails_leaves_nothing(solve, name, spike):
    """While bonds soften, and while broken nodes slide."""
    cut = interrupted(CONTINUED[name] + LASTING, spike)
    one, finished = solve("cut", cut)
    assert finished.report.retries > 0
    times = times_of(one, "nodes.txt")
    points = "".join(f"<pt>{t!r},20</pt>" for t in times.tolist())
    inner = f"<interpolate>STEP</interpolate><points>{points}</points>"
    ends = f'<load_controller id="3" type="loadcurve">{inner}</load_controller>'
    forced = stepper(0, '<dtmax lc="3">1</dtmax><dtforce>1</dtforce>')
    control = re.sub(r"<time_stepper.*</time_stepper>", forced, cut.control)
    two, finished = solve("straight", replace(cut, curves=(*cut.curves, ends), control=control))
    assert finished.report.retries == 0
    np.testing.assert_allclose(times_of(two, "nodes.txt"), times, rtol=1e-8)
    assert differences(one, two)["nodes.txt"] <= 1e-8


# ------------------------------------------------------------ advice


def test_a_step_that_fails_as_bonds_soften_has_the_advice_of_the_tie(solve):
    """And none of the sliding contact of broken nodes, which is open."""
    text = re.sub(r"<max_refs>\d+<", "<max_refs>4<", double_cantilever_beam(Strips(steps=10)).text())
    _, finished = solve("failed", text, ends=False)
    output = " ".join(finished.output.split())
    assert output.count("bonds soften in the step that has failed") == 1
    assert 'tied-mixture "tie": ' in output.split("bonds soften in the step")[0][-40:]
    assert "began without a node in contact" not in output
