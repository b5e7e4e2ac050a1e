"""Where things stand: in the repository, or where the harness is installed without it."""

import os
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
DOCS = REPOSITORY / "docs"
PLUGIN_VARIABLE = "MIXCONTACT_PLUGIN"
PLUGIN_NAME = {"win32": "FEBioMixtureContact.dll", "darwin": "libFEBioMixtureContact.dylib"}.get(
    sys.platform, "libFEBioMixtureContact.so"
)


def is_checkout() -> bool:
    """Whether this is the repository, not an installation by pip."""
    return (REPOSITORY / "CMakeLists.txt").is_file()


def command_name() -> str:
    """What a user types before a command."""
    return "scripts/mixcontact" if is_checkout() else "mixcontact"


_OUTPUT = REPOSITORY if is_checkout() else Path()
MODELS = _OUTPUT / "models"
RESULTS = _OUTPUT / "results"


def plugin_library() -> Path:
    """Where the plugin is expected: ``$MIXCONTACT_PLUGIN`` if set, else what a build leaves in build/lib."""
    chosen = os.environ.get(PLUGIN_VARIABLE)
    return Path(chosen) if chosen else REPOSITORY / "build" / "lib" / PLUGIN_NAME
