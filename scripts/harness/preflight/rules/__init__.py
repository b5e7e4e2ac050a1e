"""The rules of `check`: each looks at one contact of a model and says what it finds."""

from collections.abc import Callable, Iterable

from harness.preflight.finding import Finding
from harness.preflight.rules import (
    ambient_values,
    distances,
    membranes,
    motion,
    penalties,
    settings,
    surfaces,
    transport,
)
from harness.preflight.sides import Joint

Rule = Callable[[Joint], Iterable[Finding]]

ON_TEXT: tuple[Rule, ...] = (*settings.RULES, *membranes.RULES)  # rules that read the file alone
ON_SURFACES: tuple[Rule, ...] = surfaces.RULES
"""Rules on the surfaces; the others are asked only where these find no error."""
ON_PHYSICS: tuple[Rule, ...] = (
    *distances.RULES,
    *penalties.RULES,
    *transport.RULES,
    *ambient_values.RULES,
    *motion.RULES,
)
"""Rules that need surfaces in order and numbers as values."""
