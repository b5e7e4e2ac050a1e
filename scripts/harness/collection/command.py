"""The command that writes the collection in models/."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from harness.collection import kept_models as collection
from harness.errors import HarnessError
from harness.paths import MODELS

console = Console(highlight=False, soft_wrap=True)


def models(
    folder: Annotated[Path, typer.Option(help="Where the .feb files go.")] = MODELS,
    check: Annotated[bool, typer.Option("--check", help="Write nothing; fail where a file is not up to date.")] = False,
) -> None:
    """Write the .feb files of the collection."""
    if check:
        old = collection.outdated(folder)
        if old:
            raise HarnessError(
                f"not what the generator writes: {', '.join(old)} in {folder}; `models` writes them anew"
            )
        return
    for path in collection.write(folder):
        console.print(str(path))
