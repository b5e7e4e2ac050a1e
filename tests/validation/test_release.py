"""What is released: a model runs with the plugin installed into an empty prefix, and with that of the archive."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import febio_runs
import pytest
import yaml

from harness.errors import PluginNotFoundError
from harness.models.diffusion import Diffusion
from harness.models.interface import InterfaceType
from harness.models.parts import Control
from harness.paths import PLUGIN_NAME, PLUGIN_VARIABLE, REPOSITORY, plugin_library
from harness.run import engine, provenance

pytestmark = pytest.mark.mixture_only
SHARE = Path("share") / "FEBioMixtureContact"


LINES_OF_CHANGES = 40
"""Lines of the changelog of a first release, at most."""


def text_of(name: str) -> str:
    """A file at the root of the repository."""
    return (REPOSITORY / name).read_text(encoding="utf-8")


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
def archive(build, entry_module) -> Path:
    """The archive that `scripts/mixcontact archive` makes of the tested build."""
    if not (entry_module.VENV_BIN / "cpack").exists():
        pytest.skip("needs what `scripts/mixcontact build` sets up")
    entry_module.BUILD = build
    assert entry_module.archive() == 0
    (made,) = (build / "archive").glob("*.tar.gz")
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
    assert {
        "models/diffusion.feb",
        "docs/reference/output.md",
        "LICENSE",
        "CITATION.cff",
        "README.md",
        "febio.xml",
    } <= installed


def test_the_archive_is_named_by_plugin_febio_and_sdk(archive):
    febio = r"febio-\d+\.\d+\.\d+-sdk-\d+\.\d+\.\d+"
    name = rf"FEBioMixtureContact-{re.escape(provenance.plugin_version())}-{febio}-\w+-\w+\.tar\.gz"
    assert re.fullmatch(name, archive.name)


def test_the_archive_has_one_library_and_nothing_of_febios(archive, tmp_path):
    """Models, documentation, licence and this project's own library: no program, header or library of FEBio's."""
    shutil.unpack_archive(archive, tmp_path)
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert [path.name for path in files if path.read_bytes()[:4] == b"\x7fELF"] == [PLUGIN_NAME]
    allowed = {".feb", ".xml", ".md", ".png", ".svg", ".csv", ".json", ".css", ".cff", ".so", ""}
    assert {path.suffix for path in files} <= allowed
    assert [path.name for path in files if path.suffix == ""] == ["LICENSE"]
    ours = {path.name for path in (REPOSITORY / "models").glob("*.feb")}
    assert {path.name for path in files if path.suffix == ".feb"} == ours


def test_the_checksum_is_that_of_the_archive(archive):
    written = archive.with_name(f"{archive.name}.sha256").read_text(encoding="utf-8")
    assert written.split() == [hashlib.sha256(archive.read_bytes()).hexdigest(), archive.name]


def test_version_and_date_are_the_same_everywhere():
    version = provenance.plugin_version()
    head = re.search(rf"^## \[{re.escape(version)}\] - (\S+)$", text_of("CHANGELOG.md"), re.MULTILINE)
    assert head is not None
    citation = yaml.safe_load(text_of("CITATION.cff"))
    assert citation["version"] == version
    assert f"Version {version} (" in text_of("README.md")
    assert head[1] == "unreleased" or str(citation["date-released"]) == head[1]


def test_the_changelog_is_short():
    assert len(text_of("CHANGELOG.md").splitlines()) <= LINES_OF_CHANGES


def test_a_model_runs_with_the_plugin_of_the_archive(archive, tmp_path):
    shutil.unpack_archive(archive, tmp_path)
    (library,) = tmp_path.rglob(PLUGIN_NAME)
    assert febio_runs.run(small_model(tmp_path), plugin=library).report.steps == 3


def test_a_model_of_the_archive_runs_in_a_fresh_directory_by_its_own_febio_xml(archive, tmp_path):
    """Unpack, and call febio4 there."""
    shutil.unpack_archive(archive, tmp_path)
    (root,) = tmp_path.iterdir()
    command = [engine.find_engine(), "-config", SHARE / "febio.xml", "-i", SHARE / "models" / "platens.feb"]
    run = engine.execute([str(part) for part in command], root)
    assert f"Success loading plugin {PLUGIN_NAME}" in run.output
    assert run.report.normal


def test_the_notes_of_a_release_are_its_section_of_the_changelog(tmp_path):
    """The command of the workflow for forks."""
    workflow = (REPOSITORY / ".github" / "workflows" / "release.yml").read_text(encoding="utf-8")
    found = re.search(r"awk -v head=\S+ \S+ '(.*)' CHANGELOG.md", workflow)
    assert found is not None
    log = tmp_path / "CHANGELOG.md"
    log.write_text("# Log\n## [Unreleased]\nnew\n## [0.1.0] - 2026-11-30\nfirst\n### Added\n- all\n## [0.0.9]\nold\n")
    command = ["awk", "-v", "head=## [0.1.0]", found.group(1), str(log)]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "first\n### Added\n- all\n"


def test_febio4_refuses_a_plugin_that_was_built_for_another_release(build, tmp_path):
    """One sentence, and febio4 goes on without the plugin: no crash."""
    library = build / "tests" / "febio" / "misfit_plugin.so"
    if not library.exists():
        pytest.skip("the tests of the build were left out")
    command = engine.command(small_model(tmp_path), library)
    run = engine.execute(command, tmp_path, check=False)
    assert run.output.count("FEBioMixtureContact was built for FEBio 4.0.0 and does not fit") == 1
    assert f"it is release {provenance.engine_version(run.output).removeprefix('FEBio ')}." in run.output
    assert "Reason: Invalid SDK version" in run.output
    assert 'invalid value for attribute "type"' in run.output


def test_an_installed_harness_finds_the_plugin_beside_febio4(tmp_path, monkeypatch):
    monkeypatch.setattr(engine, "is_checkout", lambda: False)
    monkeypatch.delenv(PLUGIN_VARIABLE, raising=False)
    monkeypatch.setattr(engine, "find_engine", lambda: tmp_path / "bin" / "febio4")
    with pytest.raises(PluginNotFoundError, match=PLUGIN_VARIABLE):
        engine.required_plugin()
    library = tmp_path / "lib" / PLUGIN_NAME
    library.parent.mkdir()
    library.touch()
    assert engine.required_plugin() == library


@pytest.mark.slow
def test_pip_installs_the_command_without_a_compiler(build, tmp_path):
    """The libraries are those of the test; the harness and its entry are installed."""
    place = tmp_path / "installed"
    install = [sys.executable, "-m", "pip", "install", "--no-deps", "--quiet", "--target", str(place), str(REPOSITORY)]
    subprocess.run(install, env={**os.environ, "CXX": "false", "CC": "false"}, check=True)
    model = small_model(tmp_path / "model")
    others = os.environ.get("PYTHONPATH", "")
    environment = {**os.environ, "PYTHONPATH": f"{place}{os.pathsep}{others}", PLUGIN_VARIABLE: str(plugin_library())}

    def installed(*arguments: object) -> str:
        command = [sys.executable, *map(str, arguments)]
        done = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    installed(place / "bin" / "mixcontact", "check", model)
    assert "normal termination, 3 steps" in installed(place / "bin" / "mixcontact", "run", model)
    version = "from harness.run import provenance; print(provenance.__file__, provenance.plugin_version())"
    assert installed("-c", version).split() == [
        str(place / "harness" / "run" / "provenance.py"),
        provenance.plugin_version(),
    ]
