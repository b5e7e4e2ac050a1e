"""Solute in a knee: what appears where nothing feeds it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from harness.models.knee.whole_mesh import BATH
from harness.models.parts import Mixture
from harness.post import solute_balance
from harness.run.runner import RunResult


def appeared(result: RunResult) -> float:
    """Solute that entered at nodes which nothing feeds, over the whole run, relative to the content at the end.

    Contact surfaces and synovial fluid feed the nodes on them.
    """
    model = result.model
    history = result.nodes
    states = solute_balance.states(history)
    parts = [part for part in model.mesh.parts if isinstance(model.materials[part.material], Mixture)]
    balanced = np.ones(len(model.mesh.nodes), dtype=bool)
    for fed in (model.mesh.node_sets[BATH], *(model.mesh.surfaces[name] for name in model.contact_surfaces)):
        balanced[np.ravel(fed) - 1] = False
    total = 0.0
    for (before, after), step in zip(pairwise(states), np.diff(history.times), strict=True):
        inflow = sum(solute_balance.inflow(model, part, before, after, float(step)) for part in parts)
        total += float(np.sum(np.asarray(inflow)[balanced]))
    return abs(total) / sum(solute_balance.content(model, part, states[-1]) for part in parts)
