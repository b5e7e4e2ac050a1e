"""What the plugin is held to: each check runs a few models and returns measured numbers with their tolerances.

The tolerances marked "paper" in the notes are those of problems 3.1 and 3.2 of Ateshian, Maas and Weiss (2012).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from harness.arrays import Array
from harness.closed_forms import (
    composite_slab,
    confined_compression,
    penalty_leak,
    steady_convection,
    transient_diffusion,
    two_layer_convection,
)
from harness.indentation import histories, measures
from harness.models import composite, confined, convection, diffusion, layers
from harness.models.indentation import Indentation
from harness.models.indentation_mesh import Primary
from harness.models.interface import PAPER, ContactSettings, InterfaceType, augmented, automatic
from harness.models.layered import Layered
from harness.models.parts import Control
from harness.post import compare
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult

PAIR = "lower/upper"
SPLIT_BAR = 1e-6  # largest difference of a split body from its reference, relative to the largest value of the variable


@dataclass(frozen=True)
class Context:
    """Who runs the models, and what joins the bodies."""

    runner: Runner
    interface: InterfaceType = InterfaceType.MIXTURE

    @property
    def biphasic(self) -> InterfaceType:
        """The interface for bodies without solutes."""
        return self.interface if self.interface is InterfaceType.MIXTURE else InterfaceType.BIPHASIC


def against_conforming(context: Context, problem: Layered) -> tuple[RunResult, RunResult]:
    """A problem split, and its conforming reference in the same module."""
    split = problem.model()
    name, whole = f"{problem.name}-conforming", InterfaceType.CONFORMING
    reference = replace(problem, interface=whole, settings=None, module=split.module, name=name)
    return context.runner(split), context.runner(reference.model())


def diffusion_pair(context: Context, settings: ContactSettings | None = None) -> tuple[RunResult, RunResult]:
    """Problem 3.1 split, and its conforming reference."""
    return against_conforming(context, diffusion.Diffusion(context.interface, settings))


def convection_pair(context: Context, peclet: int) -> tuple[RunResult, RunResult]:
    """Problem 3.2 split, and its conforming reference."""
    return against_conforming(context, convection.Convection(context.interface, peclet=peclet))


def diffusion_against_reference(context: Context) -> list[Measure]:
    """Problem 3.1, default settings: the split body agrees with its conforming reference."""
    split, reference = diffusion_pair(context)
    iterations, allowed = split.report.iterations, 1.05 * reference.report.iterations
    difference = compare.largest_difference(split, reference, "c1") / diffusion.AMBIENT
    return [
        Measure(
            "3.1 split against conforming, largest difference in c/c*", difference, SPLIT_BAR, note="default settings"
        ),
        Measure("3.1 Newton iterations", iterations, allowed, note=f"conforming: {reference.report.iterations}"),
    ]


def diffusion_against_closed_form(context: Context) -> list[Measure]:
    """Problem 3.1, default settings: the error against the closed form is that of the conforming reference."""
    split, reference = diffusion_pair(context)
    measures = []
    for time in (400.0, 2000.0, 8000.0):
        own, by_mesh = (compare.error_at(run, "c1", exact_diffusion(run, time), time) for run in (split, reference))
        name = f"3.1 error in c/c* against the closed form, t = {time:g} s"
        measures.append(Measure(name, own, by_mesh + SPLIT_BAR, note=f"conforming: {by_mesh:.2e}"))
    return measures


def exact_diffusion(run: RunResult, time: float) -> Array:
    """Closed form of 3.1 at the nodes of a run."""
    z = run.model.mesh.nodes[:, 2]
    return diffusion.AMBIENT * transient_diffusion.concentration(
        z, time, height=diffusion.HEIGHT, diffusivity=diffusion.DIFFUSIVITY
    )


def convection_against_closed_form(
    context: Context, peclets: Sequence[int] = tuple(convection.PRESSURES)
) -> list[Measure]:
    """Problem 3.2, default settings: the error against the closed form is that of the conforming reference."""
    measures = []
    for peclet in peclets:
        split, reference = convection_pair(context, peclet)
        own, by_mesh = (compare.error_at(run, "c1", exact_convection(run, peclet)) for run in (split, reference))
        name = f"3.2 Pe = {peclet}, error in c in excess of the conforming reference"
        iterations = f"iterations {split.report.iterations}, conforming: {reference.report.iterations}"
        note = f"{own:.2e}, conforming: {by_mesh:.2e}; {iterations}"
        measures.append(Measure(name, abs(own - by_mesh), SPLIT_BAR, note=note))
    return measures


def exact_convection(run: RunResult, peclet: float) -> Array:
    """Closed form of 3.2 at the nodes of a run."""
    z = run.model.mesh.nodes[:, 2]
    return steady_convection.concentration(z, height=diffusion.HEIGHT, peclet=peclet, upstream=convection.UPSTREAM)


def indentation_pair(context: Context) -> tuple[RunResult, RunResult]:
    """Problem 3.3 with the primary surface on the cylinder and on the slab; FEBio's own penalties for its interface."""
    interface, settings = (
        (context.interface, None)
        if context.interface is InterfaceType.MIXTURE
        else (InterfaceType.MULTIPHASIC, automatic(1.0))
    )
    problem = Indentation(interface, settings, module="multiphasic", clamp=False)
    other = replace(problem, primary=Primary.SLAB, name="indentation-slab-primary")
    return context.runner(problem.model()), context.runner(other.model())


