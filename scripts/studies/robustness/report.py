"""The table of findings."""

from collections.abc import Sequence
from pathlib import Path

from studies import files, tables
from studies.robustness.trial import Finding

_HEAD = ("model", "variation", "ended", "steps", "retries", "difference", "faults")


def table(findings: Sequence[Finding]) -> str:
    """A Markdown table, a row for each variation of each model."""
    return tables.markdown(_HEAD, map(_row, findings))


def _row(found: Finding) -> tuple[str, ...]:
    difference = "" if found.difference is None else f"{found.difference:.1e}"
    said = "; ".join([*(f"**{fault}**" for fault in found.faults), *filter(None, [found.note])])
    return (found.model, found.variation, found.ended, str(found.steps), str(found.retries), difference, said)


def summary(findings: Sequence[Finding]) -> str:
    """How many there are, and how many have a fault."""
    faulty = [found for found in findings if not found.passed]
    models = len({found.model for found in findings})
    return f"{len(findings)} variations of {models} models: {len(faulty) or 'none'} with a fault."


def write(findings: Sequence[Finding], folder: Path) -> list[Path]:
    """Write the table and the same as JSON, and return the paths."""
    folder.mkdir(parents=True, exist_ok=True)
    text, data = folder / "robustness.md", folder / "robustness.json"
    text.write_text(f"{summary(findings)}\n\n{table(findings)}\n")
    files.write_json(findings, data)
    return [text, data]
