"""The command line of the harness in the repository: which command stands in which module."""

import sys

from harness.user_commands import FOR_EVERYBODY, commands, start

COMMANDS = {
    **FOR_EVERYBODY,
    "engines": "studies.engines.command",
    "ablation": "studies.ablation.command",
    "knee": "studies.knees.command",
    "hard-cases": "studies.hard_cases.command",
    "hard-case": "studies.hard_cases.command",
    "friction-cases": "studies.friction.command",
    "friction-benchmarks": "studies.friction.command",
    "friction-cost": "studies.friction.command",
    "fuzz": "studies.fuzz.command",
    "fuzz-seeds": "studies.fuzz.command",
    "cost": "studies.cost.command",
    "cost-sweep": "studies.cost.command",
    "price": "studies.price.command",
    "synthetic-scenes": "studies.synthetic_scenes.command",
    "agreement": "studies.agreement.command",
    "robustness": "studies.robustness.command",
    "one-answer": "studies.one_answer.command",
    "linear-solvers": "studies.linear_solvers.command",
    "biphasic-hertz": "studies.hertz.command",
    "elastic-hertz": "studies.hertz.command",
    "evidence": "studies.evidence.command",
    "gallery": "studies.pages.gallery.command",
    "pages": "studies.site",
    "verification-report": "studies.pages.command",
}
"""Commands and their modules."""


def main() -> None:
    """Run the command line."""
    start(commands(COMMANDS, sys.argv[1:]), "scripts/mixcontact")
