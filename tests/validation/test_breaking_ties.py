"""Ties that break: the cohesive law to rounding, what broken nodes do, continued runs."""

from __future__ import annotations

import shutil
from dataclasses import replace

import febio_runs
import numpy as np
import pytest
from scenes.breaking_blocks import PRESSED, cohesive, moved_on_a_path, pressed_and_slid
from scenes.tied_cubes import joint

from harness.preflight.check import check
from harness.run import engine
from studies.models import small

pytestmark = pytest.mark.mixture_only

STRENGTH, ENERGY, MIXING, STIFFNESS = (1.0, 1.5), (0.1, 0.3), 2.3, 50.0
LAW = cohesive(STRENGTH, ENERGY, MIXING, STIFFNESS)


def limits(mode: float) -> tuple[float, float]:
    """Openings at which a bond begins to soften and breaks, by the part of shear in the square of the opening."""
    power = mode**MIXING
    strength = np.sqrt(STRENGTH[0] ** 2 + (STRENGTH[1] ** 2 - STRENGTH[0] ** 2) * power)
    return strength / STIFFNESS, 2 * (ENERGY[0] + (ENERGY[1] - ENERGY[0]) * power) / strength


def tractions(path: np.ndarray) -> np.ndarray:
    """Tractions that resist a path of gap vectors; damage is the largest so far."""
    damage, found = 0.0, []
    for gap in path:
        pressed = min(0.0, gap[2])
        size = np.sqrt(gap @ gap - pressed**2)
        if size > 0:
            begin, end = limits((gap[:2] @ gap[:2]) / size**2)
            damage = max(damage, min(1.0, end * (size - begin) / (size * (end - begin))))
        found.append((1 - damage) * STIFFNESS * gap + damage * STIFFNESS * pressed * np.array([0, 0, 1]))
    return np.array(found)


DIGITS = 4
"""Of sizes of openings, whose components then have the six that a load curve has."""
DIRECTIONS = {"tension": (0.0, 1.0), "shear": (1.0, 0.0), "both": (0.6, 0.8)}
PARTS = np.concatenate([np.linspace(0.02, 0.5, 8), np.linspace(0.4, 0.0, 3), np.linspace(0.1, 1.02, 12)])
"""Openings over the one at which the bond breaks: loaded, unloaded to the origin, loaded until it breaks."""


@pytest.mark.parametrize("name", DIRECTIONS)
def test_an_element_follows_the_law_and_takes_its_energy(solve, name):
    across, along = DIRECTIONS[name]
    _, end = limits(across**2)
    path = np.round(end * PARTS, DIGITS)[:, None] * np.array([0.8 * across, 0.6 * across, along])
    folder, _ = solve("law", moved_on_a_path(path, LAW))
    rows = small.table(folder / "surface-up-bottom.txt")[1:, 0]
    assert np.abs(rows[:, :3] + tractions(path)).max() <= 1e-8
    energy = ENERGY[0] + (ENERGY[1] - ENERGY[0]) * across ** (2 * MIXING)
    assert rows[-1, 3] == pytest.approx(energy, rel=1e-6)
    assert rows[-1, 5] == 1.0
    assert np.all(np.diff(rows[:, 3]) >= 0)


def test_compression_is_borne_by_damaged_and_by_broken_nodes(solve):
    begin, end = limits(0.0)
    up = np.array([0.5 * (begin + end), 0.0, -0.01, 1.1 * end, 0.01, -0.01])
    folder, _ = solve("pressed", moved_on_a_path(up[:, None] * np.array([0, 0, 1.0]), LAW))
    rows = small.table(folder / "surface-up-bottom.txt")[1:, 0]
    force = -rows[:, 2]
    assert force[[2, 5]] == pytest.approx([-0.01 * STIFFNESS] * 2, rel=1e-8)
    assert force[[1, 3, 4]] == pytest.approx([0, 0, 0], abs=1e-12)
    assert list(rows[:, 5]) == [0, 0, 0, 1, 1, 1]


