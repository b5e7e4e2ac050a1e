"""Hundreds of independent runs, driven by Snakemake: resumable, on local cores or, with its executors, on a cluster."""

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

SNAKEFILE = REPOSITORY / "scripts" / "workflow" / "Snakefile"


def run(jobs: Mapping[str, Sequence[str]], folder: Path, *, cores: int = 1, options: Sequence[str] = ()) -> list[Path]:
    """Do what has not been done yet, and return the files that are there afterwards.

    Parameters
    ----------
    jobs : mapping
        For each job the arguments of the harness that do it; it is given ``--out <folder>/<name>.json`` besides.
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
    if importlib.util.find_spec("snakemake") is None:
        raise HarnessError("Snakemake is not installed; scripts/mixcontact installs it when it runs this command")
    folder.mkdir(parents=True, exist_ok=True)
    list_ = folder / "jobs.txt"
    list_.write_text(json.dumps({name: shlex.join(arguments) for name, arguments in jobs.items()}, indent=1))
    config = {
        "jobs": list_.resolve(),
        "binaries": f"[{find_engine()},{required_plugin()}]",
        "python": sys.executable,
    }
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(SNAKEFILE), "--directory", str(folder)]
    command += ["--cores", str(cores), "--keep-going", "--rerun-triggers", "mtime", "--rerun-incomplete", "--nolock"]
    command += ["--quiet", "rules", *options, "--config", *(f"{key}={value}" for key, value in config.items())]
    environment = {**os.environ, "PYTHONPATH": str(REPOSITORY / "scripts")}  # the jobs run in another folder
    subprocess.run(command, env=environment, check=False)
    return [path for path in (folder / f"{name}.json" for name in jobs) if path.is_file()]
