"""The plugin in the FEBios of FEBIO_ROOTS: it runs where it was built for, and is refused without a crash elsewhere."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

from harness.models.diffusion import Diffusion
from harness.models.interface import InterfaceType
from harness.models.parts import Control
from harness.paths import plugin_library
from harness.run import engine

pytestmark = pytest.mark.mixture_only
ROOTS = [Path(root) for root in os.environ.get("FEBIO_ROOTS", "").split(os.pathsep) if root]


def versions(headers: Path) -> list[str]:
    """Numbers of the SDK and of the release."""
    texts = [(headers / name / "version.h").read_text(encoding="utf-8") for name in ("FECore", "FEBioLib")]
    return [number for text in texts for number in re.findall(r"#define \w*VERSION\s+(\d+)\s*$", text, re.MULTILINE)]


def own_headers() -> Path:
    """Of the FEBio that the plugin was built for."""
    cache = plugin_library().resolve().parents[1] / "CMakeCache.txt"
    found = re.search(r"^FEBio_INCLUDE_DIR:PATH=(.*)$", cache.read_text(encoding="utf-8"), re.MULTILINE)
    assert found is not None
    return Path(found.group(1))


@pytest.mark.parametrize("root", ROOTS, ids=lambda root: root.name)
def test_it_runs_in_its_own_febio_and_is_refused_by_others(root, runner, tmp_path):
    model = Diffusion(InterfaceType.MIXTURE, elements=3, control=Control(3, 200.0)).model().write(tmp_path)
    command = [str(root / "bin" / "febio4"), "-i", model.name, "-import", str(engine.required_plugin())]
    run = engine.execute(command, tmp_path, check=False)
    if versions(root / "include") == versions(own_headers()):
        assert run.report.normal
        return
    assert run.output.count("Failed loading plugin") == 1
    assert run.output.count("Reason: ") == 1
    assert run.output.count("FEBioMixtureContact was built for") <= 1
    # febio4 goes on, and finds that it does not know the contact.
    assert 'invalid value for attribute "type"' in run.output
