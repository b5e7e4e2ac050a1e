"""The picture of a converted joint: contact pressure on the socket before and after."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from matplotlib.figure import Figure

from harness.models.interface import InterfaceType
from harness.report import history, plot_file
from harness.run.runner import Runner
from studies.models.kept_models import joint_before
from studies.post import side_by_side
from studies.post.side_by_side import Shown

PICTURE = "joint-converted.png"
_CAMERA = ((-24.0, -14.0, 26.0), (0.0, 0.0, -6.0), (0.0, 0.0, 1.0))
"""The eye looks into the socket from above (mm)."""


def draw(runner: Runner, folder: Path) -> Path:
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
    side_by_side.draw(figure, figure.subplots(1, 2), shown, _CAMERA)
    path = folder / PICTURE
    figure.savefig(path, dpi=110, bbox_inches="tight", pad_inches=0.05, pil_kwargs={"optimize": True})
    return path
