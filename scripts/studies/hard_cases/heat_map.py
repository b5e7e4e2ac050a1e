"""The hard cases as a picture: scenes in groups by interface, each cell saying how its run ended; failures first."""

import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from studies import files
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.outcomes import End, Outcome, arranged

LOOKS = {
    End.PASSES: ("#eef2f7", "black"),
    End.MISSES: ("#b3c6dd", "black"),
    End.FAILS: ("#4f74a3", "white"),
    End.LIMIT: ("#1d2f49", "white"),
}
"""Colour of a cell, from light to dark also in grey, and of the text in it."""
COLUMNS = {
    "sliding-mixture": "sliding-\nmixture",
    "febio-1000": "FEBio,\nfactor 1000",
    "febio-1": "FEBio,\nfactor 1",
}
GROUPS = {
    "edges, corners, large motion": (
        "edge-on-face",
        "corner-on-face",
        "corner-two-pass",
        "slide-off-edge",
        "slide-20-facets",
        "rotation-90",
    ),
    "touching and parting": (
        "touch-gap-element",
        "touch-gap-1e-12",
        "overlap-tenth",
        "ten-cycles",
        "lost-and-regained",
        "dropped",
        "cutback-at-touch",
        "three-bodies",
        "one-closes-one-opens",
    ),
    "meshes": ("curved-1-to-8", "curved-two-pass", "warped-quads", "slivers"),
    "materials and transport": (
        "stiffness-1e6",
        "permeability-1e8",
        "diffusivity-1e6",
        "solubility-1e3",
        "incompressible",
        "peclet-1e2",
        "peclet-1e4",
        "no-solute",
        "trace-solute",
    ),
    "penalties, steps, units, restart": (
        "penalty-1e-3",
        "penalty-augmented",
        "penalty-1e3",
        "penalty-1e6",
        "ten-decades",
        "1000-steps",
        "units",
        "restart",
    ),
}
"""Cases by their kind."""
SEVERITY = {End.PASSES: 0, End.MISSES: 1, End.FAILS: 10, End.LIMIT: 10}  # how much an end counts in the order of rows
ROW, LABEL, CELL = 0.44, 3.02, 0.86  # height of a row, width of the labels and of a cell, inches
LETTERS = 38  # in a line of a label
Row = Mapping[str, Outcome]


def draw(outcomes: Sequence[Outcome], path: Path) -> Path:
    """Draw how runs ended: a row for each case and mesh under the name of its group, a column for each interface."""
    groups = ordered(arranged(outcomes))
    lines = sum(1 + len(rows) for rows in groups.values())
    width, height = LABEL + CELL * len(COLUMNS), ROW * (lines + 4)
    figure = Figure(figsize=(width, height), facecolor="white")
    axes = figure.add_axes((0.0, 2 * ROW / height, 1.0, ROW * (lines + 2) / height))
    axes.set(xlim=(-LABEL / CELL, len(COLUMNS)), ylim=(lines, -2))
    axes.set_axis_off()
    for column, text in enumerate(COLUMNS.values()):
        axes.text(column + 0.5, -0.9, text, ha="center", va="center", fontsize=10)
    place = 0
    for title, rows in groups.items():
        axes.text(-LABEL / CELL + 0.05, place + 0.6, title, va="center", fontsize=12, weight="bold")
        place += 1
        for label, row in rows.items():
            _line(axes, place, label, row)
            place += 1
    handles = [Patch(facecolor=colour, edgecolor="black", label=end.value) for end, (colour, _) in LOOKS.items()]
    figure.legend(handles=handles, loc="lower center", ncols=2, fontsize=10, frameon=False, handlelength=1.2)
    return files.save_figure(figure, path)


def ordered(rows: Mapping[tuple[str, str], Row]) -> dict[str, dict[str, Row]]:
    """Rows by group and label, those with failures first, and groups in the order of their first rows."""
    several = len({mesh for _, mesh in rows}) > 1
    found: dict[str, dict[str, Row]] = {}
    for (case, mesh), row in sorted(
        rows.items(), key=lambda item: -sum(SEVERITY[item[1][name].end] for name in COLUMNS if name in item[1])
    ):
        group = next((title for title, cases in GROUPS.items() if case in cases), "others")
        label = f"{CASES[case].about} ({mesh})" if several else CASES[case].about
        found.setdefault(group, {})[label] = row
    return found


def _line(axes: Axes, place: int, label: str, row: Row) -> None:
    """A case: its label and its cells."""
    text = "\n".join(textwrap.wrap(label, LETTERS, max_lines=3, placeholder=" ..."))
    axes.text(-LABEL / CELL + 0.05, place + 0.5, text, va="center", fontsize=10, linespacing=0.95)
    for column, name in enumerate(COLUMNS):
        if name in row:
            colour, ink = LOOKS[row[name].end]
            axes.add_patch(Rectangle((column + 0.03, place + 0.05), 0.94, 0.9, facecolor=colour, ec="#555555", lw=0.5))
            axes.text(column + 0.5, place + 0.5, row[name].short, ha="center", va="center", fontsize=10, color=ink)
