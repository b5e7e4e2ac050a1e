"""Which versions a number comes from."""

from __future__ import annotations

import importlib.metadata
import re
import subprocess
from dataclasses import dataclass

from harness.errors import DataFileError
from harness.paths import REPOSITORY, is_checkout
from harness.run.engine import find_engine

_PROJECT = re.compile(r"^  VERSION (\d+\.\d+\.\d+)$", re.MULTILINE)
_FEBIO = re.compile(r"^\s*version (\d+\.\d+\.\d+)\s*$", re.MULTILINE)


def plugin_version() -> str:
    """Version of the plugin, from CMakeLists.txt; of an installed harness its own, which was read there.

    Raises
    ------
    DataFileError
        Where it does not stand there.
    """
    if not is_checkout():
        return importlib.metadata.version("febio-mixture-contact")
    path = REPOSITORY / "CMakeLists.txt"
    found = _PROJECT.search(path.read_text(encoding="utf-8"))
    if found is None:
        raise DataFileError(f"{path}: no line 'VERSION x.y.z' in project()")
    return found.group(1)


def engine_version(log: str) -> str:
    """What ran a model, from its log: "FEBio 4.11.0", or the embedded engine, which carries the plugin's version."""
    found = _FEBIO.search(log)
    return f"FEBio {found.group(1)}" if found else f"mixture-contact {plugin_version()}"


SOURCES = ("plugin", "cmake", "CMakeLists.txt")
"""What the plugin is built from."""


@dataclass(frozen=True)
class Stamp:
    """What results were made with. Results on one page have one stamp.

    Attributes
    ----------
    plugin : str
        Version of the plugin.
    commit : str
        The last commit that changed its sources, with a + where they were changed since.
    engine : str
        What ran the models.
    limit : float
        s of processor time after which a run was ended; 0 without a limit.
    """

    plugin: str
    commit: str
    engine: str
    limit: float = 0.0

    def __str__(self) -> str:
        """In words, for a page."""
        limit = f", at most {self.limit:g} s of processor time for each run" if self.limit else ""
        return f"{self.engine}, plugin {self.plugin}, one thread{limit}"


def stamp(limit: float = 0.0) -> Stamp:
    """The stamp of what febio4 and the plugin of this checkout give now."""
    said = subprocess.run(
        [find_engine(), "-info"], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL
    )
    return Stamp(plugin_version(), plugin_commit(), engine_version(said.stdout), limit)


def plugin_commit() -> str:
    """The last commit that changed what the plugin is built from, with a + where it was changed since."""
    commit, changed = _git("log", "-1", "--format=%h", "--", *SOURCES), _git("status", "--short", "--", *SOURCES)
    return f"{commit or 'unknown'}{'+' if changed else ''}"


def _git(*arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=REPOSITORY, capture_output=True, text=True, check=False)
    return done.stdout.strip()
