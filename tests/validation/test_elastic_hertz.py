"""A cylinder and a sphere on a block: pressure, half-width and radius are Hertz's."""

from __future__ import annotations

import numpy as np
import pytest

from studies import files
from studies.hertz import elastic_profiles
from studies.hertz.elastic_profiles import ProfileRow
from studies.hertz.page import ELASTIC_SOURCE
from studies.pages.evidence import DATA

BAR = 0.03
"""Of half-width or radius and of peak pressure, relative, on the fine mesh."""
NEWTON = 1e-4
"""Of the peak pressure: iterations end at 1e-6 of the displacement, and rounding differs between machines."""


def recorded(problem: str) -> list[list[ProfileRow]]:
    """Rows of the two meshes, coarse and fine, as the page has them."""
    rows = [row for row in files.read_csv(DATA / ELASTIC_SOURCE, ProfileRow) if row.problem == problem]
    return [[row for row in rows if row.mesh == mesh] for mesh in dict.fromkeys(row.mesh for row in rows)]


def test_a_line_through_the_closed_form_finds_it():
    """Points, in place of facets."""
    place = np.linspace(0.0, 1.2, 25)
    pressure = 3.0 * np.sqrt(np.maximum(0.0, 1.0 - place**2))
    rows = [ProfileRow("sphere", "", float(r), float(p), 1.0, 3.0) for r, p in zip(place, pressure, strict=True)]
    assert elastic_profiles.errors(rows) == pytest.approx((0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("problem", elastic_profiles.PROBLEMS)
def test_pressure_is_that_of_the_closed_form(problem):
    """On the fine mesh, and the radius is nearer to it than on the coarse one."""
    coarse, fine = map(elastic_profiles.errors, recorded(problem))
    assert np.abs(fine).max() <= BAR
    assert abs(fine[0]) < abs(coarse[0])


@pytest.mark.mixture_only
@pytest.mark.slow
@pytest.mark.parametrize("problem", elastic_profiles.PROBLEMS)
def test_the_profile_of_the_page_is_what_the_code_gives(runner, problem):
    """On the coarse mesh, to Newton's tolerance. Where this fails on purpose: `elastic-hertz --folder docs`."""
    make, (coarse, _) = elastic_profiles.PROBLEMS[problem]
    now, written = make(runner, coarse), recorded(problem)[0]
    peak = written[0].peak
    np.testing.assert_allclose(
        [row.pressure / peak for row in now], [row.pressure / peak for row in written], atol=NEWTON
    )
