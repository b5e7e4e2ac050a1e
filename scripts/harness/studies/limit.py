"""The limit of processor time that the runs of all comparisons have, and how a run that it ended is told."""

from __future__ import annotations

LIMIT = 300.0
"""s of processor time for one run, the same for all interfaces in all studies."""


def at_limit(ended: bool, iterations: int) -> bool:
    """Whether the limit ended a run: febio4 then did not come to write how many iterations it took."""
    return not ended and iterations == 0
