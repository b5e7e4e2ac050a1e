"""Random bodies: a seed stands for one model, whose blocks touch with the gap that was drawn."""

import numpy as np
import pytest

from harness.conversion import convert
from studies.synthetic_scenes.random_bodies import GRID, RELIEFS, SCENES, Block


@pytest.mark.parametrize("seed", range(20))
def test_a_seed_stands_for_one_model_that_converts(seed, tmp_path):
    scene = SCENES[f"seed-{seed:03d}"]
    first = scene.write("first", tmp_path)
    again = scene.write("again", tmp_path)
    assert first.read_bytes() == again.read_bytes()
    assert convert.convert(first).data != first.read_bytes()


@pytest.mark.parametrize("low", RELIEFS)
@pytest.mark.parametrize("high", RELIEFS)
def test_blocks_touch(low, high):
    below = Block(2.0, 1.0, 0.8, low, 0.1, is_below=True)
    above = Block(1.5, 1.2, 0.6, high, 0.1, is_below=False).on(below, 0.02)
    points = 0.5 * GRID * (1.5, 1.0)
    gaps = above.face(points) - below.face(points)
    assert gaps.min() == pytest.approx(0.02)
    assert np.all(below.face(points) <= 1e-12)
