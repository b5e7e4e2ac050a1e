"""Reads from febio4's log how each attempt at a time step went, and what made it fail."""

import math
import re
from collections import Counter
from dataclasses import dataclass
from enum import Enum

_BEGIN = re.compile(r"^===== beginning time step \d+ : (\S+) =====", re.MULTILINE)
_RESIDUAL = re.compile(r"^\t +residual +(\S+) +(\S+) +(\S+)", re.MULTILINE)
"""FEBio's line begins with a tab, that of the contact's table of times does not."""
_FIELD = re.compile(
    r"^\s+(energy|displacement|fluid pressure|solute \d+ concentration|concentration) +(\S+) +(\S+) +(\S+)",
    re.MULTILINE,
)
_SEARCH = re.compile(r"step from line search +=\s*(\S+)")
_ERROR = re.compile(r"^ \* +ERROR +\*\n((?:\s\*.*\*\n)+)", re.MULTILINE)
TAIL = 8  # iterations at the end of an attempt from which its failure is judged


class FailureMode(str, Enum):
    """Why an attempt at a time step failed."""

    NONE = "converged"
    NAN = "not a number"
    JACOBIAN = "negative Jacobian"
    SEARCH = "line search stalls"
    CHATTER = "residual alternates"
    DIVERGES = "residual grows"
    SLOW = "no convergence"
    UNFINISHED = "ended from outside"


@dataclass(frozen=True)
class Attempt:
    """One attempt at a time step."""

    time: float  # where the step was to end, s
    residuals: tuple[float, ...]  # squared norm after each Newton iteration
    searches: tuple[float, ...]  # factor of the line search in each iteration
    unmet: tuple[str, ...]  # norms that still missed their tolerance in the last iteration
    converged: bool
    error: str  # FEBio's own words

    @property
    def failure_mode(self) -> FailureMode:
        """What made it fail."""
        if self.converged:
            return FailureMode.NONE
        if "NAN" in self.error or any(map(math.isnan, self.residuals)):
            return FailureMode.NAN
        if "jacobian" in self.error.lower():
            return FailureMode.JACOBIAN
        if not self.error:
            return FailureMode.UNFINISHED
        return self._habit()

    def _habit(self) -> FailureMode:
        """What the last iterations of an attempt that ran out of them look like."""
        searches, residuals = self.searches[-TAIL:], self.residuals[-TAIL:]
        if searches and sorted(searches)[len(searches) // 2] < 0.5:
            return FailureMode.SEARCH
        turns = sum((b - a) * (c - b) < 0.0 for a, b, c in zip(residuals, residuals[1:], residuals[2:], strict=False))
        if turns >= TAIL // 2 and max(residuals) > 2.0 * min(residuals):
            return FailureMode.CHATTER
        return FailureMode.DIVERGES if residuals and residuals[-1] > 10.0 * self.residuals[0] else FailureMode.SLOW


def attempts(log: str) -> list[Attempt]:
    """Every attempt at a time step, in order.

    log: the text of the log, or what febio4 printed.
    """
    starts = list(_BEGIN.finditer(log))
    ends = [match.start() for match in starts[1:]] + [len(log)]
    return [_attempt(float(start.group(1)), log[start.end() : end]) for start, end in zip(starts, ends, strict=True)]


def _attempt(time: float, text: str) -> Attempt:
    errors = [" ".join(re.findall(r"[^\s*]+", body)) for body in _ERROR.findall(text)]
    residuals = tuple(float(match[1]) for match in _RESIDUAL.findall(text))
    last = text[text.rfind("convergence norms") :] if "convergence norms" in text else ""
    unmet = tuple(name for name, _, now, needed in _FIELD.findall(last) if not float(now) <= float(needed))
    converged = "------- converged at time" in text
    return Attempt(time, residuals, tuple(map(float, _SEARCH.findall(text))), unmet, converged, "; ".join(errors))


def summary(log: str) -> str:
    """How the failed attempts of a run failed, most frequent first, and how the last one ended."""
    made = attempts(log)
    failed = [attempt for attempt in made if not attempt.converged]
    if not failed:
        return "no failed attempt"
    counts = Counter(attempt.failure_mode.value for attempt in failed)
    text = ", ".join(f"{name} x {count}" for name, count in counts.most_common())
    if made[-1].converged:
        return text
    last = made[-1]
    still = f" (unmet: {', '.join(last.unmet)})" if last.unmet else ""
    return f"{text}; the last, to t = {last.time:.4g} s: {last.failure_mode.value}{still}"
