"""Runs of the knee, and what passes each of its compartments."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from harness.arrays import Array
from harness.models.interface import ContactSettings, InterfaceType
from harness.models.knee.bearing import Load
from harness.models.knee.tissues import TISSUES, Bodies
from harness.models.knee.whole_knee import Knee
from harness.models.knee.whole_mesh import BATH, Size
from harness.models.parts import Mixture
from harness.post import solute_balance
from harness.report import history, plot_file
from harness.report.history import Contact
from harness.report.plot_file import PlotFile, State
from harness.run.runner import Runner, RunResult
from studies.hard_cases.variants import swapped
from studies.knees.knee_run import Kind, KneeRun, Way
from studies.stamps import at_limit

FACTORS = {Size.COARSE: (1.0, 10.0, 100.0), Size.SMALL: (1.0, 10.0, 100.0), Size.MEDIUM: (1.0, 10.0)}
"""Of FEBio's automatic penalties, by size; 0 stands for the plugin's defaults."""
SCENES = {
    Kind.ELASTIC: (
        (Bodies.ELASTIC, Load.STANCE, Size.SMALL),
        (Bodies.ELASTIC, Load.STANCE, Size.MEDIUM),
        (Bodies.ELASTIC, Load.GAIT, Size.COARSE),
    ),
    Kind.POROUS: (
        (Bodies.BIPHASIC, Load.STANCE, Size.SMALL),
        (Bodies.BIPHASIC, Load.STANCE, Size.COARSE),
        (Bodies.BIPHASIC, Load.GAIT, Size.COARSE),
        (Bodies.SOLUTE, Load.STANCE, Size.COARSE),
    ),
}
WAYS = {
    Way.DEFAULTS: ContactSettings(),
    Way.SWAPPED: ContactSettings(),
    Way.TWO_PASSES: ContactSettings(two_pass=True),
    Way.AUGLAG: ContactSettings(laugon="AUGLAG"),
    Way.LAGMULT: ContactSettings(laugon="LAGMULT"),
}


def knees(kind: Kind, only: str = "") -> list[tuple[Knee, float]]:
    """The knees of whose name `only` is a part, with factors of their penalties; the plugin's first in each scene."""
    made = [(_knee(*scene, factor), factor) for scene in SCENES[kind] for factor in (0.0, *FACTORS[scene[2]])]
    return [(knee, factor) for knee, factor in made if only in knee.name]


def _knee(bodies: Bodies, load: Load, size: Size, factor: float) -> Knee:
    kind = "" if bodies is Bodies.ELASTIC else f"{bodies.value}-"
    name = f"knee-{kind}{load.value}-{size.value}"
    if factor == 0.0:
        return Knee(InterfaceType.MIXTURE, size, load, name=name, bodies=bodies)
    tissues = TISSUES[bodies]
    name = f"{name}-febio-{factor:g}"
    return Knee(tissues.theirs, size, load, settings=tissues.automatic(factor), name=name, bodies=bodies)


def answers(runner: Runner) -> dict[Way, KneeRun]:
    """Runs of the elastic knee in stance by the plugin in all ways, on the mesh of which a run takes seconds."""
    knees = {way: Knee(size=Size.COARSE, settings=WAYS[way], name=f"knee-{way.name.lower()}") for way in Way}
    models = {way: knee.model() for way, knee in knees.items()}
    models[Way.SWAPPED] = replace(swapped(models[Way.SWAPPED]), name=knees[Way.SWAPPED].name)
    return {way: _measured(knee, 0.0, runner(models[way], check=False)) for way, knee in knees.items()}


def run(knee: Knee, factor: float, runner: Runner) -> tuple[KneeRun, RunResult]:
    """Run a knee and measure it."""
    result = runner(replace(knee.model(), node_log=knee.bodies is Bodies.SOLUTE), check=False)
    return _measured(knee, factor, result), result


def _measured(knee: Knee, factor: float, result: RunResult) -> KneeRun:
    report = result.report
    measured = KneeRun(
        bodies=knee.bodies.value,
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
    measured = _with_compartments(measured, result)
    if knee.bodies is Bodies.SOLUTE and report.steps:
        measured = replace(measured, appeared=_appeared(result))
    return measured


def _with_compartments(measured: KneeRun, result: RunResult) -> KneeRun:
    """The run with what its plot file holds."""
    plot = plot_file.read(result.folder / f"{result.model.name}.xplt")
    contacts = under_femur(plot)
    reached = plot.states[-1].time
    if not contacts:
        return replace(measured, reached=reached)
    number = int(np.argmax(np.sum([contact.force for contact in contacts], axis=0)))
    most, last = _fluid(contacts)
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
        fluid_most=most,
        fluid_last=last,
    )


def under_femur(plot: PlotFile) -> list[Contact]:
    """The surfaces on which the femur presses."""
    return [contact for contact in history.contacts(plot) if "-to-femur-" in contact.surface.name]


def fluid_share(contacts: Sequence[Contact]) -> Array:
    """Part of the load on surfaces that the fluid bears, over time; NaN where that is not known."""
    forces = np.array([contact.mean * contact.area for contact in contacts])
    shares = np.array([contact.fluid_share for contact in contacts])
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where(forces > 0.0, forces * shares, 0.0).sum(axis=0) / forces.sum(axis=0))


def _fluid(contacts: Sequence[Contact]) -> tuple[float, float]:
    """Largest and last share of the fluid while the load is above half of its largest."""
    share, force = fluid_share(contacts), np.sum([contact.force for contact in contacts], axis=0)
    loaded = share[(force > 0.5 * force.max()) & np.isfinite(share)]
    return (float(loaded.max()), float(loaded[-1])) if len(loaded) else (math.nan, math.nan)


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


def _appeared(result: RunResult) -> float:
    """Solute that entered at nodes which nothing feeds, over the whole run, relative to the content at the end.

    Contact surfaces and synovial fluid feed the nodes on them.
    """
    model = result.model
    history = result.nodes
    states = solute_balance.states(history)
    parts = [part for part in model.mesh.parts if isinstance(model.materials[part.material], Mixture)]
    balanced = np.ones(len(model.mesh.nodes), dtype=bool)
    for fed in (model.mesh.node_sets[BATH], *(model.mesh.surfaces[name] for name in model.contact_surfaces)):
        balanced[np.ravel(fed) - 1] = False
    total = 0.0
    for (before, after), step in zip(pairwise(states), np.diff(history.times), strict=True):
        inflow = sum(solute_balance.inflow(model, part, before, after, float(step)) for part in parts)
        total += float(np.sum(np.asarray(inflow)[balanced]))
    return abs(total) / sum(solute_balance.content(model, part, states[-1]) for part in parts)
