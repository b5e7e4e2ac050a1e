"""What `check` has to say: where, how bad, and what to do."""

from dataclasses import dataclass
from enum import Enum
from functools import partial

from harness.preflight.byte_spans import Place
from harness.preflight.xml_file import Element, place


class Severity(str, Enum):
    """How bad a finding is."""

    ERROR = "error"  # the run will stop, or the contact will not do what the file says
    WARNING = "warning"  # the run may fail, or its answer is not what it seems
    NOTE = "note"  # worth knowing; nothing has to change


@dataclass(frozen=True)
class Finding:
    """One thing found."""

    severity: Severity
    rule: str  # name of the rule, as in docs/reference/check.md
    place: Place
    message: str  # what was seen and what it will do, in plain words
    suggestion: str  # what to change, with a value where there is one

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


def _found(severity: Severity, rule: str, tag: Element, message: str, suggestion: str) -> Finding:
    return Finding(severity, rule, place(tag), message, suggestion)


error, warning, note = (partial(_found, severity) for severity in Severity)


def short(value: float) -> str:
    """A number with two significant digits, with an exponent where it is very small or large."""
    return f"{float(f'{value:.2g}'):.6g}"


def percent(part: float) -> str:
    """A part as a percentage: two significant digits above 1 %, one below."""
    return f"{100.0 * part:.2g} %"
