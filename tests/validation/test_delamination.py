"""A double cantilever beam that comes apart: its load by beam theory, its energies, coarse zones with viscosity."""

from __future__ import annotations

import numpy as np
import pytest
from scenes.delamination import Strips, double_cantilever_beam, with_energy

from studies.models import small

pytestmark = pytest.mark.mixture_only


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
    """Openings, loads by theory's sign, and the part of the work that no energy accounts for, where the crack runs."""
    folder, _ = solve(name, with_energy(double_cantilever_beam(strips).text()))
    assert "failed to converge" not in (folder / "model.log").read_text()
    rows = small.table(folder / "surface-up-tied.txt")[:, 0]
    opening = strips.opening * np.linspace(0, 1, len(rows))
    load = -rows[:, 2]
    work = np.concatenate([[0], np.cumsum(0.5 * (load[1:] + load[:-1]) * np.diff(opening))])
    element = (strips.thickness / strips.cells) ** 3
    stored = small.table(folder / "sed.txt")[..., 0].sum(axis=1) * element
    lost = (work - stored - rows[:, [3, 4, 6]].sum(axis=1)) / work[-1]
    runs = rows[:, 5] > 0
    return opening[runs], load[runs], lost


def test_the_load_is_that_of_beam_theory_on_two_meshes(solve):
    errors = []
    for cells in (4, 6):
        strips = Strips(cells=cells)
        opening, load, _ = drawn_apart(solve, f"dcb-{cells}", strips)
        assert len(opening) > 10
        errors.append(np.abs(load / load_by_theory(strips, opening) - 1).max())
    assert errors[0] <= 0.03
    assert errors[1] < errors[0]


def test_the_work_is_what_is_stored_and_dissipated(solve):
    *_, lost = drawn_apart(solve, "work", Strips())
    assert np.abs(lost).max() <= 1e-3


def test_viscosity_leads_a_zone_that_is_too_short_to_the_end(solve):
    """Bonds so strong that the zone in which they soften spans three facets: without viscosity, steps fail."""
    found = {}
    for viscosity in (0.02, 0.01):
        strips = Strips(strength=1.0, more=f"<viscosity>{viscosity}</viscosity>")
        opening, load, _ = drawn_apart(solve, f"viscous-{viscosity}", strips)
        found[viscosity] = np.mean(load / load_by_theory(strips, opening))
    assert 1 < found[0.01] < found[0.02]
