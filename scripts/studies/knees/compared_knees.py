"""Runs of the knee, and what passes each of its compartments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from harness.models.interface import InterfaceType, automatic
from harness.models.knee.bearing import Load
from harness.models.knee.whole_knee import Knee
from harness.models.knee.whole_mesh import Size
from harness.report import history, plot_file
from harness.report.history import Contact
from harness.report.plot_file import State
from harness.run.runner import Runner, RunResult
from studies.knees.knee_run import KneeRun
from studies.stamps import at_limit

FACTORS = (1.0, 10.0, 100.0)
"""Of FEBio's automatic penalties; 0 stands for the plugin's defaults."""


def knees(load: Load, size: Size) -> list[tuple[Knee, float]]:
    """The knees of a load and a size, the plugin's first, with the factors of their penalties."""
    return [(_knee(load, size, factor), factor) for factor in (0.0, *FACTORS)]


def _knee(load: Load, size: Size, factor: float) -> Knee:
    name = f"knee-{load.value}-{size.value}"
    if factor == 0.0:
        return Knee(InterfaceType.MIXTURE, size, load, name=name)
    settings = replace(automatic(factor), pressure_penalty=None, concentration_penalty=None)
    return Knee(InterfaceType.ELASTIC, size, load, settings=settings, name=f"{name}-febio-{factor:g}")


def run(knee: Knee, factor: float, runner: Runner) -> tuple[KneeRun, RunResult]:
    """Run a knee and measure it."""
    result = runner(knee.model(), check=False)
    report = result.report
    measured = KneeRun(
        load=knee.load.value,
        size=knee.size.value,
        contact=knee.contact.value,
        factor=factor,
        ended=report.normal,
        limited=at_limit(report.normal, result.cpu, result.limit),
        reached=0.0,
        steps=report.steps,
        iterations=report.iterations,
        retries=report.retries,
        seconds=result.cpu,
        memory=result.memory,
    )
    return _with_compartments(measured, result), result


def _with_compartments(measured: KneeRun, result: RunResult) -> KneeRun:
    """The run with what its plot file holds."""
    plot = plot_file.read(result.folder / f"{result.model.name}.xplt")
    contacts = [contact for contact in history.contacts(plot) if "-to-femur-" in contact.surface.name]
    reached = plot.states[-1].time
    if not contacts:
        return replace(measured, reached=reached)
    number = int(np.argmax(np.sum([contact.force for contact in contacts], axis=0)))
    medial, lateral = (_of_side(contacts, side, number) for side in ("medial", "lateral"))
    return replace(
        measured,
        reached=reached,
        force_medial=medial[0],
        force_lateral=lateral[0],
        area_medial=medial[1],
        area_lateral=lateral[1],
        peak_medial=medial[2],
        peak_lateral=lateral[2],
        overlap=max(_overlap(plot.states[number], contact) for contact in contacts),
    )


def _overlap(state: State, contact: Contact) -> float:
    """Largest overlap of a facet under pressure, mm; the plot file has overlaps as positive gaps."""
    gaps = state.on_surfaces["contact gap"][contact.place]
    if gaps is None:
        return 0.0
    pressed = history.pressures(state, contact.surface, contact.place) > 0.0
    return float(contact.surface.at_facets(gaps)[pressed, 0].max(initial=0.0))


def _of_side(contacts: Sequence[Contact], side: str, number: int) -> tuple[float, float, float]:
    """Force, area and largest pressure of a compartment in a state."""
    of_side = [contact for contact in contacts if contact.surface.name.endswith(side)]
    force = sum(float(contact.force[number]) for contact in of_side)
    area = sum(float(contact.area[number]) for contact in of_side)
    return force, area, max((float(contact.peak[number]) for contact in of_side), default=0.0)
