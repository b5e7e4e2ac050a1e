"""Draws one cycle of the joint as an animation: fluid pressure over the deformed bodies, and the force."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from harness.post.section_figures import MAP, draw_bodies
from harness.run.runner import RunResult
from studies.models.joint import PERIOD
from studies.pages.gallery.entries import Curves, Entry

MODEL, PICTURE = "joint", "joint-cycle.png"  # the model, and the name of its animated PNG
TITLE = "One cycle of the load: effective fluid pressure over the deformed bodies, and the force (animation)"
SECONDS = 4.0  # the animation's own period
DPI, COLOURS = 80, 128
KILO = 1e3  # pascals, of megapascals


@dataclass(frozen=True)
class Cycle:
    """The last cycle of a run: its states, and the largest fluid pressure [MPa], which ends the scale of colours."""

    entry: Entry
    result: RunResult
    curves: Curves

    @cached_property
    def states(self) -> NDArray[np.intp]:
        """One per frame, the first one after the cycle has begun."""
        times = self.curves.times
        return np.flatnonzero(times > times[-1] - PERIOD + 1e-6)

    @cached_property
    def largest(self) -> float:
        """MPa."""
        return float(self.result.nodes["p"][self.states].max())

    @cached_property
    def heights(self) -> tuple[float, float]:
        """The lowest and the highest position, with a margin, so that all frames have the same place [mm]."""
        heights = self.result.nodes["y"][self.states]
        margin = 0.04 * float(np.ptp(heights))
        return float(heights.min()) - margin, float(heights.max()) + margin


def draw(entry: Entry, result: RunResult, curves: Curves, path: Path) -> Path:
    """Draw the last cycle of a run as an animated PNG, a frame for each of its states."""
    cycle = Cycle(entry, result, curves)
    frames = [_shown(_frame(cycle, int(state))) for state in cycle.states]
    first, *others = _with_one_palette(frames)
    length = round(1e3 * SECONDS / len(frames))
    first.save(path, save_all=True, append_images=others, duration=length, loop=0, optimize=True)
    return path


def _frame(cycle: Cycle, state: int) -> Figure:
    """The bodies at a state above the force over the cycle, where a dot marks the state."""
    history, section = cycle.result.nodes, cycle.entry.section
    figure = Figure(figsize=(7.0, 3.4), layout="constrained", facecolor="white")
    bodies, force = figure.subplots(2, 1, height_ratios=(2.0, 1.0))
    positions = np.stack([history[axis][state] for axis in "xyz"], axis=1)
    draw_bodies(bodies, cycle.result.model.mesh, section, positions, history["p"][state] / cycle.largest)
    bodies.set_ylim(*cycle.heights)
    drawn = ScalarMappable(Normalize(0.0, KILO * cycle.largest), MAP)
    figure.colorbar(drawn, ax=bodies, label=r"$\tilde p$ [kPa]", shrink=0.9)
    _force(force, cycle, state)
    return figure


def _force(axes: Axes, cycle: Cycle, state: int) -> None:
    """The force over the time in the cycle."""
    assert cycle.curves.force is not None
    times, forces, states = cycle.curves.times, cycle.curves.force, cycle.states
    times = times - times[states[0] - 1]
    axes.plot(times[states], forces[states], color="#0b5fa5", linewidth=1.4)
    axes.plot(times[state], forces[state], "o", color="#d1495b", markersize=6)
    axes.set(xlabel="time in the cycle [s]", ylabel="force [N]", xticks=np.linspace(0.0, PERIOD, 5))
    axes.spines[["top", "right"]].set_visible(False)


def _shown(figure: Figure) -> Image.Image:
    held = BytesIO()
    figure.savefig(held, dpi=DPI)
    return Image.open(held).convert("RGB")


def _with_one_palette(frames: list[Image.Image]) -> Iterator[Image.Image]:
    """Frames with few colours, the same ones in all: small files without flicker."""
    all_frames = np.concatenate([np.asarray(frame) for frame in frames])
    palette = Image.fromarray(all_frames).quantize(COLOURS)
    return (frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames)
