"""The harness and the studies are houses of rooms: a file imports from its own room and from lower ones alone.

The studies import the harness, which users install, and the harness imports no study.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import Counter
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from harness.paths import REPOSITORY
from harness.user_commands import FOR_EVERYBODY

SCRIPTS = REPOSITORY / "scripts"
ROOMS = {
    "harness": (
        *(
            "errors",
            "paths",
            "choice",
            "arrays",
            "closed_forms",
            "models",
            "preflight",
            "conversion",
            "run",
            "post",
            "report",
        ),
        *("ecosystem", "indentation", "validate", "collection", "user_commands"),
    ),
    "studies": (
        *("stamps", "options", "feb", "files", "tables", "timing", "diagnosis", "workflow"),
        *("closed_forms", "models", "post"),
        *("engines", "pages", "hard_cases", "fuzz", "cost", "friction", "price"),
        *("synthetic_scenes", "agreement", "ablation", "robustness", "one_answer", "hertz", "linear_solvers", "knees"),
        *("run_tables", "evidence", "cli", "site", "__main__"),
    ),
}
"""Folders and files directly in each package, the lowest first."""
ROLES = {"__init__", "command", "figures", "page"}
"""Names of files that say what a file is to its room, and so may stand in several rooms."""
ON_DEMAND = ("harness.report.contents", "harness.report.page", "harness.ecosystem.pyfebio_contact")
"""Modules that `report` and users import by their names, since not everybody installs what they need."""
MOST_FILES = 12
"""Files directly in a package."""


def modules(root: Path) -> dict[str, Path]:
    """Files of all packages by their dotted names."""
    return {".".join(path.relative_to(root).with_suffix("").parts): path for path in sorted(root.glob("*/**/*.py"))}


def imports(path: Path, known: set[str]) -> set[str]:
    """Modules of the packages that a file imports, inside functions too."""
    packages = {name.split(".")[0] for name in known}
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {name.name for name in node.names if name.name.split(".")[0] in packages}
        elif isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] in packages:
            below = [f"{node.module}.{name.name}" for name in node.names]
            found |= {name if name in known else node.module for name in below}
    return {name if name in known else f"{name}.__init__" for name in found}


def graph(root: Path) -> dict[str, set[str]]:
    """What each module imports."""
    files = modules(root)
    return {name: imports(path, set(files)) for name, path in files.items()}


def upward(found: dict[str, set[str]], package: str) -> list[str]:
    """Imports within a package from a room into a higher one."""
    rooms = ROOMS[package]

    def floor(name: str) -> int | None:
        first, _, rest = name.partition(".")
        room = rest.split(".")[0]
        return rooms.index(room) if first == package and room in rooms else None

    arrows = ((one, other, floor(one), floor(other)) for one, others in found.items() for other in sorted(others))
    return [f"{a} -> {b}" for a, b, low, high in arrows if low is not None and high is not None and low < high]


def into_studies(found: dict[str, set[str]]) -> list[str]:
    """Imports from what users install into studies."""
    of_users = {name: others for name, others in found.items() if name.startswith("harness.")}
    return [f"{a} -> {b}" for a, others in of_users.items() for b in sorted(others) if b.startswith("studies.")]


def cycle(found: dict[str, set[str]]) -> list[str]:
    """The modules of an import cycle, if there is one."""
    try:
        TopologicalSorter(found).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_no_import_cycle():
    assert cycle(graph(SCRIPTS)) == []


def test_no_arrow_up():
    found = graph(SCRIPTS)
    assert sum(map(len, found.values())) > 300
    for package in ROOMS:
        assert upward(found, package) == []


def test_users_install_no_study():
    assert into_studies(graph(SCRIPTS)) == []
    settings = (REPOSITORY / "pyproject.toml").read_text(encoding="utf-8")
    assert '[tool.hatch.build.targets.wheel]\npackages = ["scripts/harness"]\n' in settings


def test_every_file_of_a_user_is_reached():
    """What no command for users imports stands beside them, with the studies."""
    found = graph(SCRIPTS)
    reached, left = set(), ["harness.user_commands", *FOR_EVERYBODY.values(), *ON_DEMAND]
    while left:
        name = left.pop()
        if name not in reached:
            reached.add(name)
            left += found[name]
    unused = {name for name in found if name.startswith("harness.") and not name.endswith("__init__")} - reached
    assert unused == set()


@pytest.mark.parametrize("package", ROOMS)
def test_every_file_is_in_a_declared_room(package):
    names = {name.split(".")[1] for name in modules(SCRIPTS) if name.startswith(f"{package}.")}
    assert names - {"__init__"} == set(ROOMS[package])
    assert len(list((SCRIPTS / package).glob("*.py"))) <= MOST_FILES


@pytest.mark.parametrize("package", ROOMS)
def test_one_name_means_one_thing(package):
    files = [name.split(".") for name in modules(SCRIPTS)]
    names = Counter(parts[-1] for parts in files if parts[0] == package)
    assert [name for name, count in names.items() if count > 1 and name not in ROLES] == []


FOLDERS = sorted({path.parent for package in ROOMS for path in (SCRIPTS / package).rglob("*.py")})


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda path: path.name)
def test_every_package_says_what_it_is_for(folder):
    said = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""
    first = said.splitlines()[0] if said else ""
    assert len(first.split()) > 3
    assert first.endswith(".")


def test_a_cycle_and_an_arrow_up_are_seen(tmp_path):
    """The test of this test: two rooms that import each other, and a room that imports a study."""
    for name, line in {
        "harness/models/mesh.py": "def late():\n    from harness.run import engine\n",
        "harness/run/engine.py": "from harness.models.mesh import late\nfrom studies.cost import page\n",
        "harness/run/__init__.py": "",
        "harness/models/__init__.py": "",
        "studies/cost/page.py": "",
    }.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.write_text(line)
    found = graph(tmp_path)
    assert upward(found, "harness") == ["harness.models.mesh -> harness.run.engine"]
    assert set(cycle(found)) == {"harness.models.mesh", "harness.run.engine"}
    assert into_studies(found) == ["harness.run.engine -> studies.cost.page"]


# ---- which tests are quick ----


def test_ci_runs_all_tests_and_every_file_has_quick_ones():
    assert "scripts/mixcontact test" in (REPOSITORY / ".ci" / "run").read_text(encoding="utf-8")
    command = [
        sys.executable,
        "-m",
        "pytest",
        "--collect-only",
        "-q",
        "-p",
        "no:cacheprovider",
        "-m",
        "not slow",
        "tests",
    ]
    listed = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=True).stdout
    quick = {line.split("::")[0] for line in listed.splitlines() if line.startswith("tests/")}
    assert quick == {str(path.relative_to(REPOSITORY)) for path in (REPOSITORY / "tests").rglob("test_*.py")}
