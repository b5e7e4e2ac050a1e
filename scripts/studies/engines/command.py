"""The command that compares the two engines node by node."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from harness.choice import chosen
from harness.models.convection import PRESSURES, Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.indentation import Indentation
from harness.models.parts import Param
from harness.paths import RESULTS
from harness.post.compare import Measure, missed
from harness.run.hosts import FEBIO4, STANDALONE
from harness.run.runner import Runner, RunResult
from studies.options import console

TOLERANCE = 1e-10  # Newton's relative tolerances
SMOOTH, MOVING = 1e-7, 1e-5
"""Largest difference of a nodal variable, relative to its largest value: of problems 3.1 and 3.2, and of 3.3."""


@dataclass(frozen=True)
class Comparison:
    """A model that both engines run."""

    name: str  # for `--only`
    model: Callable[[], Model]  # makes the model
    floor: float  # squared residual at which rounding is all that is left, in the units of the model's equations
    tolerance: float = SMOOTH


COMPARISONS = (
    Comparison("diffusion", Diffusion().model, 1e-22),
    *(Comparison(f"convection-pe{peclet}", Convection(peclet=peclet).model, 1e-18) for peclet in PRESSURES),
    Comparison("indentation", Indentation(module="multiphasic", clamp=False).model, 1e-26, tolerance=MOVING),
)


def strict(model: Model, floor: float) -> Model:
    """The model with tolerances that leave nothing but rounding, and with steps that do not follow the iterations."""
    stepper = model.control.stepper and replace(model.control.stepper, force=True)
    control = replace(
        model.control,
        displacement_tolerance=TOLERANCE,
        energy_tolerance=0.0,
        pressure_tolerance=TOLERANCE,
        concentration_tolerance=TOLERANCE,
        reformations=2 * model.control.reformations,
        stepper=stepper,
        solver=(Param("min_residual", floor), *model.control.solver),
    )
    return replace(model, control=control)


def differences(one: RunResult, two: RunResult) -> dict[str, float]:
    """Largest difference of each nodal variable that is not zero throughout, over all times, relative to its size."""
    first, second = one.nodes, two.nodes
    np.testing.assert_allclose(first.times, second.times, rtol=1e-9)
    sizes = {name: np.abs(first[name]).max() for name in first.columns if name not in ("x", "y", "z")}
    return {name: float(np.abs(first[name] - second[name]).max() / size) for name, size in sizes.items() if size > 0}


def compare(comparison: Comparison, runners: Sequence[Runner]) -> list[Measure]:
    """Run a model with two engines, and measure the difference of each nodal variable.

    Raises EngineNotFoundError, PluginNotFoundError, EngineFailedError: see `harness.run.engine`.
    """
    model = strict(comparison.model(), comparison.floor)
    one, two = (runner(model) for runner in runners)
    steps = f"{one.report.steps} steps"
    return [
        Measure(f"{comparison.name}: {variable}", value, comparison.tolerance, note=steps)
        for variable, value in differences(one, two).items()
    ]


def engines(
    only: Annotated[
        list[str] | None, typer.Option(help="Compare only this problem. The option may be repeated.")
    ] = None,
    folder: Annotated[Path, typer.Option(help="Write runs to this folder.")] = RESULTS,
) -> None:
    """Run problems 3.1 to 3.3 with febio4 and the embedded engine, with tight tolerances, and compare all nodes."""
    known = {comparison.name: comparison for comparison in COMPARISONS}
    names = chosen(only, known)
    runners = [Runner(folder / "engines" / host.name, host=host) for host in (FEBIO4, STANDALONE)]
    failures = 0
    for name in names:
        measures = compare(known[name], runners)
        failures += len(missed(measures))
        for m in measures:
            verdict = "met" if m.passed else "missed"
            console.print(f"{m.name:22} {m.value:9.1e} <= {m.tolerance:.0e} {verdict:6} {m.note}", markup=False)
    if failures:
        raise typer.Exit(1)
