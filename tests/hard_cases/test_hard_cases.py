"""The hard cases on the coarse mesh with sliding-mixture; `mixcontact hard-cases` runs all meshes and interfaces."""

from __future__ import annotations

import pytest

from harness.compare import missed
from harness.hard_cases import record, variants
from harness.hard_cases.catalogue import CASES
from harness.hard_cases.scene import Fineness, Interface

SWAPPED = "sides swapped, relative difference of forces and concentrations"
LISTED = {"corner-on-face": (SWAPPED,), "curved-1-to-8": (SWAPPED,)}
"""Measures that a case is known to miss; docs/hard-cases.md gives the causes."""
RETRIES = {"cutback-at-touch": 1}
"""Retries of a case: this one is forced."""


TOUCH = ("touch-gap-element", Fineness.FINE)
"""A step that ends with a gap of zero to rounding: the only one on the fine mesh."""


@pytest.mark.parametrize(("name", "mesh"), [*((name, Fineness.COARSE) for name in CASES), TOUCH])
def test_it_ends_and_passes(runner, name, mesh):
    made = record.make(runner, name, mesh, Interface.MIXTURE)
    assert made.ended, made.failures
    assert made.retries == RETRIES.get(name, 0)
    known = LISTED.get(name, ())
    assert missed(m for m in made.measures if m.name not in known) == []
    assert sorted(m.name for m in made.missed) == sorted(known), "a listed failure is cured: take it off the list"


@pytest.mark.parametrize("name", ["corner-on-face", "curved-1-to-8"])
def test_a_feature_that_primary_facets_miss_is_warned_of(runner, name):
    swapped = variants.swapped(CASES[name].scene.model(Fineness.COARSE, Interface.MIXTURE))
    missed_by, surface = swapped.mesh.pairs["pair"]
    (said,) = [text for text in runner(swapped).report.warnings if "without any load" in text]
    assert f'"{missed_by}"' in said
    assert f'"{surface}"' in said
    assert "two_pass" in said


@pytest.mark.parametrize("name", ["curved-1-to-8", "slide-off-edge", "curved-two-pass"])
def test_where_it_is_noticed_nothing_is_said(runner, name):
    run = runner(CASES[name].scene.model(Fineness.COARSE, Interface.MIXTURE))
    assert not [text for text in run.report.warnings if "without any load" in text]
