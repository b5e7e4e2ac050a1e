"""How rules make their findings."""

from __future__ import annotations

from harness.preflight.finding import Finding, Severity
from harness.preflight.xml_file import Element, place


def error(rule: str, tag: Element, message: str, suggestion: str) -> Finding:
    """The run will stop, or the contact will not do what the file says."""
    return Finding(Severity.ERROR, rule, place(tag), message, suggestion)


def warning(rule: str, tag: Element, message: str, suggestion: str) -> Finding:
    """The run may fail, or its answer is not what it seems."""
    return Finding(Severity.WARNING, rule, place(tag), message, suggestion)


def note(rule: str, tag: Element, message: str, suggestion: str) -> Finding:
    """Worth knowing."""
    return Finding(Severity.NOTE, rule, place(tag), message, suggestion)


def short(value: float) -> str:
    """A number with two significant digits, with an exponent where it is very small or large."""
    return f"{float(f'{value:.2g}'):.6g}"


def percent(part: float) -> str:
    """A part as a percentage: two significant digits above 1 %, one below."""
    return f"{100.0 * part:.2g} %"
