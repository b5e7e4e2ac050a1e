"""Problem 3.3 to the end, with default settings: first touch, a moving edge of contact, fronts thinner than an element.

The iteration counts are exact and repeatable; the bars leave a tenth of room for another version of a linear solver.
"""

from __future__ import annotations

import numpy as np
import pytest

from harness.indentation_results import curves
from harness.models.indentation import END, Indentation
from harness.models.indentation_mesh import Primary

MEASURED = {
    ("multiphasic", False, Primary.CYLINDER): 314,
    ("multiphasic", False, Primary.SLAB): 305,
    ("solute", True, Primary.CYLINDER): 355,
    ("solute", True, Primary.SLAB): 362,
}
"""Newton iterations of 95 time steps: module, clamp of negative concentrations, primary surface."""


@pytest.mark.parametrize(("module", "clamp", "primary"), list(MEASURED))
def test_it_runs_to_the_end_without_a_retry(runner, module, clamp, primary):
    name = f"indentation-{module}-{primary.name.lower()}"
    outcome = runner(Indentation(module=module, clamp=clamp, primary=primary, name=name).model())
    assert outcome.report.normal
    assert outcome.nodes.times[-1] == pytest.approx(END)
    assert outcome.report.retries == 0
    assert outcome.report.iterations <= 1.1 * MEASURED[module, clamp, primary]
    if not clamp:  # the solver's clamp creates solute
        assert np.max(np.abs(curves(outcome).imbalance)) <= 1e-6
