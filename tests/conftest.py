"""Fixtures shared by the model tests: a runner of models with the plugin loaded."""

from __future__ import annotations

from pathlib import Path

import pytest

from harness.errors import EngineNotFoundError, PluginNotFoundError
from harness.run import engine
from harness.run.runner import Runner


@pytest.fixture(scope="session")
def runner(tmp_path_factory: pytest.TempPathFactory) -> Runner:
    """Runs models, each once a session."""
    try:
        engine.find_engine()
        engine.required_plugin()
    except (EngineNotFoundError, PluginNotFoundError) as error:
        pytest.skip(str(error))
    return Runner(Path(tmp_path_factory.getbasetemp()) / "runs")
