"""The page of the real models, from their results alone."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.run.provenance import Stamp

PAGE = "evidence/real-models.md"
DATA = Path("data", "real-models.json")
"""Below docs/."""

HEAD = """\
# Real models

<!-- Written by `scripts/mixcontact pages`: change scripts/harness/pages/scene_results.py instead. -->

Scenes of the breadth that users have: element types, materials, loads, rigid bodies, porous bodies with and
without solutes, each with the FEBio interface that a user would take and the parameters that a user would
give it. Each is run three times: with FEBio's interface; through `scripts/mixcontact convert`, with the same
penalties; and with the penalties deleted, so that the plugin chooses them.

```console
scripts/mixcontact real-models --only elements-hex8
```

runs one of them; without `--only` all of them. {stamp}

{summary}

The numbers are Newton iterations, with retries of time steps in brackets. *Differs by*: the largest
difference of the last state between FEBio's interface and the converted model, relative to the largest value
of each kind. FEBio's interfaces act at Gauss points, and the penalties of the scenes (a factor of 10) leave
overlaps of a few hundredths of an element, which differ between the two; small components of displacements,
such as those across a cylinder, show it most. The predictor is off.

{table}
"""


MOST = 1.2
"""Iterations over FEBio's, at most, in any scene."""


@dataclass(frozen=True)
class Took:
    """What a run took.

    Attributes
    ----------
    ended : bool
    steps, iterations, retries : int
    difference : float
        Largest difference of the last state from that of FEBio's interface, of all logged values relative to the
        largest of their kind; 0 for FEBio's interface itself, not a number where a run did not end.
    why : str
        Why there is no run, or why it failed.
    """

    ended: bool
    steps: int = 0
    iterations: int = 0
    retries: int = 0
    difference: float = math.nan
    why: str = ""


@dataclass(frozen=True)
class Row:
    """A scene and its three runs."""

    name: str
    about: str
    febio: Took
    converted: Took
    defaults: Took

    def worse(self, ours: Took) -> str:
        """In what a run of ours is worse than FEBio's; empty where in nothing."""
        if not self.febio.ended:
            return ""
        if not ours.ended:
            return ours.why or "does not end"
        found = ["more retries"] if ours.retries > self.febio.retries else []
        if ours.iterations > MOST * self.febio.iterations:
            found.append("more iterations")
        return ", ".join(found)


@dataclass(frozen=True)
class Results:
    """What the command found, with what, and with which limit of wall time (s)."""

    stamp: Stamp
    wall_limit: float
    rows: list[Row]


def write(results: Results, path: Path) -> None:
    """Write results as JSON."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(asdict(results), indent=1) + "\n")


def read(path: Path) -> Results:
    """Read what `write` wrote.

    Raises
    ------
    DataFileError
        A missing file, or one that holds no such results.
    """
    try:
        data = json.loads(path.read_text())
        rows = [_row(**row) for row in data["rows"]]
        return Results(Stamp(**data["stamp"]), data["wall_limit"], rows)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(f"{path} holds no results ({error}); `real-models --docs` writes it") from error


def _row(name: str, about: str, **runs: dict[str, bool | int | float | str]) -> Row:
    return Row(name, about, **{run: Took(**took) for run, took in runs.items()})  # type: ignore[arg-type]


def page(results: Results) -> str:
    """The page of the documentation."""
    stamp = f"Made with {results.stamp}, and a limit of {results.wall_limit:g} s of wall time for each run."
    return HEAD.format(stamp=stamp, summary=summary(results.rows), table=table(results.rows))


def table(rows: Sequence[Row]) -> str:
    """A Markdown table, a row for each scene: iterations, and retries in brackets where there are any."""
    lines = ["| scene | | FEBio | converted | differs by | defaults | worse in |", "|---|---|---|---|---|---|---|"]
    for row in rows:
        worse = "; ".join(
            f"{name}: {what}"
            for name, what in (("converted", row.worse(row.converted)), ("defaults", row.worse(row.defaults)))
            if what
        )
        cells = (
            row.name,
            row.about,
            _cell(row.febio),
            _cell(row.converted),
            f"{row.converted.difference:.1e}",
            _cell(row.defaults),
            worse.replace("|", "/"),
        )
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _cell(took: Took) -> str:
    retries = f" ({took.retries})" if took.retries else ""
    return f"{took.iterations}{retries}" if took.ended else f"fails after {took.steps} steps{retries}"


def summary(rows: Sequence[Row]) -> str:
    """How many scenes end, and how many are no worse than FEBio's."""
    sound = [row for row in rows if row.febio.ended]
    parts = [f"{len(rows)} scenes; FEBio's interface ends {len(sound)} of them."]
    for name, of in (("Converted", "converted"), ("With the penalties deleted", "defaults")):
        runs: list[tuple[Row, Took]] = [(row, getattr(row, of)) for row in sound]
        ended = sum(run.ended for _, run in runs)
        fewer = sum(run.ended and run.iterations <= row.febio.iterations for row, run in runs)
        harmed = sum(bool(row.worse(run)) for row, run in runs)
        parts.append(
            f"{name}, {ended} of these end, {fewer} in at most FEBio's iterations; {harmed} are worse: they fail, or "
            f"take more retries, or more than {MOST} times the iterations."
        )
    return " ".join(parts)
