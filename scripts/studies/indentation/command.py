"""The commands that run problem 3.3: one run with its figures, and the table of configurations."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.indentation import figures, histories
from harness.indentation.histories import Curves
from harness.models.indentation import END, TIMES
from harness.models.interface import ContactSettings, InterfaceType
from harness.paths import RESULTS
from harness.run.runner import Runner, RunResult
from studies.indentation import configurations, convergence, extremes
from studies.indentation.configurations import Case, Configuration, Row
from studies.indentation.convergence import Arrangement, Solved
from studies.models.indentation_variants import Variant

console = Console(highlight=False, soft_wrap=True)


class Solver(str, Enum):
    """FEBio's module, and what its solver does with negative concentrations."""

    SOLUTE = "solute"
    CLAMPED = "multiphasic"
    UNCLAMPED = "multiphasic-unclamped"

    @property
    def module(self) -> str:
        """Name of the module."""
        return self.value.split("-")[0]

    @property
    def clamp(self) -> bool:
        """Whether negative concentrations are set to zero."""
        return self is not Solver.UNCLAMPED


class Enforcement(str, Enum):
    """How the contact's conditions are enforced."""

    PENALTY = "PENALTY"
    AUGLAG = "AUGLAG"
    LAGMULT = "LAGMULT"


MOST_AUGMENTATIONS = 25
"""Where a tolerance is given: enough for every tolerance that rounding allows."""


def indentation(
    variant: Annotated[Variant, typer.Option(help="Variant of the problem.")] = Variant.PLAIN,
    interface: Annotated[
        InterfaceType, typer.Option(help="Join the bodies by this interface.")
    ] = InterfaceType.MIXTURE,
    solver: Annotated[Solver, typer.Option(help="Use this solver of FEBio.")] = Solver.UNCLAMPED,
    configuration: Annotated[
        Configuration | None,
        typer.Option(help="Use this configuration of the study; the default is that of the interface."),
    ] = None,
    segments: Annotated[
        bool, typer.Option("--segments", help="Integrate over segments (sliding-mixture only).")
    ] = False,
    laugon: Annotated[
        Enforcement | None, typer.Option(help="Use this enforcement in place of that of the configuration.")
    ] = None,
    tolerance: Annotated[float | None, typer.Option(help="Relative tolerance of gaps and jumps.")] = None,
    free_top: Annotated[bool, typer.Option("--free-top", help="Let the flat top of the round body slide.")] = False,
    folder: Annotated[Path, typer.Option(help="Write results and pictures to this folder.")] = RESULTS,
) -> None:
    """Run problem 3.3, a semi-cylinder that moves into a slab, and draw figure 3.4 and its curves.

    The command draws a failed run up to its last converged state. The exit code is then 1.
    """
    problem = replace(variant.problem, interface=interface, module=solver.module, clamp=solver.clamp)
    if configuration is not None:
        problem = replace(problem, settings=configuration.settings(), primary=configuration.primary)
    settings = problem.settings or ContactSettings()
    if segments:
        settings = replace(settings, integration="segments")
    if laugon is not None:
        settings = replace(settings, laugon=laugon.value)
    if tolerance is not None:
        settings = replace(settings, tolerance=tolerance, maxaug=MOST_AUGMENTATIONS)
    problem = replace(problem, settings=None if settings == ContactSettings() else settings, gripped=not free_top)
    result = Runner(folder / "runs", timeout=None)(problem.model(), check=False)
    curves = histories.curves(result)
    console.print(_summary(result, curves), markup=False)
    if not problem.grid.solid:
        written = figures.draw(result, curves, folder)
        console.print("Written: " + ", ".join(str(path) for path in written))
    if not result.report.normal:
        raise typer.Exit(1)


