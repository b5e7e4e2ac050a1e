"""Runs of febio4 on files, and continued ones."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from harness.run import engine
from harness.run.engine import Run


def run(model: Path, *, plugin: Path | None = None, options: Sequence[str] = (), check: bool = True) -> Run:
    """Run febio4 on a model file, in the folder of that file; an error where it does not end normally if `check`."""
    return engine.execute(engine.command(model, plugin, options), model.resolve().parent, check=check)


def restart(archive: Path, *, plugin: Path | None = None) -> Run:
    """Continue from a dump file, in its folder; FEBio can only continue a run that also wrote a plot file."""
    load = [] if plugin is None else ["-import", str(plugin)]
    return engine.execute([str(engine.find_engine()), "-r", archive.name, *load], archive.resolve().parent)
