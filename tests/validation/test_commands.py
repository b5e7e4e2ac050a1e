"""Every command in README.md and docs/ is executed: as it stands, or in a small version that is stated here.

A command stands in a block marked `console`. The blocks of a page run one after the other in a folder in which
`scripts` and `models` are found, and what else a reader in the checkout would name is filled in.
"""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest

from harness.models.diffusion import Diffusion
from harness.models.interface import InterfaceType
from harness.models.parts import Control
from harness.paths import DOCS, REPOSITORY, plugin_library
from harness.run import engine

PAGES = [REPOSITORY / "README.md", *sorted(DOCS.rglob("*.md"))]
BLOCK = re.compile(r"^( *)```(\w*)\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
VENV = REPOSITORY / ".venv" / "bin"
PROGRAMS = ("scripts/mixcontact", "febio4", "cmake", "cpack", "ctest", "export", "git", "sed", ".ci/run")

SMALL = {
    # What this test is a part of; .ci/run must call it and be a valid script.
    ".ci/run": "bash -n {root}/.ci/run && grep -q 'scripts/mixcontact test' {root}/.ci/run",
    # The whole takes minutes.
    "scripts/mixcontact validate": "scripts/mixcontact validate --only leak --folder results",
    "scripts/mixcontact verification-report": "scripts/mixcontact verification-report --only leak --folder results",
    "scripts/mixcontact report model.feb": "scripts/mixcontact report --help",  # its tests run one
    "scripts/mixcontact gallery --folder docs": "scripts/mixcontact gallery --small --only platens --folder site",
    "scripts/mixcontact gallery --small": "scripts/mixcontact gallery --small --only platens --folder results",
    # Would change the checkout, or the build that other tests use meanwhile.
    "scripts/mixcontact build": "test -x {root}/scripts/mixcontact",
    "scripts/mixcontact pages": "scripts/mixcontact pages --check",
    "scripts/mixcontact docs": "test -f {root}/mkdocs.yml && grep -q 'scripts/mixcontact docs' {root}/.ci/run",
    "cmake --preset default": "cmake -S {root} --preset default -B configured -DMIXCONTACT_BUILD_PLUGIN=OFF",
    "cmake --build --preset default": "cmake --build {build}",
    "ctest --preset default": "ctest --test-dir {build} --no-tests=error -R friction",
    "scripts/mixcontact archive": "cpack --config {build}/CPackConfig.cmake -B packed",
    # Without installing Snakemake: the same command of the harness, or its help where it would make many runs.
    "scripts/mixcontact cost --error 1e-3": "{harness} cost --error 1e-3",
    "scripts/mixcontact cost --error 1e-3 --problem 3.2": "{harness} cost --error 1e-3 --problem 3.2",
    "scripts/mixcontact cost --docs": "{harness} cost --help",
    "scripts/mixcontact biphasic-hertz --folder docs": "{harness} biphasic-hertz --help",
    "scripts/mixcontact elastic-hertz --folder docs": "{harness} elastic-hertz --help",
    "scripts/mixcontact price --docs": "{harness} price --help",
    "scripts/mixcontact price --only effects": "{harness} price --help",
    "scripts/mixcontact friction-cases --docs --no-febio": "{harness} friction-cases --help",
    "scripts/mixcontact friction-benchmarks --folder docs": "{harness} friction-benchmarks --help",
    "scripts/mixcontact friction-cost --folder docs": "{harness} friction-cost --help",
    "scripts/mixcontact knee --docs": "{harness} knee --help",
    "scripts/mixcontact knee --kind porous": "{harness} knee --help",
    "scripts/mixcontact models knee --output knee.feb": "{harness} models knee --size coarse --output knee.feb",
    "scripts/mixcontact ablation --docs": "{harness} ablation --help",
    "scripts/mixcontact hard-cases --docs": "{harness} hard-cases --help",
    "scripts/mixcontact hard-cases --only edge-on-face": "{harness} hard-cases --help",
    "scripts/mixcontact fuzz --minutes 60 --seed 0": "{harness} fuzz --help",
    "scripts/mixcontact agreement --docs": "{harness} agreement --help",
    "scripts/mixcontact agreement --only biphasic": "{harness} agreement --help",
    "scripts/mixcontact synthetic-scenes --collection reported --only crossed-tubes": (
        "{harness} synthetic-scenes --collection reported --only punch-flat-tilts --folder results"
    ),
    # Builds the plugin with sanitizers, which takes minutes.
    "scripts/mixcontact robustness model.feb --only model": "{harness} robustness --help",
    # No network, and no second virtual environment.
    "git clone REPOSITORY FEBioMixtureContact": "git clone -q {root} FEBioMixtureContact",
    "cd FEBioMixtureContact": "cd FEBioMixtureContact && rm -r scripts && ln -s {root}/scripts scripts",
}
"""Small versions, of whole lines."""
PLACES = {
    "/path/to/prefix": "{scratch}/prefix",
    "/path/to/febio": "{febio}",
    "path/to/your/model.feb": "{scratch}/old.feb",
    "path/to/your/model-mixture.feb": "{scratch}/old-mixture.feb",
    "build/lib/libFEBioMixtureContact.so": "{plugin}",
    "--install build ": "--install {build} ",
}
"""What a reader fills in, or finds in the checkout."""


def blocks(page: Path) -> list[str]:
    """The commands of each block of a page."""
    return [
        re.sub(rf"^{indent}", "", body, flags=re.MULTILINE)
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
    """A folder like a checkout, with small models of one's own: before and after the switch."""
    if not VENV.is_dir():
        pytest.skip("needs what `scripts/mixcontact` sets up")
    for name in ("scripts", "models"):
        (tmp_path / name).symlink_to(REPOSITORY / name)
    for name, interface in (("model", InterfaceType.MIXTURE), ("old", InterfaceType.SOLUTE)):
        Diffusion(interface, elements=3, control=Control(3, 200.0), plot=True, name=name).model().write(tmp_path)
    return tmp_path


@pytest.mark.mixture_only
def pages():
    """Every page with commands; the commands of some take less than 2 s of processor time."""
    quick = ("README.md", "first-model.md", "messages.md", "agreement.md", "friction-curves.md")
    slow = {page: [] if page.name in quick else [pytest.mark.slow] for page in PAGES if blocks(page)}
    return [pytest.param(page, marks=marks) for page, marks in slow.items()]


@pytest.mark.parametrize("page", pages(), ids=lambda page: page.name)
def test_the_commands_of_a_page_run(scratch, page):
    plugin, febio = plugin_library().resolve(), engine.find_engine()
    harness = f"env PYTHONPATH={REPOSITORY / 'scripts'} python -m studies"
    places = {
        "root": REPOSITORY,
        "harness": harness,
        "build": plugin.parents[1],
        "plugin": plugin,
        "febio": febio.parents[1],
    }
    environment = {**os.environ, "PATH": os.pathsep.join([str(VENV), str(febio.parent), os.environ["PATH"]])}
    scripts = ["\n".join(small(line) for line in block.splitlines()) for block in blocks(page)]
    for script in dict.fromkeys(scripts):
        command = ["bash", "-e", "-c", script.format(**places, scratch=scratch)]
        done = subprocess.run(command, cwd=scratch, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, "\n".join([command[-1], done.stdout[-2000:], done.stderr[-2000:]])


def test_no_command_stands_outside_of_a_marked_block():
    """So that none is overlooked: lines that begin with one of our programs are in blocks marked `console`."""
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        rest = BLOCK.sub(lambda match: "" if match[2] == "console" else match[0], text)
        odd = [line for line in rest.splitlines() if line.strip().startswith(tuple(f"{name} " for name in PROGRAMS))]
        assert odd == [], page.name


def test_every_small_version_is_of_a_command_that_is_there():
    lines = {line for page in PAGES for block in blocks(page) for line in block.splitlines()}
    assert set(SMALL) <= lines
