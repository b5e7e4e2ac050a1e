"""The primary surface is a rigid plate of a single facet: it bears the load that it bears as the secondary one."""

from __future__ import annotations

import febio_runs
import numpy as np
import pytest

from harness.conversion import convert
from harness.run import engine, logdata
from studies.models.small import fixed
from studies.synthetic_scenes.reported.shapes import ball, box, mapped, shifted
from studies.synthetic_scenes.reported.sketch import Sketch, Touch
from studies.synthetic_scenes.reported.words import auto, hold, neo, rigid, shift

pytestmark = pytest.mark.mixture_only

TRAVEL = 0.12
"""Of the plate, mm."""
DTOL = 1e-3
"""FEBio's tolerance of displacements: the nodes of the ball have the same conditions with either side as primary."""


def _displacements(folder, primary: str, secondary: str):
    """Those of a soft ball under a plate that comes down, at the end, mm."""
    bodies = {
        "ball": mapped((6, 6, 5), shifted(ball(0.8, 1.0), (0, 0, -0.8))),
        "plate": mapped((1, 1, 1), box((-4, -4, 0.003), (4, 4, 0.2))),
    }
    conditions = (fixed("ball-z0"), hold("plate", "xyuvw"), shift("plate", "z", -TRAVEL))
    touch = Touch(primary, secondary, params=auto())
    sketch = Sketch(bodies, {"ball": neo(), "plate": rigid((0, 0, 0.1))}, (touch,), conditions)
    path = folder / f"{primary}.feb"
    path.write_text(sketch.text(), encoding="iso-8859-1")
    path.write_bytes(convert.convert(path).data)
    found = febio_runs.run(path, plugin=engine.required_plugin(), check=False)
    assert found.report.normal, found.report.errors
    assert found.report.retries == 0
    columns = ("ux", "uy", "uz")
    return logdata.read_history(path.parent / "nodes.txt", columns).values[-1, : len(bodies["ball"].nodes)]


@pytest.mark.parametrize("plate", ["plate-z0", "plate-outside"])
def test_a_plate_of_one_facet_bears_the_same_load_on_either_side(runner, tmp_path, plate):
    fine = _displacements(tmp_path, "ball-outside", plate)
    coarse = _displacements(tmp_path, plate, "ball-outside")
    assert np.abs(coarse - fine).max() < DTOL * np.abs(fine).max()
