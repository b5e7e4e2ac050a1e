"""Fixtures of the model tests: which interface is tested, and a runner that runs each model once a session.

``MIXCONTACT_INTERFACE`` chooses another contact type than ``sliding-mixture``, to see what FEBio's own interfaces do.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.models.interface import InterfaceType
from harness.run import engine
from harness.run.runner import Runner
from harness.validate.checks import Context


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "mixture_only: FEBio's own interfaces cannot do this")


@pytest.fixture(scope="session")
def interface() -> InterfaceType:
    """What joins the bodies in this session."""
    return InterfaceType(os.environ.get("MIXCONTACT_INTERFACE", InterfaceType.MIXTURE.value))


@pytest.fixture(autouse=True)
def _can_be_tested(request: pytest.FixtureRequest) -> None:
    if (
        request.node.get_closest_marker("mixture_only")
        and request.getfixturevalue("interface") is not InterfaceType.MIXTURE
    ):
        pytest.skip("only sliding-mixture can do this")


@pytest.fixture(scope="session")
def runner(interface: InterfaceType, runs_folder: Path) -> Runner:
    """Runs models, each once a session."""
    try:
        engine.find_engine()
        if interface is InterfaceType.MIXTURE:
            engine.required_plugin()
    except (EngineNotFoundError, PluginNotFoundError) as error:
        pytest.skip(str(error))
    return Runner(runs_folder)


@pytest.fixture(scope="session")
def context(runner: Runner, interface: InterfaceType) -> Context:
    """What the checks need."""
    return Context(runner, interface)
