"""The page of the scenes drawn from what users report, from their results alone."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from studies import tables
from studies.pages import scene_results
from studies.pages.scene_results import MOST, Results, Row, Took

PAGE, ALL = "evidence/reported-scenes.md", "reference/reported-scenes.md"
DATA = Path("data", "reported-scenes.json")
"""Below docs/."""
WAYS = {"converted": "converted", "defaults": "penalties deleted"}
"""Runs of ours that each scene has, as the table calls them."""
TITLES = {"converted": "Converted models", "defaults": "Without their penalties, they"}
"""The same runs, as a sentence calls them."""
IN = 0.9
"""Part of the scenes in which ours is to take at most FEBio's iterations."""

HEAD = """\
# Reported kinds

<!-- Written by `scripts/mixcontact pages`: change scripts/studies/pages/reported_results.py instead. -->

**{summary}**

{details}

This second collection of synthetic test scenes was written here after kinds of model that users report:

- thin shells and strips on rigid bodies, rods in tubes, whole outsides as surfaces, leaning and turned sides;
- sheets that fold onto themselves, crossed tubes, incongruent cylinders, hyperelastic blocks that slide;
- soft bodies between rigid plates, rigid cams, punches and wheels, nearly incompressible bodies, impacts;
- elements that erode, steps without drainage.

They have one pass or two, augmentations on small penalties, friction and quasi-Newton methods, in tetrahedra,
hexahedra, wedges and shells. Scenes are small, and many differ in one choice alone. They were chosen so that FEBio's
interface completes them, before `sliding-mixture` was run.

Each scene runs with FEBio's interface, through `scripts/mixcontact convert` with the same penalties, and with the
penalties deleted. The limit is the same for all. This command runs the scenes of one name, or without `--only` all:

```console
scripts/mixcontact synthetic-scenes --collection reported --only crossed-tubes
```

[All scenes](../reference/reported-scenes.md) have a row each, with Newton iterations, and retries of time steps in
brackets. These scenes are worse than with FEBio's interface: the run fails, has more retries, or takes more than {most}
times the iterations. Made with {stamp}.

{worse}
"""
ALL_HEAD = """\
# Reported kinds: all scenes

<!-- Written by `scripts/mixcontact pages`: change scripts/studies/pages/reported_results.py instead. -->

The table gives Newton iterations for the [reported kinds](../evidence/reported-scenes.md), with retries in brackets.
Made with {stamp}.

{table}
"""


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
