"""The page of the scenes drawn from what users report, from their results alone."""

from collections.abc import Sequence
from pathlib import Path

from studies import tables
from studies.pages import scene_results
from studies.pages.scene_results import MOST, Results, Row, Took
from studies.pages.texts import page_text

PAGE, ALL = "evidence/reported-scenes.md", "reference/reported-scenes.md"
DATA = Path("data", "reported-scenes.json")  # below docs/
WAYS = {"converted": "converted", "defaults": "penalties deleted"}
"""Runs of ours that each scene has, as the table calls them."""

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
    return ALL_HEAD.format(stamp=results.stamp, most=MOST, table=table(results.rows))


def compared(rows: Sequence[Row]) -> str:
    """The summary with its details."""
    return f"{summary(rows)}\n\n{details(rows)}"


def _short(rows: Sequence[Row]) -> str:
    """A table of names and counts alone."""
    cells = (
        [row.name, *(scene_results.cell(took) if took.ended else "fails" for took in (row.febio, *_ours(row)))]
        for row in rows
    )
    return tables.markdown(["scene", "FEBio", *WAYS.values()], cells)


def _ours(row: Row) -> list[Took]:
    return [getattr(row, way) for way in WAYS]


def summary(rows: Sequence[Row]) -> str:
    """How many scenes each interface completes."""
    ours = [row for row in rows if row.converted.ended]
    shared = sum(row.febio.ended for row in ours)
    return (
        f"FEBio's interface completes {sum(row.febio.ended for row in rows)} of {len(rows)} scenes. Converted models "
        f"complete {shared} of these and {len(ours) - shared} others."
    )


def details(rows: Sequence[Row]) -> str:
    """A table with a row for each way: runs that complete, iterations over FEBio's, and more retries."""
    sound = sum(row.febio.ended for row in rows)
    heads = ("model", f"completes of FEBio's {sound}", "of the other scenes", "iterations at most FEBio's")
    more = ("largest ratio of iterations", f"ratio above {MOST}", "more retries")
    return tables.markdown((*heads, *more), (_details(way, rows) for way in WAYS))


def _details(way: str, rows: Sequence[Row]) -> tuple[str | int, ...]:
    ended = [row for row in rows if getattr(row, way).ended]
    both = [row for row in ended if row.febio.ended]
    ratios = [getattr(row, way).iterations / row.febio.iterations for row in both]
    more = sum(getattr(row, way).retries > row.febio.retries for row in both)
    few, many = sum(ratio <= 1.0 for ratio in ratios), sum(ratio > MOST for ratio in ratios)
    return (WAYS[way], len(both), len(ended) - len(both), few, f"{max(ratios, default=0.0):.2f}", many, more)


def table(rows: Sequence[Row]) -> str:
    """A Markdown table, a row for each scene."""
    cells = (
        [row.name, row.about, *map(scene_results.cell, (row.febio, *_ours(row))), scene_results.worse(row, WAYS)]
        for row in rows
    )
    return tables.markdown(["scene", "description", "FEBio", *WAYS.values(), "worse in"], cells)
