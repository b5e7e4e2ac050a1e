"""The list of an installed harness: quick, and as its commands describe themselves. Needs neither FEBio nor a build."""

from __future__ import annotations

import subprocess
import sys

import pytest
import typer.main

from harness.paths import REPOSITORY
from harness.user_commands import FOR_EVERYBODY, commands
from studies.cli import COMMANDS

LISTS = """
import sys
from harness.user_commands import FOR_EVERYBODY, commands
try:
    commands(FOR_EVERYBODY, sys.argv[1:])(sys.argv[1:])
finally:
    assert not {"numpy", "matplotlib", "lxml"} & set(sys.modules), "a list needs none of these"
"""


def helps(app: typer.Typer) -> dict[str, str]:
    """The help of each command by its name."""
    made = typer.main.get_group(app)
    return {name: command.help or "" for name, command in made.commands.items()}


@pytest.mark.parametrize("known", [FOR_EVERYBODY, COMMANDS], ids=["harness", "studies"])
def test_a_list_has_the_help_of_the_commands_themselves(known):
    assert helps(commands(known, ["--help"])) == helps(commands(known))


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["--help"], 0, "convert"),
        (["convrt"], 2, "Did you mean 'convert'?"),
        (["--", "validate"], 1, "the command has to be the first word: validate"),
    ],
    ids=["help", "mistyped", "hidden"],
)
def test_a_list_imports_no_library_of_a_command(arguments, code, said):
    command = [sys.executable, "-c", LISTS, *arguments]
    done = subprocess.run(
        command, cwd=REPOSITORY / "scripts", capture_output=True, text=True, check=False, env={"COLUMNS": "200"}
    )
    assert done.returncode == code, done.stderr
    assert said in done.stdout + done.stderr


def test_a_command_that_is_called_is_the_one_that_there_is():
    assert list(helps(commands(FOR_EVERYBODY, ["convert", "model.feb"]))) == ["convert"]
