"""Asks every rule about every contact of a model."""

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from harness.preflight import model as models
from harness.preflight.finding import Finding, Severity
from harness.preflight.rules import ON_PHYSICS, ON_SURFACES, ON_TEXT, Rule, ties
from harness.preflight.sides import Joint
from harness.preflight.xml_file import AS_THEY_ARE, Contents

UNREADABLE = ("bad-value", "load-curve")  # rules after which the values of the contact cannot be used
BROKEN = (
    *("empty-surface", "facet-of-no-element", "flat-facet", "no-material", "inverted-facets"),
    *("shell-facets", "self-contact"),
)
"""Rules after which the geometry of the contact cannot be used, or is not known here."""
_ORDER = list(Severity)


def check(path: Path, instead: Contents = AS_THEY_ARE) -> list[Finding]:
    """Findings of a model file, the worst first; what `instead` has is read in place of files.

    Raises ModelError where the file cannot be read.
    """
    found: list[Finding] = []
    model = models.read(path, instead)
    for contact in model.contacts:
        found += _ask(Joint(model, contact), (ON_TEXT, ON_SURFACES, ON_PHYSICS))
    for tie in model.ties:
        found += _ask(Joint(model, tie), (ties.ON_TEXT, ties.ON_SURFACES, ties.ON_PHYSICS))
    unique = list(dict.fromkeys(found))
    return sorted(unique, key=lambda finding: _ORDER.index(finding.severity))


def _ask(joint: Joint, rounds: Sequence[Sequence[Rule]]) -> list[Finding]:
    """Rules in three rounds; what needs a part that a former round found broken is not asked."""
    found: list[Finding] = []
    for rules, breaking in zip(rounds, (UNREADABLE, BROKEN, ()), strict=True):
        found += [finding for rule in rules for finding in rule(joint)]
        if any(finding.rule in breaking for finding in found):
            break
    return found


def matter(findings: Iterable[Finding]) -> bool:
    """Whether there is more than notes."""
    return any(finding.severity is not Severity.NOTE for finding in findings)


def as_json(path: Path, findings: Iterable[Finding]) -> str:
    """The findings for scripts."""
    return json.dumps({"model": str(path), "findings": [finding.as_json() for finding in findings]}, indent=2)


def summary(findings: Iterable[Finding]) -> str:
    """How many of each kind: "1 error, 2 warnings"."""
    counts = Counter(finding.severity for finding in findings)
    parts = [f"{counts[kind]} {kind.value}{'s' if counts[kind] > 1 else ''}" for kind in Severity if counts[kind]]
    return ", ".join(parts) or "nothing found"
