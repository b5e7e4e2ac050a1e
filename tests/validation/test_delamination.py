"""Strips that come apart: their loads by beam theory, and their balance of work."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scenes.delamination import (
    TURNED,
    WHOLE,
    Strips,
    double_cantilever_beam,
    drawn_along,
    end_notched_flexure,
    path_of_peeling,
    peeled,
    two_strips,
    with_energy,
)

from studies.models import small
from studies.models.small import moved

pytestmark = pytest.mark.mixture_only


def times_of(folder: Path) -> np.ndarray:
    """Times of the logged states."""
    lines = (folder / "surface-up-tied.txt").read_text().splitlines()
    return np.array([float(line.split("=")[1]) for line in lines if line.startswith("*Time")])


def unaccounted(folder: Path, strips: Strips, load: np.ndarray, moved: np.ndarray) -> np.ndarray:
    """The part of the work that is neither stored nor dissipated; `load` and `moved` of each state."""
    steps = 0.5 * (load[1:] + load[:-1]) * np.diff(moved, axis=0)
    work = np.concatenate([[0], np.cumsum(steps.reshape(len(steps), -1).sum(axis=1))])
    stored = small.table(folder / "sed.txt")[..., 0].sum(axis=1) * strips.element
    bonds = small.table(folder / "surface-up-tied.txt")[:, 0][:, [3, 4, 6]].sum(axis=1)
    return (work - stored - bonds) / work[-1]


def solved(solve, name: str, text: str) -> Path:
    folder, _ = solve(name, with_energy(text))
    return folder


# ------------------------------------------------------------ double cantilever beam


def load_by_theory(strips: Strips, opening: np.ndarray) -> np.ndarray:
    """Load of a beam whose crack runs, by the opening of its ends, N.

    Timoshenko's beam has the compliance C(a) = 8 a^3/(E b h^3) + 24 a/(5 E b h) without Poisson's ratio, and the crack
    runs at P^2 C'(a)/(2 b) = G. The length a that both the load and the opening follow from holds the rotation at the
    root.
    """
    a = np.linspace(strips.crack, strips.length, 2000)
    e, b, h = strips.modulus, strips.width, strips.thickness
    compliance = 8 * a**3 / (e * b * h**3) + 4.8 * a / (e * b * h)
    load = np.sqrt(2 * b * strips.energy / (24 * a**2 / (e * b * h**3) + 4.8 / (e * b * h)))
    return np.interp(opening, load * compliance, load)


def drawn_apart(solve, name: str, strips: Strips) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Openings and loads where the crack runs, and the part of the work that no energy accounts for."""
    folder = solved(solve, name, double_cantilever_beam(strips).text())
    assert "failed to converge" not in (folder / "model.log").read_text()
    rows = small.table(folder / "surface-up-tied.txt")[:, 0]
    opening, load = strips.opening * times_of(folder), -rows[:, 2]
    runs = rows[:, 5] > 0
    return opening[runs], load[runs], unaccounted(folder, strips, load, opening)


def errors(solve, strips: Strips) -> tuple[float, float]:
    """The largest error of the load relative to that of theory, and the largest part of the work without an energy."""
    opening, load, lost = drawn_apart(solve, f"beam-{strips.cells}-{strips.steps}", strips)
    assert len(opening) > 5
    return float(np.abs(load / load_by_theory(strips, opening) - 1).max()), float(np.abs(lost).max())


def test_the_load_is_that_of_beam_theory_and_the_work_is_stored_or_dissipated(solve):
    load, lost = errors(solve, Strips())
    assert load <= 0.03
    assert lost <= 1e-3


@pytest.mark.slow
def test_finer_meshes_and_smaller_steps_are_nearer_to_theory(solve):
    """The work of a load that is straight over a step has an error of second order."""
    load, lost = errors(solve, Strips())
    assert errors(solve, Strips(cells=6))[0] < load
    assert lost < 0.25 * errors(solve, Strips(steps=20))[1]


def test_viscosity_raises_the_load_of_a_zone_that_is_too_short(solve):
    """Bonds so strong that the zone in which they soften spans fewer than three facets."""
    found = {}
    for viscosity in (0.02, 0.01):
        strips = Strips(strength=1.0, more=f"<viscosity>{viscosity}</viscosity>")
        opening, load, _ = drawn_apart(solve, f"viscous-{viscosity}", strips)
        found[viscosity] = np.mean(load / load_by_theory(strips, opening))
    assert 1 < found[0.01] < found[0.02]


# ------------------------------------------------------------ bonds that shear

UNCRACKED = Strips(length=4.0, crack=-1.0, modulus=5.0, steps=20)


@pytest.mark.parametrize(("strength", "energy", "drawn"), [(0.15, 4.5e-3, 0.2), (0.05, 5e-4, 0.07)])
def test_steps_in_which_bonds_shear_converge_with_the_default_penalty(solve, strength, energy, drawn):
    strips = replace(UNCRACKED, strength=strength, energy=energy, opening=drawn)
    folder, _ = solve("drawn-along", drawn_along(strips))
    assert "failed to converge" not in (folder / "model.log").read_text()
    assert small.table(folder / "surface-up-tied.txt")[-1, 0, 5] > 0


LAST_BONDS = replace(UNCRACKED, strength=0.5, energy=0.05, opening=1.08)


