"""The console of the commands, and options that several of them have."""

import os
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

console = Console(highlight=False, soft_wrap=True)
TWO_AT_MOST = min(2, os.cpu_count() or 1)  # simultaneous runs

Limit = Annotated[float, typer.Option(help="Limit each run to this processor time [s].")]
Timeout = Annotated[float, typer.Option(help="Limit each run to this wall time [s].")]
Jobs = Annotated[int, typer.Option(min=1, help="Number of simultaneous runs.")]
Docs = Annotated[bool, typer.Option("--docs", help="Also write the page of the documentation.")]
Folder = Annotated[Path, typer.Option(help="Write results to this folder.")]
Site = Annotated[Path, typer.Option(help="Write data and picture to this folder; `docs` for the site.")]
Snakemake = Annotated[list[str] | None, typer.Argument(help="Options for Snakemake, after --.")]
