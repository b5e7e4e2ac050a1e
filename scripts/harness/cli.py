"""The command line of the harness in the repository: which command is which function."""

from __future__ import annotations

from harness.indentation import command as indentation
from harness.pages import command as pages
from harness.pages.gallery import command as gallery
from harness.studies.cost import command as cost
from harness.studies.fuzz import command as fuzz
from harness.studies.hard_cases import command as hard_cases
from harness.studies.hard_cases import rubbing_command
from harness.studies.hertz import command as hertz
from harness.studies.linear_solvers import command as linear_solvers
from harness.studies.predictor import command as predictor
from harness.studies.price import command as price
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
    rubbing_command.friction_cases,
    fuzz.fuzz,
    fuzz.fuzz_seeds,
    cost.cost,
    cost.cost_sweep,
    cost.cost_turn,
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


app = commands(*FOR_EVERYBODY, *_OF_THE_REPOSITORY)


def main() -> None:
    """Run the command line."""
    start(app)