def _summary(result: RunResult, curves: Curves) -> str:
    """Effort and a few numbers at the times of the pictures."""
    report = result.report
    lines = [
        f"{result.model.name}, {result.model.contacts[0].kind}: "
        f"{'normal termination' if report.normal else 'ended early'}, {report.steps} steps, {report.iterations} "
        f"iterations, {report.residuals} residuals, {report.retries} retries, {result.wall:.0f} s",
        "  t [s]   force [N]  half-width  slab [nmol]  cylinder  outflow   imbalance  overlap  jump c",
    ]
    for time in TIMES:
        if time <= curves.times[-1] * (1.0 + 1e-6):
            i = int(abs(curves.times - time).argmin())
            lines.append(
                f"{time:7g} {curves.force[i]:11.5f} {curves.half_width[i]:11.4f} {curves.slab[i]:12.6f} "
                f"{curves.cylinder[i]:9.6f} {curves.outflow[i]:8.6f} {curves.imbalance[i]:11.1e} "
                f"{curves.overlap[i]:8.1e} {curves.jump_c[i]:7.1e}"
            )
    return "\n".join(lines)


def indentation_study(
    interface: Annotated[
        InterfaceType, typer.Option(help="Join the bodies by this interface.")
    ] = InterfaceType.MIXTURE,
    solver: Annotated[Solver, typer.Option(help="Use this solver of FEBio.")] = Solver.UNCLAMPED,
    default_penalties: Annotated[
        bool, typer.Option(help="Use the default penalties of the interface, not FEBio's scaled ones.")
    ] = False,
    timeout: Annotated[float, typer.Option(help="Limit each run to this wall time [s].")] = configurations.TIMEOUT,
    folder: Annotated[Path, typer.Option(help="Write runs and the table to this folder.")] = RESULTS,
) -> None:
    """Run problem 3.3 in the five configurations in which FEBio's interfaces fail, and list the outcome of each run."""
    cases = [Case(c, interface, solver.module, solver.clamp, not default_penalties) for c in Configuration]

    def tell(row: Row) -> None:
        console.print(row.line(), markup=False)

    console.print(configurations.HEADING, markup=False)
    rows = configurations.study(Runner(folder / "runs", timeout=timeout), cases, finished=tell)
    name = f"indentation-study-{interface.slug}-{solver.value}{'-default' if default_penalties else ''}.md"
    path = folder / name
    path.write_text(configurations.table(rows) + "\n")
    console.print(f"Written: {path}")
    if any(row.reached < END for row in rows):
        raise typer.Exit(1)


def indentation_extremes(
    only: Annotated[list[str] | None, typer.Option(help="Run only the cases of these names.")] = None,
    folder: Annotated[Path, typer.Option(help="Write runs, table and picture to this folder.")] = RESULTS,
) -> None:
    """List concentrations outside 0 to 1 mM in problem 3.3 and in bodies without contact, by mesh, and for d0 = d."""
    runs = extremes.run(Runner(folder / "runs", timeout=None), only)
    console.print(extremes.table(runs), markup=False)
    console.print(f"Written: {extremes.draw(runs, folder / 'indentation-extremes.png')}")


def indentation_convergence(
    primary: Annotated[list[Arrangement] | None, typer.Option(help="Run only these arrangements.")] = None,
    meshes: Annotated[int, typer.Option(min=1, max=3, help="Number of meshes, from the coarsest.")] = 3,
    folder: Annotated[Path, typer.Option(help="Write runs and the table to this folder.")] = RESULTS,
) -> None:
    """Run problem 3.3 on three meshes with the same steps, and list values and observed orders in half an hour."""

    def tell(solved: Solved) -> None:
        report = solved.result.report
        console.print(
            f"{solved.result.model.name}: {'done' if report.normal else 'ended early'}, {report.steps} steps, "
            f"{report.iterations} iterations, {report.retries} retries, {solved.result.wall:.0f} s",
            markup=False,
        )

    runner = Runner(folder / "runs", timeout=None)
    runs = convergence.run(runner, primary or list(Arrangement), meshes, tell)
    path = folder / "indentation-convergence.md"
    path.write_text(convergence.table(runs) + "\n")
    console.print(convergence.table(runs), markup=False)
    console.print(f"Written: {path}")
    if not all(solved.result.report.normal for solved in runs):
        raise typer.Exit(1)
