"""The table of all models without and with the predictor."""

from __future__ import annotations

from collections.abc import Sequence

from studies import tables
from studies.predictor.paired_models import Pair, Took


def table(pairs: Sequence[Pair]) -> str:
    """A Markdown table, a row for each model: iterations, and steps tried again in brackets where there are any."""
    return tables.markdown(("model", "without", "with `predictor` 1", "ratio", "worse in"), map(_row, pairs))


def _row(pair: Pair) -> tuple[str, ...]:
    return pair.name, _cell(pair.without), _cell(pair.predicted), f"{pair.ratio:.2f}", pair.harms


def _cell(took: Took) -> str:
    retries = f" ({took.retries})" if took.retries else ""
    why = "limit" if took.limited else "fails"
    return f"{took.iterations}{retries}" if took.ended else f"{why} after {took.steps} steps{retries}"


def summary(pairs: Sequence[Pair]) -> str:
    """Sums over the models that end both ways, and how many speak against the predictor as the default."""
    ended = [pair for pair in pairs if pair.both_end]
    without = sum(pair.without.iterations for pair in ended)
    predicted = sum(pair.predicted.iterations for pair in ended)
    harmed = [pair for pair in pairs if pair.harms]
    return (
        f"{len(ended)} of {len(pairs)} models complete with and without the predictor. They take {predicted} "
        f"iterations with the predictor and {without} without. It harms {len(harmed) or 'none'} of the models."
    )
