"""The embedded engine: mixture-contact, which runs models where FEBio is not installed."""

import os
from collections.abc import Sequence
from pathlib import Path

from harness.errors import EngineFailedError, EngineNotFoundError
from harness.paths import REPOSITORY

EXECUTABLE_VARIABLE = "MIXTURE_CONTACT_STANDALONE"
"""Environment variable that names another executable than the one of the build."""


def find() -> Path:
    """The executable: ``$MIXTURE_CONTACT_STANDALONE`` if set, else the one that a build leaves in build/bin.

    Raises EngineNotFoundError where there is none.
    """
    chosen = os.environ.get(EXECUTABLE_VARIABLE)
    executable = Path(chosen) if chosen else REPOSITORY / "build" / "bin" / "mixture-contact"
    if not (executable.is_file() and os.access(executable, os.X_OK)):
        raise EngineNotFoundError(f"the embedded engine {executable} does not exist; build it first.")
    return executable.resolve()


class Standalone:
    """Runs models with the embedded engine; see `harness.run.engine.Host`."""

    name = "standalone"

    def binaries(self, plugin: bool) -> tuple[Path, ...]:  # noqa: ARG002 - the contact is built in
        """The files that decide what a run gives."""
        return (find(),)

    def command(self, model: Path, plugin: bool, options: Sequence[str] = ()) -> list[str]:  # noqa: ARG002
        """The command line that runs a model file from its own folder.

        Raises EngineNotFoundError: no executable.
        Raises EngineFailedError: options: those of febio4 mean nothing here.
        """
        if options:
            raise EngineFailedError(f"the embedded engine does not know the options {' '.join(options)} of febio4")
        return [str(find()), model.name]