BRITTLE = "<max_traction>0.1</max_traction>"
TILT = PRESSED / 1.0
"""Slope that the faces may have: the block is pressed in by this part of its width. It turns pressure into shear."""
BROKEN = {
    "PENALTY": BRITTLE,
    "AUGLAG": f"<laugon>AUGLAG</laugon>{BRITTLE}",
    "LAGMULT": f"<laugon>LAGMULT</laugon>{BRITTLE}",
    "friction": f"{BRITTLE}<fric_coeff>0.3</fric_coeff>",
    "cohesive": "<max_traction>0.1</max_traction><fracture_energy>0.001</fracture_energy><fric_coeff>0.3</fric_coeff>",
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_nodes_part_press_and_slide(solve, name):
    folder, _ = solve(f"slid-{name}", pressed_and_slid(BROKEN[name]))
    low, up = (small.table(folder / f"surface-{each}.txt")[1:, 0] for each in ("low-top", "up-bottom"))
    assert np.all(np.abs(low[:, :3] + up[:, :3]).max(axis=0) <= 1e-12 * np.abs(low[:, :3]).max())
    times = 5 / len(up) * np.arange(1, len(up) + 1)
    pull = -up[:, 2]
    assert 0.02 < pull.max() < 0.1
    assert up[-1, 5] == pytest.approx(1.0, rel=1e-9)
    assert np.abs(pull[(up[:, 5] > 0.999) & (times <= 1)]).max(initial=0.0) <= 1e-12
    pressed = times >= 2
    assert np.all(pull[pressed] < -0.01)
    slides = np.abs(up[pressed, 0]) / -pull[pressed]
    friction = 0.3 if "fric" in BROKEN[name] else 0.0
    assert slides[-3:] == pytest.approx([friction] * 3, abs=TILT)


@pytest.mark.parametrize("name", ["friction", "cohesive"])
@pytest.mark.parametrize("stride", [6, 26])
def test_a_run_that_is_continued_is_as_one_that_was_not(solve, tmp_path, name, stride):
    """Continued as bonds soften or break, and as broken nodes slide."""
    text = pressed_and_slid(BROKEN[name]).text().replace("PLOT_NEVER", "PLOT_MAJOR_ITRS")
    folder, _ = solve(f"whole-{name}-{stride}", text, options=("-dump=1", f"-dump_stride={stride}"))
    part = shutil.copytree(folder, tmp_path / "part")
    for file in ("nodes.txt", "surface-up-bottom.txt"):
        (part / file).unlink()
    febio_runs.restart(part / "model.dmp", plugin=engine.required_plugin())
    for file in ("nodes.txt", "surface-up-bottom.txt"):
        whole, continued = (small.table(each / file)[-1] for each in (folder, part))
        assert np.abs(continued - whole).max() <= 1e-9, file


WRONG = [
    ("<max_traction>0</max_traction>", "<max_traction> is 0"),
    ("<max_shear>1</max_shear>", "<max_shear> is set without <max_traction>"),
    ("<fracture_energy>1</fracture_energy>", "<fracture_energy> is set without <max_traction>"),
    (f"{BRITTLE}<fracture_energy>1</fracture_energy><mixing>0.5</mixing>", "at least 1"),
    (f"{BRITTLE}<mixing>3</mixing>", "<mixing> is set without <fracture_energy>"),
    (f"{BRITTLE}<viscosity>1</viscosity>", "<viscosity> is set without <fracture_energy>"),
    (f"{BRITTLE}<fracture_energy>1</fracture_energy><viscosity>-1</viscosity>", "<viscosity> is -1"),
    ("<fric_coeff>0.1</fric_coeff>", "the tie cannot break"),
    ("<ambient_pressure>1</ambient_pressure>", "the tie cannot break"),
    ("<free_draining>0</free_draining>", "the tie cannot break"),
    (f"<laugon>AUGLAG</laugon>{BRITTLE}<fracture_energy>1</fracture_energy>", "needs <laugon>PENALTY"),
    (f"{BRITTLE}<fracture_energy>1e-12</fracture_energy>", "to soften"),
    (f"<penalty>0</penalty>{BRITTLE}", "nothing can break"),
]


@pytest.mark.parametrize(("tags", "said"), WRONG)
def test_values_that_make_no_sense_are_named(solve, tags, said):
    _, finished = solve("wrong", moved_on_a_path([[0, 0, 0.1]], tags), ends=False)
    assert said in " ".join(finished.output.replace("*", " ").split())


BOUNDS = {
    # A penalty of 50 times the stiffness, 1 MPa/mm, is strength^2/(2 energy).
    "soft-bonds": ((2, 3), 1.0, 0.01, "to soften"),
    # Three facets of a sixth are E energy/strength^2, which is shorter than the zone of a layer here.
    "cohesive-zone": ((2, 6), 0.5, 0.125, "bonds soften over a length"),
}
"""By rules: cells of two cubes of 1 MPa, strength, the energy at which the rule begins, and the plugin's words."""


@pytest.mark.parametrize("part", [0.98, 1.02])
@pytest.mark.parametrize("rule", BOUNDS)
def test_check_and_the_plugin_have_one_bound(solve, rule, part):
    cells, strength, energy, said = BOUNDS[rule]
    law = f"<max_traction>{strength}</max_traction><fracture_energy>{part * energy}</fracture_energy>"
    drawn = small.curve(1, (0, 0), (1, 1))
    document = replace(joint(law, cells=cells), curves=(drawn,), control=small.control("solid", 1, 1.0))
    folder, finished = solve("bound", document, ends=rule != "soft-bonds" or part > 1)
    assert (said in " ".join(finished.output.replace("*", " ").split())) == (part < 1)
    assert any(finding.rule == rule for finding in check(folder / "model.feb")) == (part < 1)
