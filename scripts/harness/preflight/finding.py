"""What `check` has to say: where, how bad, and what to do."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from pathlib import Path


class Severity(str, Enum):
    """How bad a finding is."""

    ERROR = "error"
    """The run will stop, or the contact will not do what the file says."""
    WARNING = "warning"
    """The run may fail, or its answer is not what it seems."""
    NOTE = "note"
    """Worth knowing; nothing has to change."""


@dataclass(frozen=True)
class Place:
    """A tag in a file.

    Attributes
    ----------
    file : Path
    line : int
        From 1; where the tag begins.
    tag : str
        As in the file, with the attribute that tells it from its like: ``<contact name="joint">``.
    """

    file: Path
    line: int
    tag: str

    def __str__(self) -> str:
        return f"{self.file}, line {self.line}: {self.tag}"


@dataclass(frozen=True)
class Finding:
    """One thing found.

    Attributes
    ----------
    severity : Severity
    rule : str
        Name of the rule, as in docs/reference/check.md.
    place : Place
    message : str
        What was seen and what it will do, in plain words.
    suggestion : str
        What to change, with a value where there is one.
    """

    severity: Severity
    rule: str
    place: Place
    message: str
    suggestion: str

    def as_json(self) -> dict[str, str | int]:
        """The finding for scripts."""
        return {
            "severity": self.severity.value,
            "rule": self.rule,
            "file": str(self.place.file),
            "line": self.place.line,
            "tag": self.place.tag,
            "message": self.message,
            "suggestion": self.suggestion,
        }
