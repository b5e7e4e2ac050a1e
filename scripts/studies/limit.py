"""The limit of processor time that the runs of all comparisons have, and whether it ended a run."""

from __future__ import annotations

LIMIT = 300.0
"""s of processor time for one run, the same for all interfaces in all studies."""
NEARLY = 0.9
"""Part of the limit from which on a run that did not end normally is taken to have been ended by it: the system ends
one within a few hundredths of it, and what fails by itself seldom does so just then."""


def at_limit(ended: bool, cpu: float, limit: float | None = LIMIT) -> bool:
    """Whether the limit (s) ended a run that took so much processor time (s).

    That febio4 wrote no summary says nothing: it writes none either where it stops at an error or crashes.
    """
    return not ended and limit is not None and cpu >= NEARLY * limit
