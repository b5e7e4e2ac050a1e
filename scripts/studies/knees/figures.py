"""Contact pressure with FEBio's interface and with the plugin's: on tibia and menisci, and on a converted joint."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from harness.models.interface import InterfaceType
from harness.report import history, plot_file
from harness.report.plot_file import PlotFile
from harness.run.runner import Runner, RunResult
from studies.knees.compared_knees import fluid_share, under_femur
from studies.knees.knee_run import KneeRun
from studies.models.kept_models import joint_before
from studies.post import side_by_side
from studies.post.side_by_side import Shown

CONVERTED = "joint-converted.png"  # the picture of a joint before and after its conversion
_INTO_SOCKET = ((-24.0, -14.0, 26.0), (0.0, 0.0, -6.0), (0.0, 0.0, 1.0))
"""The eye looks into the socket from above (mm)."""
Done = tuple[KneeRun, RunResult]
FACTORS = (0.0, 10.0)
"""Of the penalties of the runs that are drawn: the plugin's defaults, and ten times FEBio's automatic penalties."""
PICTURES = {"knee.png": ("elastic", "stance"), "porous-knee.png": ("biphasic", "stance")}
"""Bodies and loads by the names of their pictures."""
_CAMERA = ((0.0, -75.0, 95.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))  # the eye is behind the knee and above it (mm)


def draw_all(done: Sequence[Done], folder: Path) -> list[Path]:
    """Draw the bodies and loads that have pictures, each in the size that comes first; return the paths."""
    drawn = []
    for name, wanted in PICTURES.items():
        here = [each for each in done if (each[0].bodies, each[0].load) == wanted and each[0].factor in FACTORS]
        if here:
            drawn.append(draw([each for each in here if each[0].size == here[0][0].size], folder / name))
    return drawn


def draw(runs: Sequence[Done], path: Path) -> Path:
    """Draw the last states of runs side by side, in one scale of colours, FEBio's first; return the path.

    Where a fluid bears part of the load, a curve shows that part over time.
    """
    shown = sorted(runs, key=lambda run: run[0].factor == 0.0)
    plots = [plot_file.read(result.folder / f"{result.model.name}.xplt") for _, result in shown]
    porous = any(math.isfinite(run.fluid_most) for run, _ in shown)
    figure = Figure(figsize=(14.0 if porous else 10.0, 3.5), layout="constrained")
    axes = figure.subplots(1, len(shown) + porous, squeeze=False)[0]
    titles = [f"FEBio's {run.contact}" if run.factor else run.contact for run, _ in shown]
    seen = [Shown(title, plot, under_femur(plot)) for title, plot in zip(titles, plots, strict=True)]
    side_by_side.draw(figure, axes[: len(shown)], seen, _CAMERA)
    if porous:
        _draw_shares(axes[-1], plots, [run for run, _ in shown])
    return _save(figure, path)


def _save(figure: Figure, path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110, bbox_inches="tight", pad_inches=0.05, pil_kwargs={"optimize": True})
    return path


def _draw_shares(axes: Axes, plots: Sequence[PlotFile], runs: Sequence[KneeRun]) -> None:
    """Part of the load that the fluid bears, over time."""
    for plot, run in zip(plots, runs, strict=True):
        contacts = under_femur(plot)
        axes.semilogx(contacts[0].time[1:], fluid_share(contacts)[1:], ".-", label=run.contact)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("part of the load that the fluid bears")
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    axes.legend()


def draw_converted(runner: Runner, folder: Path) -> Path:
    """Run the joint with FEBio's interface and as converted without penalties, and draw the last states."""
    before = joint_before()
    (contact,) = before.contacts
    ours = replace(contact, kind=InterfaceType.MIXTURE.value, params=())
    shown = []
    for title, model in (
        ("before: sliding-elastic", before),
        ("after: sliding-mixture", replace(before, name="joint-after", contacts=(ours,))),
    ):
        plot = plot_file.read(runner(model).folder / f"{model.name}.xplt")
        shown.append(Shown(title, plot, [each for each in history.contacts(plot) if "socket" in each.surface.name]))
    figure = Figure(figsize=(10.0, 3.9), layout="constrained")
    side_by_side.draw(figure, figure.subplots(1, 2), shown, _INTO_SOCKET)
    return _save(figure, folder / CONVERTED)
