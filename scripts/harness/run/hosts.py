"""Which engine runs the models: febio4 with the plugin, the embedded one, or both."""

from enum import Enum

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.models.interface import InterfaceType
from harness.run import engine
from harness.run.standalone import Standalone

FEBIO4: engine.Host = engine.Febio4()
STANDALONE: engine.Host = Standalone()


class Engine(str, Enum):
    """What a user may choose."""

    FEBIO4 = "febio4"
    STANDALONE = "standalone"
    BOTH = "both"


def engines(chosen: Engine | None, interface: InterfaceType) -> tuple[engine.Host, ...]:
    """The engines that run models with this interface; without a choice febio4, or the embedded one if it cannot."""
    if chosen is Engine.BOTH:
        return (FEBIO4, STANDALONE)
    if chosen is Engine.FEBIO4:
        return (FEBIO4,)
    if chosen is Engine.STANDALONE:
        return (STANDALONE,)
    if (
        interface in (InterfaceType.MIXTURE, InterfaceType.CONFORMING)
        and why_not_febio(interface)
        and _is_there(STANDALONE)
    ):
        return (STANDALONE,)
    return (FEBIO4,)


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
