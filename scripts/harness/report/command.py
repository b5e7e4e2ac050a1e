"""The command `report`."""

from importlib import import_module
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.errors import HarnessError
from harness.run.command import run

console = Console(highlight=False, soft_wrap=True)


def report(
    model: Annotated[Path, typer.Argument(help="A .feb file; its log and plot file are in the same folder.")],
    output: Annotated[
        Path | None, typer.Option(help="Write the page to this folder; the default is MODEL-report next to the model.")
    ] = None,
    first: Annotated[bool, typer.Option("--run", help="Run the model first.")] = False,
) -> None:
    """Make a page about the contact of a run: pressure on the deformed surfaces, curves over time, settings, warnings.

    The page is one file, index.html, which opens from disk. Its folder also contains the pictures as PNG files, and the
    contact surfaces at the time of the largest force as VTK files for PyVista and ParaView.
    """
    try:
        contents, page = (import_module(f"harness.report.{name}") for name in ("contents", "page"))
    except ImportError as error:
        raise HarnessError(
            f"`report` needs pyfebio and PyVista, and Python 3.11 or newer ({error}); "
            "`pip install 'febio-mixture-contact[report]'` installs them"
        ) from error
    if first:
        run(model)
    folder = output or model.with_name(f"{model.stem}-report")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise HarnessError(f"{folder}: {error.strerror}; --output takes a folder") from error
    console.print(str(page.write(contents.make(model, folder), folder)))
