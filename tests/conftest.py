"""Fixtures shared by the model tests: a runner of models with the plugin loaded; and the order of the tests."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.run import engine
from harness.run.runner import Runner


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Those that take long begin, so that none of them is left for one process at the end."""
    items.sort(key=_turn)


def _turn(item: pytest.Item) -> int:
    slow = item.get_closest_marker("slow")
    if slow is None:
        return 2
    return 0 if slow.kwargs.get("longest", False) else 1


@pytest.fixture(scope="session")
def runs_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where runs are kept: one folder, also where several processes share the session."""
    base = tmp_path_factory.getbasetemp()
    return (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "runs"


@pytest.fixture(scope="session")
def runner(runs_folder: Path) -> Runner:
    """Runs models, each once a session."""
    try:
        engine.find_engine()
        engine.required_plugin()
    except (EngineNotFoundError, PluginNotFoundError) as error:
        pytest.skip(str(error))
    return Runner(runs_folder)
