"""Which versions a number comes from."""

import importlib.metadata
import re

from harness.errors import DataFileError
from harness.paths import REPOSITORY, is_checkout

_PROJECT = re.compile(r"^  VERSION (\d+\.\d+\.\d+)$", re.MULTILINE)
_FEBIO = re.compile(r"^\s*version (\d+\.\d+\.\d+)\s*$", re.MULTILINE)


def plugin_version() -> str:
    """Version of the plugin, from CMakeLists.txt; of an installed harness its own, which was read there.

    Raises DataFileError where it does not stand there.
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
