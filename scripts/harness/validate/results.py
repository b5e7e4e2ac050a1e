"""The outcome of a validation as data: what is written to results/ and what pictures are drawn from."""

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from harness.errors import DataFileError
from harness.post.compare import Measure

FORMAT = 1
FILE_NAME = "validation.json"


@dataclass(frozen=True)
class Profile:
    """A simulated curve for a figure."""

    figure: str  # name of the figure, see `harness.validate.figures`
    parameter: float  # time (s) in figure 3.2, Peclet number in figure 3.3
    # Position (mm) and concentration (mM) of each node of a line through both bodies.
    z: list[float]
    c: list[float]


@dataclass
class Results:
    """Everything that a validation found."""

    interface: str  # what joined the bodies
    checks: dict[str, list[Measure]] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)  # checks that could not be made, and why
    profiles: list[Profile] = field(default_factory=list)

    @property
    def missed(self) -> list[Measure]:
        """The measures that miss their tolerance."""
        return [measure for measures in self.checks.values() for measure in measures if not measure.passed]

    def write(self, folder: Path) -> Path:
        """Write ``validation.json`` into `folder` and return its path."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / FILE_NAME
        data = {
            "format": FORMAT,
            "interface": self.interface,
            "checks": {name: measures_as_data(measures) for name, measures in self.checks.items()},
            "left_out": self.left_out,
            "profiles": [asdict(profile) for profile in self.profiles],
        }
        path.write_text(json.dumps(data, indent=1, allow_nan=False))
        return path


def measures_as_data(measures: Sequence[Measure]) -> list[dict[str, Any]]:
    """Measures as data. JSON has no infinity and no nan: such a lower bound is left out, such a value is null."""
    kept = []
    for measure in measures:
        entry = asdict(measure) | {"passed": measure.passed}
        if math.isinf(measure.lowest):
            del entry["lowest"]
        if math.isnan(measure.value):
            entry["value"] = None
        kept.append(entry)
    return kept


def read(path: Path) -> Results:
    """Read what `Results.write` wrote.

    Raises DataFileError: a missing file, or one that is not such a file; names it and what is wrong.
    """
    try:
        data = json.loads(path.read_text())
    except OSError as error:
        raise DataFileError(f"cannot read {path}: {error.strerror}; `validate` writes it") from error
    except json.JSONDecodeError as error:
        raise DataFileError(f"{path}, line {error.lineno}: is not JSON: {error.msg}") from error
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise DataFileError(f"{path}: 'format' must be {FORMAT}; write it again with `validate`")
    try:
        checks = {name: measures_from_data(entries) for name, entries in data["checks"].items()}
        profiles = [Profile(**entry) for entry in data["profiles"]]
        return Results(data["interface"], checks, dict(data["left_out"]), profiles)
    except (KeyError, TypeError, AttributeError) as error:
        raise DataFileError(f"{path}: an entry is missing or unknown ({error}); `validate` writes it again") from error


def measures_from_data(entries: Sequence[dict[str, Any]]) -> list[Measure]:
    """What `measures_as_data` made data of."""
    return [_measure(entry) for entry in entries]


def _measure(entry: dict[str, Any]) -> Measure:
    given = {key: value for key, value in entry.items() if key != "passed"}
    return Measure(**given | {"value": math.nan if given["value"] is None else given["value"]})
