"""How far the node data of two runs are apart."""

import numpy as np
from numpy.typing import NDArray

from harness.run.logdata import History

FLOOR = 1e-6  # of a column whose values are smaller all along, in the units of the model: they are what rounding left
SAME_TIME = 1e-7  # relative to the end; FEBio writes nine digits, and takes two times that differ by less for one
VECTOR = ("ux", "uy", "uz")


def largest(run: History, other: History) -> float:
    """Largest difference at the times of `run`, relative to the largest value of a column, of all three of a vector.

    Infinite where `other` lacks one of these times, or where there is none.
    """
    places = [_place(other, time) for time in run.times.tolist()]
    if not places or None in places:
        return float("inf")
    facing = other.values[[place for place in places if place is not None]]
    if facing.shape != run.values.shape:
        return float("inf")
    gaps = np.abs(run.values - facing).max(axis=(0, 1)) / _scale(other)
    return float("inf") if np.isnan(gaps).any() else float(gaps.max())


def _place(history: History, time: float) -> int | None:
    place = int(np.argmin(np.abs(history.times - time)))
    near = abs(float(history.times[place]) - time) <= SAME_TIME * float(history.times[-1])
    return place if near else None


def _scale(history: History) -> NDArray[np.float64]:
    scale = np.maximum(np.abs(history.values).max(axis=(0, 1)), FLOOR)
    vector = [history.columns.index(name) for name in VECTOR]
    scale[vector] = scale[vector].max()
    return np.asarray(scale)
