"""Many runs, driven by Snakemake: resumable, on local cores or, with its executors, on a cluster; and steps in turn."""

import importlib.util
import json
import os
import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TextIO

from harness.errors import HarnessError
from harness.paths import REPOSITORY
from harness.run.engine import find_engine, required_plugin

SNAKEFILE = REPOSITORY / "scripts" / "workflow" / "Snakefile"
DOES_NOT_HOLD = 1  # exit code of a command that is done, and whose checks do not hold


def run(jobs: Mapping[str, Sequence[str]], folder: Path, *, cores: int = 1, options: Sequence[str] = ()) -> list[Path]:
    """Do what has not been done yet, and return the files that are there afterwards.

    jobs: for each job the arguments of the command that does it; it is given ``--out <folder>/<name>.json`` besides.
    folder: where the results are. One that is older than febio4 or the plugin is made anew.
    cores: jobs at a time.
    options: further options of Snakemake.
    Raises HarnessError without Snakemake, febio4 or the plugin. A job that fails leaves no file, and its log beside
        where it would be.
    """
    if importlib.util.find_spec("snakemake") is None:
        raise HarnessError("Snakemake is not installed; scripts/mixcontact installs it when it runs this command")
    folder.mkdir(parents=True, exist_ok=True)
    list_ = folder / "jobs.txt"
    list_.write_text(json.dumps({name: shlex.join(arguments) for name, arguments in jobs.items()}, indent=1))
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(SNAKEFILE), "--directory", str(folder)]
    command += ["--keep-going", "--rerun-triggers", "mtime", "--rerun-incomplete", "--nolock", "--quiet", "rules"]
    command += ["--cores", str(cores), *options, "--config", f"jobs={list_.resolve()}", f"python={sys.executable}"]
    command.append(f"binaries=[{find_engine()},{required_plugin()}]")
    subprocess.run(command, env=_environment(), check=False)
    return [path for path in (folder / f"{name}.json" for name in jobs) if path.is_file()]


def in_turn(steps: Mapping[str, Sequence[Sequence[str]]], folder: Path) -> set[str]:
    """Do steps of several commands one at a time, the last if all others are done, and return the names of those done.

    steps: for each step the arguments of its commands. A command whose checks do not hold is done.
    folder: where the logs are.
    """
    folder.mkdir(parents=True, exist_ok=True)
    names = list(steps)
    done: set[str] = set()
    for name in names:
        if name == names[-1] and len(done) < len(names) - 1:
            break
        with (folder / f"{name}.log").open("w") as log:
            if all(_is_done(arguments, log) for arguments in steps[name]):
                done.add(name)
    return done


def _is_done(arguments: Sequence[str], log: TextIO) -> bool:
    command = [sys.executable, "-m", "studies", *arguments]
    ended = subprocess.run(command, env=_environment(), stdout=log, stderr=subprocess.STDOUT, check=False)
    return ended.returncode in (0, DOES_NOT_HOLD)


def _environment() -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(REPOSITORY / "scripts")}
