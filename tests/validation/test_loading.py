"""How the plugin comes into febio4, and what it says there."""

from __future__ import annotations

import febio_runs
import pytest

from harness.errors import EngineFailedError
from harness.models.diffusion import Diffusion
from harness.models.interface import InterfaceType
from harness.models.parts import Control
from harness.run import engine, logdata

pytestmark = pytest.mark.mixture_only
SHORT = Control(5, 200.0)


def _model():
    return Diffusion(InterfaceType.MIXTURE, elements=4, control=SHORT, name="loaded").model()


@pytest.fixture
def path(runner, tmp_path):
    return _model().write(tmp_path)


def test_by_import(path):
    finished = febio_runs.run(path, plugin=engine.required_plugin())
    assert "Success loading plugin" in finished.output
    assert finished.report.steps == 5


def test_by_configuration_file(path):
    """An ``<import>`` in febio.xml gives the same run as ``-import``."""
    own, model = path.parent / "own", _model()
    own.mkdir()
    febio_runs.run(model.write(own), plugin=engine.required_plugin())
    configuration = path.parent / "febio.xml"
    configuration.write_text(
        '<?xml version="1.0" encoding="ISO-8859-1"?>\n<febio_config version="3.0">\n'
        '<default_linear_solver type="pardiso"></default_linear_solver>\n'
        f"<import>{engine.required_plugin()}</import>\n</febio_config>\n"
    )
    finished = febio_runs.run(path, options=("-config", str(configuration)))
    assert finished.report.steps == 5
    first, second = (
        logdata.read_history(folder / model.node_file, model.node_columns) for folder in (own, path.parent)
    )
    assert (first.values == second.values).all()


def test_without_the_plugin_febio_says_what_it_does_not_know(path):
    with pytest.raises(EngineFailedError, match=r'tag "contact" .* attribute "type"'):
        febio_runs.run(path)


def test_the_log_says_which_effects_are_active(path):
    finished = febio_runs.run(path, plugin=engine.required_plugin())
    line = next(line for line in finished.output.splitlines() if "exchanges" in line)
    assert "sliding-mixture" in line
    for effect in ("traction", "solvent", "solute 1"):
        assert effect in line
