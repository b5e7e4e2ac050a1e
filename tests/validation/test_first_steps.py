"""Each kept model takes its first steps with all of its output."""

from __future__ import annotations

import febio_runs
import pytest
from lxml import etree

from harness.collection import command
from harness.run import engine

pytestmark = pytest.mark.mixture_only

STEPS = 2


@pytest.mark.parametrize("model", sorted(command.SOURCE.glob("*.feb")), ids=lambda path: path.stem)
def test_a_kept_model_takes_its_first_steps(runner, tmp_path, model):
    tree = etree.parse(model)
    for steps in tree.iter("time_steps"):
        steps.text = str(STEPS)
    path = tmp_path / model.name
    tree.write(path, xml_declaration=True, encoding="iso-8859-1")
    report = febio_runs.run(path, plugin=engine.required_plugin(), check=False).report
    assert report.normal, report.errors
    assert report.steps >= STEPS
