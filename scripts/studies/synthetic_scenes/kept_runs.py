"""Runs that are kept beside their models, so that a study that was interrupted goes on where it was."""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path

from studies.pages.scene_results import Took

NAME = "took.json"


def key(model: Path, binaries: Sequence[Path], limit: float) -> str:
    """What decides a run: the files beside its model that are inputs, the programs, and the limit (s)."""
    found = hashlib.sha256(f"{limit:g}".encode())
    for path in sorted(model.parent.glob("*.feb")):
        found.update(path.read_bytes())
    for binary in binaries:
        found.update(_content(binary, binary.stat().st_mtime_ns).encode())
    return found.hexdigest()


@cache
def _content(binary: Path, changed: int) -> str:  # noqa: ARG001 another time of change is another content
    return hashlib.sha256(binary.read_bytes()).hexdigest()


def read(folder: Path, wanted: str) -> Took | None:
    """The run that was kept in a folder under this key, if any."""
    try:
        kept = json.loads((folder / NAME).read_text())
    except (OSError, ValueError):
        return None
    return Took(**kept["took"]) if kept["key"] == wanted else None


def write(took: Took, folder: Path, wanted: str) -> None:
    """Keep a run."""
    (folder / NAME).write_text(json.dumps({"key": wanted, "took": asdict(took)}))