def pressed_layer():
    """A layer that is pressed on another one and drawn along it."""
    along = drawn_along(LAST_BONDS)
    return replace(along, boundary=[*along.boundary, moved("up-top", "z", -0.01)])


def test_the_last_bonds_of_a_pressed_layer_break_at_once(solve):
    """Full increments of Newton's method would invert elements there, in shorter steps as well."""
    strips = LAST_BONDS
    folder, finished = solve("last-bonds", pressed_layer())
    assert finished.report.retries == 1
    assert re.search(r"search_after_failure 1\b", (folder / "model.log").read_text())
    rows = small.table(folder / "surface-up-tied.txt")[:, 0]
    area = strips.length * strips.width
    assert rows[-1, 5] == pytest.approx(area, rel=1e-9)
    assert rows[-1, 3] == pytest.approx(strips.energy * area, rel=1e-6)
    assert np.abs(rows[-1, 0]) <= 1e-3 * np.abs(rows[:, 0]).max()
    in_one_step = np.diff(rows[:, 5]).max()
    assert in_one_step > 0.5 * area


def test_without_its_device_the_layer_fails(solve):
    tag = "</contact>"
    text = pressed_layer().text()
    assert text.count(tag) == 1
    _, finished = solve("no-search", text.replace(tag, "<solver_devices>none</solver_devices>" + tag), ends=False)
    assert not finished.report.normal


# ------------------------------------------------------------ end-notched flexure

FLEXURE = Strips(cells=3, finer=2, length=32.0, crack=13.0, strength=0.7, opening=0.215, steps=30)


def flexure_by_theory(strips: Strips, deflection: np.ndarray) -> np.ndarray:
    """Load of a flexure whose crack runs, by the deflection of its middle, N; NaN once the crack is near the middle.

    G = 9 P^2 a^2/(16 b^2 E h^3), and the compliance (2 L^3 + 3 a^3)/(8 E b h^3) + 3 L/(5 E b h) of supports at a
    distance L from the middle.
    """
    half, e, b, h = 0.5 * strips.length, strips.modulus, strips.width, strips.thickness
    a = np.linspace(strips.crack, half - h, 2000)
    load = np.sqrt(16 * b**2 * e * h**3 * strips.energy / 9) / a
    compliance = (2 * half**3 + 3 * a**3) / (8 * e * b * h**3) + 0.6 * half / (e * b * h)
    return np.interp(deflection, load * compliance, load, right=np.nan)


@pytest.mark.slow
@pytest.mark.parametrize("strips", [FLEXURE, replace(FLEXURE, cells=4, finer=1)], ids=["six a mm", "four a mm"])
def test_a_flexure_bears_the_load_of_beam_theory(solve, strips):
    folder = solved(solve, f"flexure-{strips.cells}", end_notched_flexure(strips).text())
    assert "failed to converge" not in (folder / "model.log").read_text()
    nodes = np.array(two_strips(strips).nodes)
    middle = np.abs(nodes[:, [0, 2]] - (0.5 * strips.length, strips.thickness)).max(axis=1) < 1e-9
    load = np.abs(small.table(folder / "nodes.txt")[:, middle, 1].sum(axis=1))
    times = times_of(folder)
    deflection = strips.opening * np.interp(times, [0, WHOLE[0], 1], [0, WHOLE[1], 1])
    theory = flexure_by_theory(strips, deflection)
    runs = (small.table(folder / "surface-up-tied.txt")[:, 0, 5] > 0) & np.isfinite(theory)
    assert np.count_nonzero(runs) > 5
    assert np.abs(load[runs] / theory[runs] - 1).max() <= 0.03
    assert np.abs(unaccounted(folder, strips, load, deflection)).max() <= 1e-3


# ------------------------------------------------------------ peeling

STRIP = Strips(cells=2, length=30.0, crack=8.0, energy=5.0, strength=7.0, opening=24.0, steps=80)


@pytest.mark.slow
def test_a_strip_is_peeled_off_at_the_load_of_its_angle(solve):
    """G = F (1 - cos theta)/b + F^2/(2 b^2 h E), with the angle of the force."""
    angle = np.radians(60)
    folder = solved(solve, "peel", peeled(STRIP, angle).text())
    nodes = np.array(two_strips(STRIP).nodes)
    end = np.abs(nodes[:, [0, 2]] - (0.0, 0.5 * STRIP.thickness)).max(axis=1) < 1e-9
    force = small.table(folder / "nodes.txt")[:, end].sum(axis=1)
    times = times_of(folder)
    path = path_of_peeling(STRIP, angle)
    moved = np.column_stack([np.interp(times, path[:, 0], path[:, k]) for k in (1, 2)])
    force *= np.sign(force[-1] @ (moved[-1] - moved[-2]))
    runs = times > 0.5 * (1 + TURNED)
    size = np.linalg.norm(force[runs], axis=1)
    b, h = STRIP.width, STRIP.thickness
    released = size / b * (1 + force[runs, 0] / size) + size**2 / (2 * b**2 * h * STRIP.modulus)
    assert np.abs(released / STRIP.energy - 1).max() <= 0.03
    assert np.abs(unaccounted(folder, STRIP, force, moved)).max() <= 1e-3
