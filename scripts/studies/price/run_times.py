"""The page of how long a run takes by its size: docs/how-to/time.md, from the joints that the contact is timed on."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from studies import files, tables
from studies.pages.evidence import DATA, EvidencePage
from studies.price.joints import OURS, JointPrice

JOINTS = "price-joints.csv"
HEADS = ("scene", "unknowns", "iterations", "matrices", "time [s]", "of an iteration [s]", "FEBio's [s]")


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    rows = files.read_csv(DATA / JOINTS, JointPrice)
    ours = sorted((row for row in rows if row.type == OURS and row.ended), key=lambda row: row.unknowns)
    return {"times": tables.markdown(HEADS, map(_cells, ours)), "growth": _growth(ours), "share": _share(ours)}


def _cells(row: JointPrice) -> tuple[object, ...]:
    each, theirs = row.seconds / row.iterations, row.seconds / row.ratio
    times = (f"{row.seconds:.3g}", f"{each:.2g}", f"{theirs:.3g}")
    return (row.scene, row.unknowns, row.iterations, row.matrices, *times)


def _growth(rows: Sequence[JointPrice]) -> str:
    """How the time of an iteration grows from the smallest to the largest scene."""
    small, large = rows[0], rows[-1]
    more = large.unknowns / small.unknowns
    longer = (large.seconds / large.iterations) / (small.seconds / small.iterations)
    return (
        f"The last scene has {more:.0f} times the unknowns of the first. An iteration takes {longer:.0f} times as long."
    )


def _share(rows: Sequence[JointPrice]) -> str:
    shares = [row.share for row in rows]
    return f"{100 * min(shares):.0f} to {100 * max(shares):.0f} %"


PAGE = EvidencePage(
    name="how-to/time.md", sources=(JOINTS,), template=Path(__file__).with_name("run_times.md"), figures=figures
)
