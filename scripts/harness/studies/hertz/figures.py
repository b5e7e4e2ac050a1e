"""Half-width and peak pressure over time, runs over the closed form."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from harness.studies.hertz.growth_records import PROBLEMS, Record

STYLES = {
    PROBLEMS[0].name: ("o", "72 elements along the half"),
    PROBLEMS[1].name: ("x", "144 elements"),
    PROBLEMS[2].name: ("^", "72, free surfaces drain"),
}
GREY = "0.25"


def draw(rows: Sequence[Record], path: Path) -> Path:
    """Both pictures side by side, as SVG."""
    figure = Figure(figsize=(8.2, 3.3), layout="constrained")
    left, right = figure.subplots(1, 2)
    _panel(left, rows, "half_width", 1.0, "half-width [mm]")
    _panel(right, rows, "peak", 1e3, "peak pressure [kPa]")
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4, fontsize=8, frameon=False)
    figure.patch.set_facecolor("white")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None})
    return path


def _panel(axes: Axes, rows: Sequence[Record], name: str, scale: float, label: str) -> None:
    first = [row for row in rows if row.model == PROBLEMS[0].name]
    exact = [scale * getattr(row, f"{name}_exact") for row in first]
    axes.plot([row.time for row in first], exact, "-", color=GREY, linewidth=1.4, label="thin layers, closed form")
    for model, (marker, legend) in STYLES.items():
        own = [row for row in rows if row.model == model]
        values = [scale * getattr(row, name) for row in own]
        filled = "none" if marker != "x" else GREY
        axes.plot([row.time for row in own], values, marker, color="black", markerfacecolor=filled, ms=4, label=legend)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(label)
    axes.set_ylim(bottom=0.0)
    axes.spines[["top", "right"]].set_visible(False)
