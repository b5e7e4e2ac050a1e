"""All generated pages of the documentation, the files of models/, and the command that writes them."""

from collections.abc import Callable
from typing import Annotated

import typer

from harness.errors import HarnessError
from harness.paths import DOCS, MODELS
from harness.user_commands import FOR_EVERYBODY, commands
from studies.ablation import page as ablation
from studies.agreement import page as agreement
from studies.cli import COMMANDS
from studies.cost import page as cost
from studies.evidence.steps import LIMITS
from studies.friction import curves_table
from studies.friction import page as friction
from studies.hard_cases import page as hard_cases
from studies.hertz import page as hertz
from studies.knees import page as knees
from studies.models import kept_models
from studies.pages import (
    command_reference,
    evidence,
    front,
    linear_solver_results,
    plugin_parameters,
    reported_results,
    scene_results,
    sketches,
    verification,
)
from studies.pages.gallery import page as gallery
from studies.price import page as price
from studies.price import run_times
from studies.run_tables import page as run_tables

EVIDENCE = (
    hard_cases.PAGE,
    friction.PAGE,
    curves_table.PAGE,
    cost.PAGE,
    price.PAGE,
    run_tables.PAGE,
    run_times.PAGE,
    hertz.PAGE,
    *knees.PAGES,
    ablation.PAGE,
)
"""Pages of evidence, which are made from the results of studies."""

PAGES: dict[str, Callable[[], str]] = {
    plugin_parameters.PAGE: plugin_parameters.page,
    gallery.PAGE: lambda: gallery.page(gallery.read(DOCS)),
    verification.PAGE: lambda: verification.page(verification.read(DOCS)),
    scene_results.PAGE: lambda: scene_results.page(scene_results.read(DOCS / scene_results.DATA)),
    scene_results.ALL: lambda: scene_results.all_scenes(scene_results.read(DOCS / scene_results.DATA)),
    reported_results.PAGE: lambda: reported_results.page(scene_results.read(DOCS / reported_results.DATA)),
    reported_results.ALL: lambda: reported_results.all_scenes(scene_results.read(DOCS / reported_results.DATA)),
    agreement.ALL: lambda: agreement.all_meshes(agreement.read()),
    agreement.PAGE: lambda: agreement.page(agreement.read()),
    linear_solver_results.PAGE: lambda: linear_solver_results.page(
        linear_solver_results.read(DOCS / linear_solver_results.DATA)
    ),
    **{page.name: page for page in EVIDENCE},
    command_reference.PAGE: lambda: command_reference.page(commands(COMMANDS), FOR_EVERYBODY),
    front.PAGE: front.page,
}
"""Generated pages, from code or from results in docs/data, without a run."""


def pages(
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing, and fail if a file is not up to date.")
    ] = False,
) -> None:
    """Write the generated pages of the documentation, from code and results in docs/data, and the models of models/.

    The command fails with --check if a page or model is out of date, or if the results in docs/data come from different
    measurements.
    """
    if check:
        evidence.check_together(LIMITS)
    made = {DOCS / name: text() for name, text in PAGES.items()}
    made |= {MODELS / f"{model.name}.feb": model.text() for model in kept_models.every_model()}
    for path, text in made.items():
        if not check:
            path.write_text(text, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            raise HarnessError(f"{path} is not what `pages` writes; it writes it again")
    if not check:
        sketches.draw(DOCS)
