"""A few seeds of the fuzzers, and all at which a fault was found; `mixcontact fuzz` runs as many as one likes."""

from __future__ import annotations

import pytest

from harness.fuzz.draws import Kind, draw
from harness.fuzz.trial import attempt

FOUND: dict[Kind, tuple[int, ...]] = {Kind.SCENES: (), Kind.PARAMETERS: (72, 141, 283, 288, 365, 380, 398)}
"""Of `PARAMETERS`: a flip turned a sound surface round, and the message named the element alone."""


@pytest.mark.parametrize("kind", Kind)
def test_a_seed_is_one_model(kind):
    assert draw(kind, 3).text() == draw(kind, 3).text()
    assert draw(kind, 3).text() != draw(kind, 4).text()


@pytest.mark.parametrize(
    ("kind", "seed"), [(kind, seed) for kind in Kind for seed in dict.fromkeys((*range(8), *FOUND[kind]))]
)
def test_no_fault(runner, kind, seed):
    trial = attempt(kind, seed, runner)
    assert not trial.faulty, trial.outcome
