"""FEBio's interface with the symmetric matrix that its module `solid` has by default, beside a non-symmetric one."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from studies import tables, timing
from studies.models.ball_in_socket import BallInSocket
from studies.price import joints, table
from studies.price.joints import Joint, Scene
from studies.timing import Announce

FORMATS = ("non-symmetric", "symmetric")
"""FEBio's names; the second is its default in the module `solid`, the first in modules with a fluid."""


@dataclass(frozen=True)
class Matrix:
    """FEBio's interface on one scene with one form of its matrix."""

    scene: str
    form: str
    ended: bool
    iterations: int
    retries: int
    ratio: float
    ratio_low: float
    ratio_high: float
    """Median, least and largest of the processor time over that with a non-symmetric matrix, run in turn."""
    entries: int  # the most entries of the matrix


def measure(scenes: Mapping[str, Scene], repetitions: int, announce: Announce) -> list[Matrix]:
    """Run FEBio's interface on the joints without a fluid, with each form of the matrix in turn."""
    solid = {name: scene for name, scene in scenes.items() if isinstance(scene, BallInSocket) and not scene.porous}
    return [row for name, scene in solid.items() for row in _rows(name, scene, repetitions, announce)]


def _rows(name: str, scene: Scene, repetitions: int, announce: Announce) -> list[Matrix]:
    model = joints.rival(scene).model()
    models = {form: replace(model, control=replace(model.control, matrix=form)) for form in FORMATS}
    runs = joints.run(models, repetitions, lambda told: announce(f"{name}: {told}"))
    found = []
    for form, own in runs.items():
        run, log = own[0]
        counts = (run.report.normal, run.report.iterations, run.report.retries)
        spread = timing.spread(timing.ratios(own, runs[FORMATS[0]]))
        found.append(Matrix(name, form, *counts, *spread, table.entries(log)))
    return found


def headline(found: Sequence[Matrix], measured: Sequence[Joint]) -> str:
    """What FEBio's default matrix changes, and on how many scenes its run is then the faster."""
    default = {row.scene: row for row in found if row.form == FORMATS[1]}
    other = {row.scene: row for row in found if row.form == FORMATS[0]}
    ended = [scene for scene, row in default.items() if row.ended]
    iterations = [default[scene].iterations / other[scene].iterations for scene in ended]
    times = [default[scene].ratio for scene in ended]
    ours = {joint.ours.scene: joint.ours for joint in measured}
    faster = sum(ours[scene].ratio > default[scene].ratio for scene in ended)
    return (
        "FEBio's matrix is non-symmetric in the comparison. Its default in the module `solid` is symmetric. FEBio's "
        f"interface completes {len(ended)} of the {len(default)} joints without a fluid with this default. It takes "
        f"{min(iterations):.2f} to {max(iterations):.2f} times the iterations and {min(times):.2f} to {max(times):.2f} "
        f"times the time of the non-symmetric matrix. It is then faster than `sliding-mixture` in "
        f"{faster or 'none'} of them."
    )


def matrices_table(found: Sequence[Matrix], measured: Sequence[Joint]) -> str:
    """A row for each scene, as Markdown."""
    ours = {joint.ours.scene: joint.ours for joint in measured}
    rows = {(row.scene, row.form): row for row in found}
    heads = ("scene", "iterations", "symmetric: iterations", "time, symmetric over non-symmetric")
    lines = []
    for scene in dict.fromkeys(row.scene for row in found):
        plain, default = (rows[scene, form] for form in FORMATS)
        times = (f"{default.ratio:.2f}", f"{ours[scene].ratio / default.ratio:.2f}")
        lines.append((scene, plain.iterations, *((default.iterations, *times) if default.ended else ("fails", "", ""))))
    return tables.markdown((*heads, "`sliding-mixture` over symmetric"), lines)
