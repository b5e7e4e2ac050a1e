"""Random scenes: a seed stands for one model, and what is drawn stands in its file."""

from __future__ import annotations

import pytest
from lxml import etree

from harness.conversion import convert
from studies.stamps import LIMIT
from studies.synthetic_scenes import comparison
from studies.synthetic_scenes.varied_scenes import SCENES, Varied


@pytest.mark.parametrize("seed", range(4))
def test_a_seed_stands_for_one_model_that_converts(seed, tmp_path):
    one, other = (Varied(seed).write("scene", tmp_path / folder) for folder in ("one", "other"))
    assert one.read_bytes() == other.read_bytes()
    assert convert.convert(one).data != one.read_bytes()


def test_parameters_that_are_drawn_stand_once(tmp_path):
    for seed in range(4):
        for contact in etree.parse(SCENES[f"seed-{seed:03d}"].write("scene", tmp_path)).iterfind("Contact/contact"):
            tags = [child.tag for child in contact]
            assert len(tags) == len(set(tags))


def test_seeds_differ():
    assert len({Varied(seed).about for seed in range(8)}) > 4


@pytest.mark.usefixtures("runner")
def test_corrections_of_a_matrix_that_do_not_help_end(tmp_path):
    """A porous body between rigid plates, BFGS: each correction undoes what the iteration before it has done."""
    row = comparison.compare("seed-082", SCENES["seed-082"], tmp_path, LIMIT, ("converted",))
    assert row.converted.ended, row.converted.why
    assert row.converted.retries == row.febio.retries == 0
    assert row.converted.iterations <= row.febio.iterations
