"""The page of friction beside published curves: docs/evidence/friction-curves.md, with runs and curves as tables."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from studies import files, tables
from studies.friction import published
from studies.friction.curves import SMOOTH_SPHERES, SPHERES, Row, outside, values_at
from studies.friction.published import Curves
from studies.pages.evidence import DATA, EvidencePage

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
