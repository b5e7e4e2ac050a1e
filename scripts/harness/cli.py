"""The command line of the harness in the repository: which command stands in which module."""

from __future__ import annotations

import sys

from harness.user_commands import FOR_EVERYBODY, commands, start

COMMANDS = {
    **FOR_EVERYBODY,
    "engines": "harness.validate.engines_command",
    "indentation": "harness.indentation.command",
    "indentation-study": "harness.indentation.command",
    "indentation-extremes": "harness.indentation.command",
    "indentation-convergence": "harness.indentation.command",
    "ablation": "harness.studies.ablation.command",
    "knee": "harness.studies.knees.command",
    "hard-cases": "harness.studies.hard_cases.command",
    "hard-case": "harness.studies.hard_cases.command",
    "friction-cases": "harness.studies.friction.command",
    "friction-benchmarks": "harness.studies.friction.command",
    "friction-cost": "harness.studies.friction.command",
    "fuzz": "harness.studies.fuzz.command",
    "fuzz-seeds": "harness.studies.fuzz.command",
    "cost": "harness.studies.cost.command",
    "cost-sweep": "harness.studies.cost.command",
    "cost-interleaved": "harness.studies.cost.command",
    "price": "harness.studies.price.command",
    "predictor": "harness.studies.predictor.command",
    "synthetic-scenes": "harness.studies.synthetic_scenes.command",
    "agreement": "harness.studies.agreement.command",
    "robustness": "harness.studies.robustness.command",
    "one-answer": "harness.studies.one_answer.command",
    "linear-solvers": "harness.studies.linear_solvers.command",
    "biphasic-hertz": "harness.studies.hertz.command",
    "elastic-hertz": "harness.studies.hertz.command",
    "evidence": "harness.studies.remeasurement.command",
    "gallery": "harness.pages.gallery.command",
    "pages": "harness.site",
    "verification-report": "harness.pages.command",
}
"""Commands and their modules."""


def main() -> None:
    """Run the command line."""
    start(commands(COMMANDS, sys.argv[1:]), "scripts/mixcontact")
