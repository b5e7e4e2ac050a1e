"""What measured results were made with, and the limit of processor time that the runs of all comparisons have."""

import subprocess
from dataclasses import dataclass

from harness.paths import REPOSITORY
from harness.run.engine import find_engine
from harness.run.provenance import engine_version, plugin_version

LIMIT = 300.0  # s of processor time for one run, the same for all interfaces in all studies
NEARLY = 0.9
"""Part of the limit from which on a run that did not end normally is taken to have been ended by it: the system ends
one within a few hundredths of it, and what fails by itself seldom does so just then."""


def at_limit(ended: bool, cpu: float, limit: float | None = LIMIT) -> bool:
    """Whether the limit (s) ended a run that took so much processor time (s).

    That febio4 wrote no summary says nothing: it writes none either where it stops at an error or crashes.
    """
    return not ended and limit is not None and cpu >= NEARLY * limit


SOURCES = ("plugin", "cmake", "CMakeLists.txt")  # what the plugin is built from


@dataclass(frozen=True)
class Stamp:
    """What results were made with. Results on one page have one stamp."""

    plugin: str  # version of the plugin
    commit: str  # the last commit that changed its sources, with a + where they were changed since
    engine: str  # what ran the models
    limit: float = 0.0  # s of processor time after which a run was ended; 0 without a limit

    def __str__(self) -> str:
        """In words, for a page."""
        if not self.limit:
            return f"{self.engine}, plugin {self.plugin} and one thread"
        limit = f"at most {self.limit:g} s of processor time for each run"
        return f"{self.engine}, plugin {self.plugin}, one thread, and {limit}"


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