def indentation_balances(context: Context) -> list[Measure]:
    """Problem 3.3 meets balances, bounds, ambient values and contact conditions, with either body as primary."""
    run, other = indentation_pair(context)
    curves, others = (histories.curves(each) for each in (run, other))
    return [*measures.of_a_run(run, curves), *measures.of_both_primaries(curves, others)]


def leak_of_a_penalty(context: Context) -> list[Measure]:
    """The article's penalties without augmentation leave the jump that follows from these penalties."""
    steady = convection.Convection(context.interface, PAPER, control=Control(20, 1000.0), name="leak", peclet=0).model()
    jump = compare.jump(context.runner(steady), "c1", PAIR)
    expected = expected_leak(PAPER)
    name = "Steady jump with the paper's penalties, relative to the leak formula, less 1"
    return [Measure(name, abs(jump / expected - 1.0), 0.01, note=f"jump {jump:.4f}, formula {expected:.4f}")]


def expected_leak(settings: ContactSettings) -> float:
    """Steady jump of c (mM) of problem 3.2 at Pe = 0 for a given concentration penalty."""
    if settings.concentration_penalty is None:
        raise ValueError("these settings have no concentration penalty")
    conductance = convection.POROSITY * diffusion.DIFFUSIVITY
    half = diffusion.HEIGHT / 2 / conductance
    return convection.UPSTREAM * penalty_leak.relative_jump((half, half), settings.concentration_penalty)


def augmentation(context: Context) -> list[Measure]:
    """Problem 3.1, the article's penalties, AUGLAG: the jump closes within a limit of iterations."""
    split, reference = diffusion_pair(context, augmented(PAPER, 1e-6))
    history = split.nodes
    below, above = compare.facing(split.model.mesh, PAIR)
    gaps = np.abs(history["c1"][:, below - 1] - history["c1"][:, above - 1])
    iterations, allowed = split.report.iterations, 4 * reference.report.iterations
    note = f"{split.report.augmentations} augmentations; conforming: {reference.report.iterations} iterations"
    return [
        Measure("3.1 AUGLAG, paper's penalties, ctol 1e-6: largest jump of c/c*", float(gaps.max()), 1e-6),
        Measure("3.1 AUGLAG, paper's penalties: Newton iterations", iterations, allowed, note=note),
    ]


def composite_layers(context: Context) -> list[Measure]:
    """A composite slab, with a jump of c, agrees with the conforming reference and the closed form."""
    runs = against_conforming(context, composite.Composite(context.interface))
    time = 2000.0
    exact = composite_slab.concentration(runs[0].model.mesh.nodes[:, 2], time, composite.FIRST, composite.SECOND)
    error = compare.error_at(runs[0], "c1", exact, time)
    return [
        Measure("Composite slab, split against conforming", compare.largest_difference(*runs, "c1"), SPLIT_BAR),
        Measure("Composite slab, error against the closed form, t = 2000 s", error, 5e-3, note="steps of 20 s"),
    ]


def convection_layers(context: Context) -> list[Measure]:
    """Steady convection through two layers, with a jump of c, agrees with the reference and the closed form."""
    runs = against_conforming(context, layers.Layers(context.interface))
    z = runs[0].model.mesh.nodes[:, 2]
    exact = two_layer_convection.concentration(z, layers.FIRST, layers.SECOND, layers.GIVEN)
    error = compare.error_at(runs[0], "c1", exact)
    return [
        Measure("Two-layer convection, split against conforming", compare.largest_difference(*runs, "c1"), SPLIT_BAR),
        Measure("Two-layer convection, error against the closed form", error, 2e-4, note="conforming: 2e-5"),
    ]


def confined_creep(context: Context) -> list[Measure]:
    """Confined creep of a split layer agrees with the conforming reference and the closed form."""
    runs = against_conforming(context, confined.Confined(context.biphasic))
    scale = confined.LOAD / confined.MODULUS * confined.HEIGHT
    pressures = compare.largest_difference(*runs, "p") / confined.LOAD
    settlement = compare.largest_difference(*runs, "uz") / scale
    return [
        Measure("Confined creep, split against conforming, fluid pressure / load", pressures, 1e-5),
        Measure(
            "Confined creep, split against conforming, settlement", settlement, 5e-5, note="penetration: load/penalty"
        ),
        Measure("Confined creep, settlement against the closed form", creep_error(runs[0]), 5e-3, note="tau >= 0.1"),
    ]


