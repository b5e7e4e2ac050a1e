"""Files of measured data, a frozen dataclass of plain values per row, as JSON or as a table; and of pictures."""

import csv
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Generic, TypeVar, get_type_hints

from matplotlib.figure import Figure

from harness.errors import DataFileError
from studies.stamps import Stamp

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

Row = TypeVar("Row", bound="DataclassInstance")


def write_json(data: Sequence[Row], path: Path) -> None:
    """Write data."""
    path.write_text(json.dumps([asdict(datum) for datum in data], indent=1))


def read_json(path: Path, kind: type[Row]) -> list[Row]:
    """Read what `write_json` wrote."""
    return [kind(**entry) for entry in json.loads(path.read_text())]


@dataclass(frozen=True)
class Stamped(Generic[Row]):
    """Rows of results, and what they were made with."""

    stamp: Stamp
    rows: list[Row]


def write_stamped(results: Stamped[Row], path: Path) -> None:
    """Write results, whose rows are dataclasses."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(asdict(results), indent=1) + "\n")


def read_stamped(path: Path, row: Callable[..., Row], command: str) -> Stamped[Row]:
    """Read what `write_stamped` wrote; each row is made by `row` from its entries.

    Raises DataFileError: a missing file, or one that holds no such results; it names the command that writes them.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return Stamped(Stamp(**data["stamp"]), [row(**entries) for entries in data["rows"]])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(f"{path} holds no results ({error}); `{command}` writes it") from error


def write_csv(data: Sequence[Row], kind: type[Row], path: Path, stamp: Stamp) -> None:
    """Write data of a kind as a table, with their stamp in its first line, in a folder that is made where needed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        file.write(f"# {json.dumps(asdict(stamp))}\n")
        rows = csv.writer(file, lineterminator="\n")
        names = [field.name for field in fields(kind)]
        rows.writerow(names)
        for datum in data:
            values = asdict(datum)
            rows.writerow([f"{v:.6g}" if isinstance(v, float) else v for v in (values[name] for name in names)])


def read_csv(path: Path, kind: type[Row]) -> list[Row]:
    """Read what `write_csv` wrote. Raises DataFileError: a missing file, or one of another form."""
    try:
        with path.open() as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        return [_row(row, kind) for row in rows]
    except (OSError, KeyError, ValueError) as error:
        raise DataFileError(f"{path} is no table of {kind.__name__} ({error})") from error


def _row(row: dict[str, str], kind: type[Row]) -> Row:
    kinds: dict[type, Callable[[str], object]] = {str: str, int: int, float: float, bool: "True".__eq__}
    return kind(**{name: kinds[type_](row[name]) for name, type_ in get_type_hints(kind).items()})


def save_figure(figure: Figure, path: Path) -> Path:
    """Save a picture, as SVG without its date, in a folder that is made where needed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    return path
