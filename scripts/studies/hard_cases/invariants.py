"""What every hard case has to satisfy, whatever it shows: balances, bounds, contact conditions, invariance."""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from harness.arrays import Ids, Mask
from harness.models.document import Model
from harness.post import solute_balance
from harness.post.compare import Measure
from harness.run.logdata import History
from harness.run.runner import Runner, RunResult
from studies.hard_cases import variants
from studies.hard_cases.scene import NEWTON, Case, prescribed

ROUNDING = 1e-12  # of the sums over two sides of a contact, relative to their largest value
INVARIANT = 1e-9  # relative difference of two runs of the same model written differently
LOG_ROUNDING = 5e-13  # largest relative rounding of node data
MASS = 0.1 * NEWTON
"""Solute that appears in a run, relative to the largest content: what Newton's iterations leave at all other nodes."""


def of_any_run(run: RunResult, case: Case) -> list[Measure]:
    """Checks that a run of any interface can be put to."""
    return [*finite_and_bounded(run, case.undershoot), *mass(run), *contact_conditions(run, case.pointwise)]


def of_the_plugin(run: RunResult, rerun: Runner, case: Case) -> list[Measure]:
    """Further checks, which need the plugin's output, or more runs."""
    return [*cancellation(run), *off_ambient(run), *invariance(run, rerun, case.swap)]


def cancellation(run: RunResult) -> list[Measure]:
    """Force and flows of the two sides of each contact add up to nothing."""
    force, flow = 0.0, 0.0
    for contact in run.model.contacts:
        first, second = (run.surface(name).values[:, 0] for name in run.model.mesh.pairs[contact.pair])
        total, size = np.abs(first + second).max(axis=0), np.abs(first).max(axis=0)
        force = max(force, _ratio(total[:3].max(), size[:3].max()))
        flow = max(flow, *(_ratio(t, s) for t, s in zip(total[3:], size[3:], strict=True)))
    sums = {"forces": force, "flows": flow}
    return [Measure(f"{what} of both sides, sum", found, ROUNDING) for what, found in sums.items()]


def _ratio(part: float, whole: float) -> float:
    return float(part / whole) if whole > 0.0 else float(part)


def finite_and_bounded(run: RunResult, undershoot: float) -> list[Measure]:
    """All node data are numbers, and concentrations stay within what is given at the start and at the boundary."""
    history = run.nodes
    measures = [Measure("node data that are no numbers", float(np.sum(~np.isfinite(history.values))), 0.0)]
    for number in range(1, run.model.n_solutes + 1):
        low, high = _given(run.model, number)
        c, span = history[f"c{number}"], (high - low) or 1.0
        outside = max(float(low - c.min()), float(c.max() - high), 0.0) / span
        measures.append(Measure(f"c{number} outside of what is given", outside, undershoot))
    return measures


def _given(model: Model, sol: int) -> tuple[float, float]:
    """Smallest and largest concentration that a model prescribes, starts with (0 where not said) or has outside."""
    values = [0.0]
    for condition in model.conditions:
        params = {param.tag: param.value for param in condition.params}
        if params.get("dof") == f"c{sol}":
            values.append(float(params["value"]))  # type: ignore[arg-type]
    ambient = (p for contact in model.contacts for p in contact.params if p.tag == "ambient_concentration")
    values += [float(p.value) for p in ambient if p.attributes.get("sol", "1") == str(sol)]  # type: ignore[arg-type]
    return min(values), max(values)


def mass(run: RunResult) -> list[Measure]:
    """Solute that appears at nodes which nothing feeds, summed over all steps; the worst of all solutes.

    The log has 12 digits. Where long steps make much of them, so that the tolerance is missed, it is raised by what
    changes in them could change.
    """
    model = run.model
    if not model.n_solutes or any(len(m.solutes) != model.n_solutes for m in model.materials.values()):
        return []
    found = _appeared(model, run.nodes)
    tolerance = MASS if found <= MASS else MASS + _resolution(model, run.nodes, found)
    return [Measure("solute that appears, relative", found, tolerance)]


def _resolution(model: Model, history: History, found: float) -> float:
    """Largest change of `_appeared` if the digits that the log leaves out are drawn at random."""
    changes = []
    for seed in range(8):
        left_out = np.random.default_rng(seed).uniform(-LOG_ROUNDING, LOG_ROUNDING, history.values.shape)
        changes.append(abs(_appeared(model, replace(history, values=history.values * (1.0 + left_out))) - found))
    return max(changes)


def _appeared(model: Model, history: History) -> float:
    """Amount of a solute that enters at nodes which nothing feeds, relative to its largest content.

    Nodes of a contact surface at exactly nothing are at ambient values. The others count together: what one side
    loses there the other one gains. In steps in which some of them are at ambient, all are left out, as the
    contact also exchanges with the surroundings at its edge.
    """
    held = prescribed(model.conditions, "prescribed concentration")
    fed = _nodes_in(model, (model.mesh.node_sets[name] for name in held))
    contact = _nodes_in(model, (model.mesh.surfaces[name] for name in model.contact_surfaces))
    states, parts = solute_balance.states(history), model.mesh.parts
    appeared, most = np.zeros(model.n_solutes), np.zeros(model.n_solutes)
    for before, after, step in zip(states, states[1:], np.diff(history.times), strict=False):
        entered = np.sum([solute_balance.inflows(model, part, before, after, float(step)) for part in parts], axis=0)
        ambient = contact & (after.pressure == 0.0) & (after.concentrations == 0.0).all(axis=0)
        counted = ~fed & ~ambient if not ambient.any() else ~fed & ~contact
        appeared += entered[:, counted].sum(axis=1)
        most = np.maximum(most, np.sum([solute_balance.contents(model, part, after) for part in parts], axis=0))
    return max(_ratio(abs(amount), whole) for amount, whole in zip(appeared, most, strict=True))