def creep_error(run: RunResult) -> float:
    """Largest error of the settlement for tau >= 0.1, relative to the final settlement."""
    history = run.nodes
    tau = confined.MODULUS * confined.PERMEABILITY * history.times / confined.HEIGHT**2
    exact = confined_compression.displacement(
        1.0, tau, load=confined.LOAD, modulus=confined.MODULUS, height=confined.HEIGHT
    )
    top = int(run.model.mesh.node_sets["top"][0]) - 1
    late = tau >= 0.1
    scale = confined.LOAD / confined.MODULUS * confined.HEIGHT
    return float(np.max(np.abs(history["uz"][late, top] + exact[late]))) / scale


def orders(context: Context) -> list[Measure]:
    """Problem 3.1: observed orders of c in h and dt are those of the elements and the time integration."""
    by_mesh = [_coarse_diffusion(context, elements, 10) for elements in (5, 10, 20)]
    by_step = [_coarse_diffusion(context, 10, steps) for steps in (10, 20, 40)]
    space, time = _order(by_mesh), _order(by_step)
    return [
        Measure("3.1 observed order in h across the contact", space, 2.2, lowest=1.8, note="5, 10, 20 elements a cube"),
        Measure("3.1 observed order in dt across the contact", time, 1.2, lowest=0.8, note="200, 100, 50 s"),
    ]


def _coarse_diffusion(context: Context, elements: int, steps: int) -> RunResult:
    """Problem 3.1 to 2000 s."""
    name = f"diffusion-{elements}x{steps}"
    return context.runner(
        diffusion.Diffusion(
            context.interface, elements=elements, control=Control(steps, 2000.0 / steps), name=name
        ).model()
    )


def _order(runs: Sequence[RunResult]) -> float:
    """Observed order from three runs, each refined by two: largest differences at the nodes of the coarsest."""
    z = runs[0].model.mesh.nodes[:, 2]
    finals = [_both_sides(run, z) for run in runs]
    coarse, fine = (float(np.max(np.abs(a - b))) for a, b in pairwise(finals))
    return compare.observed_order(coarse, fine)


def _both_sides(run: RunResult, z: Array) -> Array:
    """Final c at the heights `z`, of the nodes of a split column, part by part so that both faces are kept."""
    mesh, final = run.model.mesh, run.nodes["c1"][-1]
    values = []
    for part in mesh.parts:
        ids = np.unique(part.elements) - 1
        inside = z[(z >= mesh.nodes[ids, 2].min() - 1e-9) & (z <= mesh.nodes[ids, 2].max() + 1e-9)]
        values.append(final[ids[np.argmin(np.abs(mesh.nodes[ids, 2][:, None] - inside), axis=0)]])
    return np.concatenate(values)


def closed_forms_agree(_: Context) -> list[Measure]:
    """A closed form agrees with another of which it is a special case; no model runs."""
    z = np.linspace(0.0, 2.0, 41)
    half = composite_slab.Layer(1.0, diffusivity=5e-4, porosity=0.8, solubility=1.0)
    halves = composite_slab.concentration(z, 800.0, half, half)
    slab = transient_diffusion.concentration(z - 1.0, 800.0, height=2.0, diffusivity=5e-4)
    layer = two_layer_convection.Layer(1.0, 5e-4, 5e-4, porosity=0.8, solubility=1.0)
    both = two_layer_convection.concentration(z, layer, layer, two_layer_convection.Conditions(2e-4, 1.0, 0.0))
    single = steady_convection.concentration(z - 1.0, height=2.0, peclet=1.0)
    name = "Closed forms: two equal layers against one slab"
    return [
        Measure(f"{name}, diffusion", float(np.max(np.abs(halves - slab))), 1e-12),
        Measure(f"{name}, convection", float(np.max(np.abs(both - single))), 1e-12),
    ]


@dataclass(frozen=True)
class Check:
    """A named check and what it does in one line."""

    name: str
    run: Callable[[Context], list[Measure]]

    @property
    def about(self) -> str:
        """First line of the check's description."""
        return (self.run.__doc__ or "").splitlines()[0]


CHECKS = (
    Check("closed-forms", closed_forms_agree),
    Check("diffusion", diffusion_against_reference),
    Check("diffusion-closed-form", diffusion_against_closed_form),
    Check("convection", convection_against_closed_form),
    Check("indentation", indentation_balances),
    Check("leak", leak_of_a_penalty),
    Check("augmentation", augmentation),
    Check("orders", orders),
    Check("composite", composite_layers),
    Check("layers", convection_layers),
    Check("confined", confined_creep),
)
