"""The embedded engine, and which engine runs the models: febio4 with the plugin, the embedded one, or both."""

import os
from collections.abc import Sequence
from enum import Enum
from pathlib import Path

from harness.errors import EngineFailedError, EngineNotFoundError, PluginNotFoundError
from harness.models.interface import InterfaceType
from harness.paths import REPOSITORY
from harness.run import engine

EXECUTABLE_VARIABLE = "MIXTURE_CONTACT_STANDALONE"
"""Environment variable that names another executable than the one of the build."""


def find_standalone() -> Path:
    """The executable: ``$MIXTURE_CONTACT_STANDALONE`` if set, else the one that a build leaves in build/bin.

    Raises EngineNotFoundError where there is none.
    """
    chosen = os.environ.get(EXECUTABLE_VARIABLE)
    executable = Path(chosen) if chosen else REPOSITORY / "build" / "bin" / "mixture-contact"
    if not (executable.is_file() and os.access(executable, os.X_OK)):
        raise EngineNotFoundError(f"the embedded engine {executable} does not exist; build it first.")
    return executable.resolve()


class Standalone:
    """Runs models with the embedded engine."""

    name = "standalone"

    def binaries(self, plugin: bool) -> tuple[Path, ...]:  # noqa: ARG002 - the contact is built in
        return (find_standalone(),)

    def command(self, model: Path, plugin: bool, options: Sequence[str] = ()) -> list[str]:  # noqa: ARG002
        """As `Host.command`. Raises EngineFailedError where there are options: those of febio4 mean nothing here."""
        if options:
            raise EngineFailedError(f"the embedded engine does not know the options {' '.join(options)} of febio4")
        return [str(find_standalone()), model.name]


FEBIO4: engine.Host = engine.Febio4()
STANDALONE: engine.Host = Standalone()


class Engine(str, Enum):
    """What a user may choose."""

    FEBIO4 = "febio4"
    STANDALONE = "standalone"
    BOTH = "both"


def engines(chosen: Engine | None, interface: InterfaceType) -> tuple[engine.Host, ...]:
    """The engines that run models with this interface; without a choice febio4, or the embedded one if it cannot."""
    if chosen is not None:
        return {Engine.FEBIO4: (FEBIO4,), Engine.STANDALONE: (STANDALONE,), Engine.BOTH: (FEBIO4, STANDALONE)}[chosen]
    able = interface in (InterfaceType.MIXTURE, InterfaceType.CONFORMING)
    return (STANDALONE,) if able and why_not_febio(interface) and _is_there(STANDALONE) else (FEBIO4,)


def why_not_febio(interface: InterfaceType) -> str:
    """Why febio4 cannot run models with this interface; empty if it can."""
    try:
        FEBIO4.binaries(plugin=interface.needs_plugin)
    except (EngineNotFoundError, PluginNotFoundError) as error:
        return str(error)
    return ""


def _is_there(host: engine.Host) -> bool:
    try:
        host.binaries(plugin=True)
    except EngineNotFoundError:
        return False
    return True
