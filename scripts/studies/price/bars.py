"""The times that contacts wrote into logs, as bars and as a table."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from studies import tables
from studies.price.table import TASKS, Times

COLOURS = {"shared": "#9a9a9a", "traction": "#4c72b0", "solvent": "#55a868"}
SOLUTE_COLOURS = ("#dd8452", "#c44e52", "#da8bc3", "#8c613c")
TASK_COLOURS = dict(zip(TASKS, ("#4c72b0", "#55a868", "#c44e52", "#dd8452", "#9a9a9a"), strict=True))


def draw(scenes: Mapping[str, Times], path: Path) -> Path:
    """Stacked bars of milliseconds per scene, by effect and by task, with the share of the run above each."""
    figure = Figure(figsize=(11.0, 4.4), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    for axes, parts, colours in (
        (left, {name: times.effects for name, times in scenes.items()}, _effect_colours(scenes)),
        (right, {name: _by_task(times) for name, times in scenes.items()}, TASK_COLOURS),
    ):
        bottom = dict.fromkeys(parts, 0.0)
        for what, colour in colours.items():
            heights = [1e3 * parts[name].get(what, 0.0) for name in parts]
            axes.bar(list(parts), heights, bottom=list(bottom.values()), color=colour, label=what, width=0.7)
            bottom = {name: low + height for (name, low), height in zip(bottom.items(), heights, strict=True)}
        for place, (name, times) in enumerate(scenes.items()):
            axes.annotate(f"{100 * times.share:.1f}%", (place, bottom[name]), ha="center", va="bottom", fontsize=8)
        axes.tick_params(axis="x", labelsize=8, rotation=20)
        axes.legend(fontsize=8, loc="upper left")
        axes.margins(y=0.12)
    left.set(ylabel="time in the contact, ms", title="by effect (above: share of the run)")
    right.set(title="by task")
    figure.savefig(path, dpi=110)
    return path


def _effect_colours(scenes: Mapping[str, Times]) -> dict[str, str]:
    names = dict.fromkeys(effect for times in scenes.values() for effect in times.effects)
    solutes = sorted(name for name in names if name not in COLOURS)
    drawn = COLOURS | dict(zip(solutes, SOLUTE_COLOURS, strict=False))
    order = ("shared", "traction", "solvent", *solutes)
    return {name: drawn[name] for name in order if name in names}


def _by_task(times: Times) -> dict[str, float]:
    return {task: sum(effects.values()) for task, effects in times.seconds.items()}


def scenes_table(scenes: Mapping[str, Times]) -> str:
    """Milliseconds per scene and effect, as Markdown."""
    effects = list(_effect_colours(scenes))
    rows = []
    for name, times in scenes.items():
        own = times.effects
        cells = [f"{1e3 * own[effect]:.1f}" if effect in own else "" for effect in effects]
        sums = (f"{1e3 * times.total:.1f}", f"{1e3 * times.host:.1f}", f"{100 * times.share:.1f}%", times.memory)
        rows.append((name, *cells, *sums))
    heads = ("all", "of it in FEBio's assembly", "share of the run", "bytes per point")
    return tables.markdown(("scene", *effects, *heads), rows)
