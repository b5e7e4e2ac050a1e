"""A soft penalty needs a deeper overlap than `search_radius`: contact that bears load stays, also after a restart."""

from __future__ import annotations

import febio_runs
import numpy as np
import pytest

from harness.run import engine, logdata
from studies.models.small import Scheme, fixed, moved
from studies.synthetic_scenes.reported.shapes import box, mapped
from studies.synthetic_scenes.reported.sketch import Sketch, Touch
from studies.synthetic_scenes.reported.words import given, neo, radius

pytestmark = pytest.mark.mixture_only

BODIES = {
    "slab": mapped((6, 6, 2), box((-1, -1, -1), (1, 1, 0))),
    "block": mapped((4, 4, 2), box((-0.7, -0.7, 0.0), (0.7, 0.7, 0.8))),
}
RADIUS = 0.05
"""mm."""
COLUMNS = ("ux", "uy", "uz")
SAME = 1e-10
"""A continued run agrees with the whole one to this part of the largest displacement, as in `test_continuation`."""


def _written(folder, name: str, params: str):
    conditions = (fixed("slab-z0"), fixed("block-z1", "x", "y"), moved("block-z1", "z", -0.4))
    touch = Touch("block-z0", "slab-z1", "sliding-mixture", given(1.0, params))
    path = folder / f"{name}.feb"
    path.write_text(Sketch(BODIES, {"slab": neo(), "block": neo()}, (touch,), conditions, Scheme(20, 0.05)).text())
    return path


def _displacements(folder):
    return logdata.read_history(folder / "nodes.txt", COLUMNS).values[-1]


def _run(path, *options: str):
    found = febio_runs.run(path, plugin=engine.required_plugin(), check=False, options=options)
    assert found.report.normal, found.report.errors
    return _displacements(path.parent)


@pytest.mark.parametrize("further", ["", "<integration>gauss</integration>", "<two_pass>1</two_pass>"])
def test_contact_with_a_deeper_overlap_than_the_radius_stays(runner, tmp_path, further):
    unlimited = _run(_written(tmp_path, "unlimited", further))
    limited = _run(_written(tmp_path, "limited", radius(RADIUS) + further))
    slab, block = np.split(unlimited[:, 2], [len(BODIES["slab"].nodes)])
    assert slab.min() - block.min() > RADIUS  # the overlap of the model is deeper than its radius
    np.testing.assert_array_equal(limited, unlimited)


def test_a_continued_run_keeps_the_contact(runner, tmp_path):
    path = _written(tmp_path, "model", radius(RADIUS))
    path.write_text(path.read_text().replace("PLOT_NEVER", "PLOT_MAJOR_ITRS"))  # FEBio needs a plot file to continue
    whole = _run(path, "-dump=1", "-dump_stride=15")
    (tmp_path / "nodes.txt").unlink()
    febio_runs.restart(path.with_suffix(".dmp"), plugin=engine.required_plugin())
    assert np.abs(_displacements(tmp_path) - whole).max() < SAME * np.abs(whole).max()
