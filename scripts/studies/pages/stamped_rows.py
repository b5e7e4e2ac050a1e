"""Results as JSON: what they were made with under "stamp", and their rows under "rows"."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from harness.errors import DataFileError
from studies.stamps import Stamp

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Row = TypeVar("Row")


def write(results: DataclassInstance, path: Path) -> None:
    """Write results that have a stamp and rows."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(asdict(results), indent=1) + "\n")


def read(path: Path, row: Callable[..., Row], command: str) -> tuple[Stamp, list[Row]]:
    """Read what `write` wrote: stamp and rows, each made by `row` from its entries.

    Raises
    ------
    DataFileError
        A missing file, or one that holds no such results; it names the command that writes them.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return Stamp(**data["stamp"]), [row(**entries) for entries in data["rows"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(f"{path} holds no results ({error}); `{command}` writes it") from error
