"""Where things stand in the repository."""

from __future__ import annotations

import os
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
MODELS = REPOSITORY / "models"
DOCS = REPOSITORY / "docs"
RESULTS = REPOSITORY / "results"
PLUGIN_NAME = "libFEBioMixtureContact.so"
PLUGIN_VARIABLE = "FEBIO_MIXTURE_PLUGIN"


def plugin_library() -> Path:
    """Path of the plugin library: ``$FEBIO_MIXTURE_PLUGIN`` if set, else the one a build leaves in build/lib.

    Returns
    -------
    Path
        Where the library is expected; it need not exist.
    """
    chosen = os.environ.get(PLUGIN_VARIABLE)
    return Path(chosen) if chosen else REPOSITORY / "build" / "lib" / PLUGIN_NAME
