"""The page of friction beside published curves: docs/evidence/friction-curves.md, with runs and curves as tables."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies import files, tables
from studies.friction import published
from studies.friction.curves import FEBIO_SERIES, SMOOTH_SPHERES, SPHERES, Row, outside, values_at
from studies.friction.published import ABAQUS, AREIAS, FEBIO, SAUER, Curves
from studies.pages.evidence import DATA, EvidencePage

PICTURE = "images/friction-benchmarks.svg"
RED = "#7a1f1f"
LINES = {"coarse mesh": (":", "0.45"), "fine mesh": ("-", RED), FEBIO_SERIES: ("--", "#2f5d9e")}
MARKS = {FEBIO: "o", SAUER: "s", ABAQUS: "^", AREIAS: "x"}
PANELS = (
    ("torque", "angle [degrees]", "torque [N mm]", "twisting hemisphere"),
    (SPHERES, "displacement [mm]", "force [N]", "octant of concentric spheres"),
    (SMOOTH_SPHERES, "displacement [mm]", "force [N]", "the same without friction"),
)


def draw(rows: Sequence[Row], path: Path) -> Path:
    """A panel for each problem, as SVG."""
    figure = Figure(figsize=(5.4, 9.0), layout="constrained", facecolor="white")
    all_axes = figure.subplots(len(PANELS), 1)
    for axes, (problem, place, value, title) in zip(all_axes, PANELS, strict=True):
        _panel(axes, [row for row in rows if row.problem == problem])
        axes.set(xlabel=place, ylabel=value)
        axes.set_title(title, fontsize=10)
    found = {
        label: handle for axes in all_axes for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    figure.legend(found.values(), found, loc="outside upper center", ncols=2, fontsize=9, frameon=False)
    return files.save_figure(figure, path)


def _panel(axes: Axes, rows: Sequence[Row]) -> None:
    for series in dict.fromkeys(row.series for row in rows):
        own = [row for row in rows if row.series == series]
        places, values = [row.place for row in own], [row.value for row in own]
        if series in LINES:
            style, colour = LINES[series]
            axes.plot(places, values, style, color=colour, linewidth=1.4, label=series)
        else:
            axes.plot(places, values, MARKS[series], color="black", markerfacecolor="none", ms=5, label=series)
    axes.set_ylim(bottom=0.0)
    axes.spines[["top", "right"]].set_visible(False)


SOURCE = "friction-benchmarks.csv"


def figures() -> Mapping[str, str]:
    """What the text of a page leaves open."""
    rows = files.read_csv(DATA / SOURCE, Row)
    return {
        "turned": turned_line(rows),
        "torque_table": _table(rows, "torque", "angle [degrees]", published.ANGLES, published.TORQUE),
        "pressed": pressed_line(rows),
    }


def spheres(rows: Sequence[Row]) -> Mapping[str, str]:
    """Tables of the concentric spheres, with friction and without it."""
    return {
        "spheres_table": _table(rows, SPHERES, "displacement [mm]", published.WAYS, published.SPHERES),
        "smooth_table": _table(rows, SMOOTH_SPHERES, "displacement [mm]", published.WAYS, published.SMOOTH_SPHERES),
    }


def turned_line(rows: Sequence[Row]) -> str:
    """How far the torque on the fine mesh is from each published curve, and from what both span."""
    own = values_at(rows, "torque", "fine mesh", published.ANGLES)
    far = {name: float(np.abs(own / np.array(curve) - 1.0).max()) for name, curve in published.TORQUE.items()}
    span = max(outside(v, s) for v, s in zip(own.tolist(), published.spread(published.TORQUE), strict=True))
    told = ", ".join(f"{100.0 * each:.1f} % from {name}" for name, each in far.items())
    return f"at most {told}, and {100.0 * span:.1f} % from the range of both"


def pressed_line(rows: Sequence[Row]) -> str:
    """How far the force on the fine mesh is from the published one."""
    own = values_at(rows, "force", "fine mesh", published.ANGLES)
    ((name, curve),) = published.PRESSED.items()
    return f"at most {100.0 * float(np.abs(own / np.array(curve) - 1.0).max()):.1f} % from {name}"


def _table(rows: Sequence[Row], problem: str, place: str, places: Sequence[float], curves: Curves) -> str:
    """A column for each published curve and each run, and how far the fine mesh is outside of what the former span."""
    runs = [
        series for series in dict.fromkeys(row.series for row in rows if row.problem == problem) if series not in curves
    ]
    found = {series: values_at(rows, problem, series, places).tolist() for series in runs}
    far = [outside(v, s) for v, s in zip(found["fine mesh"], published.spread(curves), strict=True)]
    heads = [place, *curves, *runs, "fine mesh outside published range"]
    lines = []
    for at, *values, out in zip(places, *curves.values(), *found.values(), far, strict=True):
        cells = ["fails before" if np.isnan(v) else f"{v:.2f}" for v in values]
        lines.append((f"{at:g}", *cells, f"{100.0 * out:.1f} %"))
    return tables.markdown(heads, lines)


PAGE = EvidencePage("evidence/friction-curves.md", (SOURCE,), Path(__file__).with_name("curves.md"), figures)
