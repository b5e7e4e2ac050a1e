"""Results as JSON: what they were made with under "stamp", and their rows under "rows"."""

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Generic, TypeVar

from harness.errors import DataFileError
from studies.stamps import Stamp

Row = TypeVar("Row")


@dataclass(frozen=True)
class Stamped(Generic[Row]):
    """Rows of results, and what they were made with."""

    stamp: Stamp
    rows: list[Row]


def write(results: Stamped[Row], path: Path) -> None:
    """Write results, whose rows are dataclasses."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(asdict(results), indent=1) + "\n")


def read(path: Path, row: Callable[..., Row], command: str) -> Stamped[Row]:
    """Read what `write` wrote; each row is made by `row` from its entries.

    Raises DataFileError: a missing file, or one that holds no such results; it names the command that writes them.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return Stamped(Stamp(**data["stamp"]), [row(**entries) for entries in data["rows"]])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(f"{path} holds no results ({error}); `{command}` writes it") from error
