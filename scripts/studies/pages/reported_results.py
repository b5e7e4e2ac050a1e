"""The page of the scenes drawn from what users report, from their results alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from studies import tables
from studies.pages import scene_results
from studies.pages.scene_results import MOST, Results, Row, Took
from studies.pages.texts import page_text

PAGE, ALL = "evidence/reported-scenes.md", "reference/reported-scenes.md"
DATA = Path("data", "reported-scenes.json")
"""Below docs/."""
WAYS = {"converted": "converted", "defaults": "penalties deleted"}
"""Runs of ours that each scene has, as the table calls them."""
TITLES = {"converted": "Converted models", "defaults": "Without their penalties, they"}
"""The same runs, as a sentence calls them."""
IN = 0.9
"""Part of the scenes in which ours is to take at most FEBio's iterations."""

HEAD = page_text("reported-scenes")
ALL_HEAD = page_text("reported-scenes-all")


def page(results: Results) -> str:
    """The page."""
    rows = results.rows
    worse = [row for row in rows if any(row.worse(took) for took in _ours(row))]
    return HEAD.format(
        stamp=results.stamp,
        summary=summary(rows),
        details=details(rows),
        most=MOST,
        worse=_short(worse) if worse else "In no scene.",
    )


def all_scenes(results: Results) -> str:
    """The page with a row for each scene."""
    return ALL_HEAD.format(stamp=results.stamp, table=table(results.rows))


def _short(rows: Sequence[Row]) -> str:
    """A table of names and counts alone."""
    cells = ([row.name, *(_brief(took) for took in (row.febio, *_ours(row)))] for row in rows)
    return tables.markdown(["scene", "FEBio", *WAYS.values()], cells)


def _brief(took: Took) -> str:
    return scene_results.cell(took) if took.ended else "fails"


def _ours(row: Row) -> list[Took]:
    return [getattr(row, way) for way in WAYS]


def summary(rows: Sequence[Row]) -> str:
    """How many scenes each way completes."""
    sound = [row for row in rows if row.febio.ended]
    counts = [f"{TITLES[way]} complete {sum(getattr(row, way).ended for row in sound)} of these." for way in WAYS]
    parts = [f"FEBio's interface completes {len(sound)} of {len(rows)} scenes.", *counts]
    beyond = [row for row in rows if not row.febio.ended]
    if beyond:
        ended = sum(row.converted.ended for row in beyond)
        parts.append(f"Converted models complete {ended} of the {len(beyond)} that FEBio's interface does not.")
    return " ".join(parts)


def details(rows: Sequence[Row]) -> str:
    """In how many scenes that both complete ours takes no more iterations than FEBio's, and in how many more."""
    return " ".join(_details(way, [row for row in rows if row.febio.ended and getattr(row, way).ended]) for way in WAYS)


def _details(way: str, both: Sequence[Row]) -> str:
    ratios = sorted(getattr(row, way).iterations / row.febio.iterations for row in both)
    more = sum(getattr(row, way).retries > row.febio.retries for row in both)
    most = f" and at most {ratios[-1]:.2f} times as many" if ratios else ""
    return (
        f"{TITLES[way]} take at most FEBio's iterations in {sum(ratio <= 1.0 for ratio in ratios)} scenes{most}; "
        f"{sum(ratio > MOST for ratio in ratios)} take more than {MOST} times, {more} have more retries."
    )


def table(rows: Sequence[Row]) -> str:
    """A Markdown table, a row for each scene."""
    cells = (
        [row.name, row.about, *map(scene_results.cell, (row.febio, *_ours(row))), scene_results.worse(row, WAYS)]
        for row in rows
    )
    return tables.markdown(["scene", "", "FEBio", *WAYS.values(), "worse in"], cells)
