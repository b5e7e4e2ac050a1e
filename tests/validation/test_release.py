"""What is released: a model runs with the plugin installed into an empty prefix, and with that of the archive."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from harness.models.diffusion import Diffusion
from harness.models.interface import InterfaceType
from harness.models.parts import Control
from harness.paths import PLUGIN_NAME, plugin_library
from harness.run import engine, provenance

pytestmark = pytest.mark.mixture_only
SHARE = Path("share") / "FEBioMixtureContact"


def tool(name: str, *arguments: object) -> str:
    """Runs cmake or cpack and returns what it printed."""
    program = shutil.which(name)
    if program is None:
        pytest.skip(f"{name} is not on the PATH; `scripts/mixcontact test` puts it there")
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def build(runner) -> Path:
    """The build that the tested plugin comes from."""
    return plugin_library().resolve().parents[1]


@pytest.fixture(scope="module")
def prefix(build, tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("prefix")
    tool("cmake", "--install", build, "--prefix", place)
    return place


@pytest.fixture(scope="module")
def archive(build, tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("archive")
    tool("cpack", "--config", build / "CPackConfig.cmake", "-B", place)
    (made,) = place.glob("*.tar.gz")
    return made


def small_model(folder: Path) -> Path:
    return Diffusion(InterfaceType.MIXTURE, elements=3, control=Control(3, 200.0)).model().write(folder)


def test_a_model_runs_with_the_installed_febio_xml(prefix, tmp_path):
    """Nothing of the build is used: febio4 loads the plugin that the installed febio.xml names."""
    model = small_model(tmp_path)
    command = [engine.find_engine(), "-config", prefix / SHARE / "febio.xml", "-i", model.name]
    run = engine.execute([str(part) for part in command], tmp_path)
    assert run.report.steps == 3
    assert f"Success loading plugin {PLUGIN_NAME}" in run.output


def test_the_installed_library_does_not_depend_on_the_checkout(prefix, build):
    (library,) = prefix.rglob(PLUGIN_NAME)
    assert str(build.parent).encode() not in library.read_bytes()


def test_models_and_licence_are_installed(prefix):
    installed = {str(path.relative_to(prefix / SHARE)) for path in (prefix / SHARE).rglob("*")}
    assert {"models/diffusion.feb", "LICENSE", "CITATION.cff", "README.md", "febio.xml"} <= installed


def test_the_archive_is_named_by_plugin_and_sdk(archive):
    name = rf"FEBioMixtureContact-{re.escape(provenance.plugin_version())}-febio-sdk-\d+\.\d+\.\d+-\w+-\w+\.tar\.gz"
    assert re.fullmatch(name, archive.name)


def test_a_model_runs_with_the_plugin_of_the_archive(archive, tmp_path):
    shutil.unpack_archive(archive, tmp_path)
    (library,) = tmp_path.rglob(PLUGIN_NAME)
    assert engine.run(small_model(tmp_path), plugin=library).report.steps == 3
    (configuration,) = tmp_path.rglob("febio.xml")
    assert "<import>/path/to/" in configuration.read_text()
