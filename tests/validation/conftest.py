"""Fixtures of the model tests: which interface is tested, and a runner that runs each model once a session.

``MIXCONTACT_INTERFACE`` chooses another contact type than ``sliding-mixture``, to see what FEBio's own interfaces do.
"""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
from pathlib import Path
from types import ModuleType

import febio_runs
import pytest

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.models.interface import InterfaceType
from harness.paths import REPOSITORY
from harness.run import engine
from harness.run.runner import Runner
from harness.validate.checks import Context
from studies.models.small import Document


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "mixture_only: FEBio's own interfaces cannot do this")


@pytest.fixture(scope="session")
def interface() -> InterfaceType:
    """What joins the bodies in this session."""
    return InterfaceType(os.environ.get("MIXCONTACT_INTERFACE", InterfaceType.MIXTURE.value))


@pytest.fixture(scope="module")
def entry_module() -> ModuleType:
    """`scripts/mixcontact` as a module."""
    loader = importlib.machinery.SourceFileLoader("entry", str(REPOSITORY / "scripts" / "mixcontact"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


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


@pytest.fixture
def solve(runner, tmp_path):
    """Runs a document; its folder, and what the run printed. Where it need not end, it may not."""

    def run(name: str, document: Document | str, *, ends: bool = True, options=()):
        folder = tmp_path / name
        folder.mkdir()
        path = folder / "model.feb"
        path.write_text(document if isinstance(document, str) else document.text())
        finished = febio_runs.run(path, plugin=engine.required_plugin(), check=False, options=options)
        assert finished.report.normal or not ends, finished.report.errors
        return folder, finished

    return run
