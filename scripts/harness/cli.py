"""The command line of the harness in the repository: which command is which function."""

from __future__ import annotations

from functools import partial

from harness.indentation import command as indentation
from harness.pages import command as pages
from harness.pages import command_reference, front
from harness.pages.gallery import command as gallery
from harness.studies.cost import command as cost
from harness.studies.cost import page as cost_page
from harness.studies.friction import command as friction
from harness.studies.friction import page as friction_page
from harness.studies.fuzz import command as fuzz
from harness.studies.hard_cases import command as hard_cases
from harness.studies.hard_cases import page as hard_cases_page
from harness.studies.hertz import command as hertz
from harness.studies.hertz import page as verification_page
from harness.studies.linear_solvers import command as linear_solvers
from harness.studies.predictor import command as predictor
from harness.studies.predictor import page as predictor_page
from harness.studies.price import command as price
from harness.studies.price import page as price_page
from harness.studies.real_models import command as real_models
from harness.studies.robustness import command as robustness
from harness.user_commands import FOR_EVERYBODY, commands, start
from harness.validate import engines_command

_OF_THE_REPOSITORY = (
    engines_command.engines,
    indentation.indentation,
    indentation.indentation_study,
    indentation.indentation_extremes,
    indentation.indentation_convergence,
    hard_cases.hard_cases,
    hard_cases.hard_case,
    friction.friction_cases,
    friction.friction_benchmarks,
    friction.friction_cost,
    fuzz.fuzz,
    fuzz.fuzz_seeds,
    cost.cost,
    cost.cost_sweep,
    cost.cost_interleaved,
    price.price,
    predictor.predictor,
    real_models.real_models,
    robustness.robustness,
    linear_solvers.linear_solvers,
    hertz.biphasic_hertz,
    gallery.gallery,
    pages.pages,
    pages.report,
)


PAGES = (
    hard_cases_page.PAGE,
    friction_page.PAGE,
    cost_page.PAGE,
    price_page.PAGE,
    verification_page.PAGE,
    predictor_page.PAGE,
)
"""Pages of evidence, which are made from the results of studies."""
pages.PAGES.update({page.name: page for page in PAGES})
pages.PAGES[command_reference.PAGE] = partial(
    command_reference.page, (*FOR_EVERYBODY, *_OF_THE_REPOSITORY), FOR_EVERYBODY
)
pages.PAGES[front.PAGE] = front.page

app = commands(*FOR_EVERYBODY, *_OF_THE_REPOSITORY)


def main() -> None:
    """Run the command line."""
    start(app)
