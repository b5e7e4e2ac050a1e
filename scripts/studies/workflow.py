"""Many runs, driven by Snakemake: resumable, on local cores or, with its executors, on a cluster."""

from __future__ import annotations

import importlib.util
import json
import os
import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from harness.errors import HarnessError
from harness.paths import REPOSITORY
from harness.run.engine import find_engine, required_plugin

WORKFLOW = REPOSITORY / "scripts" / "workflow"
DOES_NOT_HOLD = 1
"""Exit code of a command that is done, and whose checks do not hold."""


def run(jobs: Mapping[str, Sequence[str]], folder: Path, *, cores: int = 1, options: Sequence[str] = ()) -> list[Path]:
    """Do what has not been done yet, and return the files that are there afterwards.

    Parameters
    ----------
    jobs : mapping
        For each job the arguments of the command that does it; it is given ``--out <folder>/<name>.json`` besides.
    folder : Path
        Where the results are. One that is older than febio4 or the plugin is made anew.
    cores : int
        Jobs at a time.
    options : sequence of str
        Further options of Snakemake.

    Raises
    ------
    HarnessError
        Without Snakemake, febio4 or the plugin. A job that fails leaves no file, and its log beside where it would be.
    """
    given = {name: shlex.join(arguments) for name, arguments in jobs.items()}
    binaries = f"binaries=[{find_engine()},{required_plugin()}]"
    _snakemake("Snakefile", given, folder, ["--cores", str(cores), *options], binaries)
    return [path for path in (folder / f"{name}.json" for name in jobs) if path.is_file()]


def in_turn(steps: Mapping[str, Sequence[Sequence[str]]], folder: Path) -> set[str]:
    """Do steps of several commands one at a time, the last after all others, and return the names of those done.

    Parameters
    ----------
    steps : mapping
        For each step the arguments of its commands. A command whose checks do not hold is done.
    folder : Path
        Where the logs are.

    Raises
    ------
    HarnessError
        Without Snakemake.
    """
    for name in steps:
        (folder / f"{name}.done").unlink(missing_ok=True)
    given = {name: " && ".join(map(_command, commands)) for name, commands in steps.items()}
    if given:
        _snakemake("Steps", given, folder, ["--cores", "1"])
    return {name for name in steps if (folder / f"{name}.done").is_file()}


def _command(arguments: Sequence[str]) -> str:
    return f"({shlex.join([sys.executable, '-m', 'studies', *arguments])} || [ $? = {DOES_NOT_HOLD} ])"


def _snakemake(file: str, jobs: Mapping[str, str], folder: Path, options: Sequence[str], *config: str) -> None:
    if importlib.util.find_spec("snakemake") is None:
        raise HarnessError("Snakemake is not installed; scripts/mixcontact installs it when it runs this command")
    folder.mkdir(parents=True, exist_ok=True)
    list_ = folder / "jobs.txt"
    list_.write_text(json.dumps(jobs, indent=1))
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(WORKFLOW / file), "--directory", str(folder)]
    command += ["--keep-going", "--rerun-triggers", "mtime", "--rerun-incomplete", "--nolock", "--quiet", "rules"]
    command += [*options, "--config", f"jobs={list_.resolve()}", f"python={sys.executable}", *config]
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY / "scripts")}  # the jobs run in another folder
    subprocess.run(command, env=environment, check=False)
