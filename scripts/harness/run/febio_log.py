"""Reads what febio4 prints: how far it came, how hard that was, and what it complained about."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

CONVERGED = re.compile(r"------- converged at time : (\S+)")
_RETRY = re.compile(r"^Retrying time step\.", re.MULTILINE)
_AUGMENTATION = re.compile(r"^\.{20,} augmentation # \d+", re.MULTILINE)
_GRAND_TOTAL = "N O N L I N E A R   I T E R A T I O N   S U M M A R Y"
_COUNTS = {
    "steps": re.compile(r"Number of time steps completed [ .]*: (\d+)"),
    "iterations": re.compile(r"Total number of equilibrium iterations [ .]*: (\d+)"),
    "residuals": re.compile(r"Total number of right hand evaluations [ .]*: (\d+)"),
    "reformations": re.compile(r"Total number of stiffness reformations [ .]*: (\d+)"),
}
_FATAL = re.compile(r"FATAL ERROR:?\s*(.+)")
_BOX = re.compile(r"^\s\*+\n((?:\s\*.*\*\n)+?)\s\*+$", re.MULTILINE)


@dataclass(frozen=True)
class Report:
    """The outcome of one run."""

    normal: bool  # whether febio4 wrote "N O R M A L   T E R M I N A T I O N"
    # Completed time steps, Newton iterations, residual evaluations and matrix reformations over the whole run, those of
    # failed attempts included.
    steps: int
    iterations: int
    residuals: int
    reformations: int
    # Time steps tried again, and augmentations done.
    retries: int
    augmentations: int
    errors: tuple[str, ...] = ()  # FEBio's error texts
    warnings: tuple[str, ...] = ()  # FEBio's warnings, each once


def parse(text: str) -> Report:
    """Read the log, or the screen output, of a run.

    Without a summary (a run that was killed, a model that was never read), the counts are those of what is there, or 0.
    """
    boxes = _boxes(text)
    return Report(
        normal="N O R M A L   T E R M I N A T I O N" in text,
        retries=len(_RETRY.findall(text)),
        augmentations=len(_AUGMENTATION.findall(text)),
        errors=(
            *_unique(body for title, body in boxes if title == "ERROR"),
            *_unique(map(str.strip, _FATAL.findall(text))),
        ),
        warnings=_unique(body for title, body in boxes if title == "WARNING"),
        **_counts(text),
    )


def _counts(text: str) -> dict[str, int]:
    """Counts summed over the analysis steps; a grand total, which FEBio adds to several of them, is left out."""
    place = text.find(_GRAND_TOTAL)
    own = text if place < 0 else text[:place]
    found = {name: sum(map(int, pattern.findall(own))) for name, pattern in _COUNTS.items()}
    if not _COUNTS["steps"].search(own):
        found["steps"] = len(CONVERGED.findall(text))
    return found


def _boxes(text: str) -> list[tuple[str, str]]:
    found: list[tuple[str, str]] = []
    for match in _BOX.finditer(text):
        lines = [line.strip().strip("*").strip() for line in match.group(1).splitlines()]
        said = [line for line in lines if line]
        if said:
            found.append((said[0], " ".join(said[1:])))
    return found


def _unique(texts: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(texts))
