"""Every command in README.md and docs/ is executed: as it stands, or in a small version that is stated here.

A command stands in a block marked `console`. Each block runs in a folder of its own, in which `scripts` is found, and
what else a reader in the checkout would name is filled in.
"""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest

from harness import engine
from harness.models.diffusion import Diffusion
from harness.models.interface import Join
from harness.models.parts import Control
from harness.paths import DOCS, REPOSITORY, plugin_library

PAGES = [REPOSITORY / "README.md", *sorted(DOCS.glob("*.md"))]
BLOCK = re.compile(r"^( *)```(\w*)\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
PROGRAMS = ("scripts/mixcontact", "febio4", "cmake", "cpack", "ctest", "export", "git", "sed", ".ci/run")

SMALL = {
    # What this test is a part of; .ci/run must call it and be a valid script.
    "scripts/mixcontact test": "test -x {root}/scripts/mixcontact",
    ".ci/run": "bash -n {root}/.ci/run && grep -q 'scripts/mixcontact test' {root}/.ci/run",
    # The whole takes minutes.
    "scripts/mixcontact validate": "scripts/mixcontact validate --only leak --folder results",
    "scripts/mixcontact report": "scripts/mixcontact report --only leak --folder results",
    "scripts/mixcontact gallery --folder docs": "scripts/mixcontact gallery --small --only platens --folder site",
    "scripts/mixcontact gallery --small": "scripts/mixcontact gallery --small --only platens --folder results",
    # Would change the checkout, or the build that other tests use meanwhile.
    "scripts/mixcontact pages": "scripts/mixcontact pages --check",
    "scripts/mixcontact docs": "test -f {root}/mkdocs.yml && grep -q 'scripts/mixcontact docs' {root}/.ci/run",
    "cmake --preset default": "cmake -S {root} --preset default -B configured -DMIXCONTACT_BUILD_PLUGIN=OFF",
    "cmake --build --preset default": "cmake --build {build}",
    "ctest --preset default": "ctest --test-dir {build} --no-tests=error -R laws",
    "cpack --config build/CPackConfig.cmake": "cpack --config {build}/CPackConfig.cmake -B packed",
    # No network, and no second virtual environment.
    "git clone <address of this repository> FEBioMixtureContact": "git clone -q {root} FEBioMixtureContact",
    "cd FEBioMixtureContact": "cd FEBioMixtureContact && rm -r scripts && ln -s {root}/scripts scripts",
}
"""Small versions, of whole lines."""
PLACES = {
    "/path/to/prefix": "{scratch}/prefix",
    "/path/to/febio": "{febio}",
    "path/to/your/model.feb": "{scratch}/model.feb",
    "build/lib/libFEBioMixtureContact.so": "{plugin}",
    "--install build ": "--install {build} ",
}
"""What a reader fills in, or finds in the checkout."""


def blocks() -> list[tuple[str, str]]:
    """Page and commands of every block."""
    return [
        (page.name, re.sub(rf"^{indent}", "", body, flags=re.MULTILINE))
        for page in PAGES
        for indent, language, body in BLOCK.findall(page.read_text(encoding="utf-8"))
        if language == "console"
    ]


def small(line: str) -> str:
    """A line as it is executed, with places still to be filled in."""
    line = SMALL.get(line, line)
    if re.fullmatch(r"scripts/mixcontact validate --only [\w-]+", line):
        line = "scripts/mixcontact validate --only closed-forms --folder results"
    if re.fullmatch(r"scripts/mixcontact run models/[\w-]+\.feb", line):
        line = "scripts/mixcontact run {scratch}/model.feb"
    for written, meant in PLACES.items():
        line = line.replace(written, meant)
    return line


@pytest.fixture
def scratch(runner, tmp_path) -> Path:
    """A folder like a checkout, with a small model of one's own."""
    if not (REPOSITORY / ".venv").is_dir():
        pytest.skip("needs what `scripts/mixcontact` sets up")
    (tmp_path / "scripts").symlink_to(REPOSITORY / "scripts")
    Diffusion(Join.MIXTURE, elements=3, control=Control(3, 200.0), plot=True, name="model").model().write(tmp_path)
    return tmp_path


@pytest.mark.mixture_only
@pytest.mark.parametrize(("page", "commands"), sorted(set(blocks())), ids=lambda text: text.splitlines()[0][:60])
def test_a_block_of_commands_runs(scratch, page, commands):
    plugin, febio = plugin_library().resolve(), engine.find_engine()
    places = {"root": REPOSITORY, "build": plugin.parents[1], "plugin": plugin, "scratch": scratch}
    lines = [small(line).format(**places, febio=febio.parents[1]) for line in commands.splitlines()]
    path = os.pathsep.join([str(REPOSITORY / ".venv" / "bin"), str(febio.parent), os.environ["PATH"]])
    done = subprocess.run(
        ["bash", "-e", "-c", "\n".join(lines)],
        cwd=scratch,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, "\n".join([*lines, done.stdout[-2000:], done.stderr[-2000:]])


def test_no_command_stands_outside_of_a_marked_block():
    """So that none is overlooked: lines that begin with one of our programs are in blocks marked `console`."""
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        rest = BLOCK.sub(lambda match: "" if match[2] == "console" else match[0], text)
        odd = [line for line in rest.splitlines() if line.strip().startswith(tuple(f"{name} " for name in PROGRAMS))]
        assert odd == [], page.name


def test_every_small_version_is_of_a_command_that_is_there():
    lines = {line for _, commands in blocks() for line in commands.splitlines()}
    assert set(SMALL) <= lines