def _nodes_in(model: Model, sets: Iterable[Ids]) -> Mask:
    """Whether each node is in one of some sets of node numbers."""
    found = np.zeros(len(model.mesh.nodes), dtype=bool)
    for numbers in sets:
        found[numbers - 1] = True
    return found


def contact_conditions(run: RunResult, tolerance: float) -> list[Measure]:
    """No pull, no overlap, no load across a gap, at each accepted step: means over the facets of primary surfaces."""
    pull, overlap, across, largest = 0.0, 0.0, 0.0, 0.0
    for contact in run.model.contacts:
        primary = run.model.mesh.pairs[contact.pair][0]
        facets = run.facets(primary)
        steps = facets.times > 0.0
        depth = facets["contact gap"][steps]  # FEBio counts an overlap as positive
        load = facets["contact pressure"][steps]
        length = _facet_length(run.model, primary)
        pull, largest = max(pull, float(-load.min())), max(largest, float(load.max()))
        overlap = max(overlap, float(depth.max()) / length)
        inner = _inner(run.model.mesh.surfaces[primary], load > 0.0)
        across = max(across, float((load * np.maximum(-depth, 0.0) * inner).max()) / length)
    return [
        Measure("pull, relative to the largest pressure", _ratio(pull, largest), ROUNDING),
        Measure("overlap, relative to a facet", overlap, tolerance),
        Measure("pressure times gap, relative", _ratio(across, largest), tolerance),
    ]


def off_ambient(run: RunResult) -> list[Measure]:
    """Open nodes are at the ambient values, which are 0 in all cases, at each accepted step.

    Open is a primary node all of whose facets bear exactly nothing.
    """
    model, history = run.model, run.nodes
    loaded = np.zeros((len(history.times), len(model.mesh.nodes)), dtype=bool)
    primary = [model.mesh.pairs[contact.pair][0] for contact in model.contacts]
    for surface in primary:
        load, facets = run.facets(surface)["contact pressure"], model.mesh.surfaces[surface]
        has_node = np.zeros((len(facets), len(model.mesh.nodes)))
        has_node[np.arange(len(facets))[:, None], facets - 1] = 1.0
        loaded[-len(load) :] |= (load != 0.0) @ has_node > 0.0
    of_contact = _nodes_in(model, (model.mesh.surfaces[surface] for surface in primary))
    found = 0.0
    solutes = [f"c{number + 1}" for number in range(model.n_solutes)]
    for kind, names in (("prescribed fluid pressure", ["p"]), ("prescribed concentration", solutes)):
        held = _nodes_in(model, (model.mesh.node_sets[name] for name in prescribed(model.conditions, kind)))
        free = ~loaded & of_contact & ~held & (history.times > 0.0)[:, None]
        for name in names:
            values = np.abs(history[name])
            found = max(found, _ratio(float(values[free].max(initial=0.0)), float(values.max())))
    return [Measure("open nodes off ambient, relative", found, 0.0)]


def _inner(facets: Ids, loaded: Mask) -> Mask:
    """Facets all of whose neighbours bear load, (n_times, n_facets): those at an edge of contact are half open."""
    shares = (facets[:, None, :, None] == facets[None, :, None, :]).any(axis=(2, 3))
    return np.asarray(~((~loaded).astype(int) @ shares.astype(int) > 0))


def _facet_length(model: Model, surface: str) -> float:
    """Mean length of the shortest edges of the facets, mm."""
    x = model.mesh.nodes[model.mesh.surfaces[surface][:, :4] - 1]
    return float(np.linalg.norm(np.roll(x, 1, axis=1) - x, axis=2).min(axis=1).mean())


def invariance(run: RunResult, rerun: Runner, tolerance: float) -> list[Measure]:
    """The same model moved and renumbered, in one run, and with its sides exchanged."""
    model, place = variants.renumbered(variants.moved(run.model))
    other = rerun(model).nodes
    back = variants.turned_back(other.values[:, place], run.model.node_columns)
    exchanged = rerun(variants.swapped(run.model))
    gap, swap = variants.difference(run, back, other.times), _swap(run, exchanged)
    note = "the log warns" if any("without any load" in text for text in exchanged.report.warnings) else ""
    return [
        Measure("moved as a whole, nodes renumbered, relative difference", gap, INVARIANT),
        Measure("sides swapped, relative difference of forces and concentrations", swap, tolerance, note=note),
    ]


def _swap(run: RunResult, other: RunResult) -> float:
    """Largest relative difference at the end: of the total reaction on each body, and of each mean concentration."""
    found = 0.0
    names = ["Rx", "Ry", "Rz"]
    mine, theirs = run.nodes, other.nodes
    bodies = [np.unique(part.elements) - 1 for part in run.model.mesh.parts]
    scale = max(float(np.abs(mine[name]).sum(axis=1).max()) for name in names) / 2.0
    for ids in bodies:
        gaps = [abs(float(mine[name][-1, ids].sum() - theirs[name][-1, ids].sum())) for name in names]
        found = max(found, _ratio(max(gaps), scale))
        for name in (c for c in mine.columns if c.startswith("c")):
            gap = abs(float(mine[name][-1, ids].mean() - theirs[name][-1, ids].mean()))
            found = max(found, _ratio(gap, float(np.abs(mine[name]).max())))
    return found
