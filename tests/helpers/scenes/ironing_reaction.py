"""Reaction of a run of `scenes.ironing`, and how much it ripples from facet to facet."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness.run.runner import RunResult
from scenes.ironing import PRESSING, STEPS_A_FACET

Array = NDArray[np.float64]


def reaction(result: RunResult) -> Array:
    """Force on the indenter's top while it slides, N: along x and y, shape (n_times, 2)."""
    top = result.model.mesh.node_sets["top"] - 1
    nodes = result.nodes
    sliding = nodes.times > PRESSING + 1e-9
    return np.stack([nodes[name][sliding][:, top].sum(axis=1) for name in ("Rx", "Ry")], axis=1)


def ripple(result: RunResult) -> float:
    """Difference of largest and smallest normal reaction over its mean, over the middle of the way."""
    force = reaction(result)[STEPS_A_FACET:-STEPS_A_FACET, 1]
    return float((force.max() - force.min()) / abs(force.mean()))
