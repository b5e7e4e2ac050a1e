"""The harness is a house of rooms, one above the other: a file imports from its own room and from lower ones alone."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections import Counter
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

from harness.paths import REPOSITORY

HARNESS = REPOSITORY / "scripts" / "harness"
ROOMS = (
    *("errors", "paths", "closed_forms", "models", "preflight", "conversion", "run", "post", "report", "ecosystem"),
    *("indentation", "validate", "pages", "studies", "user_commands", "cli", "site", "__main__"),
)
"""Folders and files directly in the harness, the lowest first."""
STUDIES = (
    "files",
    "limit",
    "timing",
    "hard_cases",
    "fuzz",
    "cost",
    "friction",
    "predictor",
    "price",
    "synthetic_scenes",
    "agreement",
    "ablation",
    "robustness",
    "one_answer",
    "hertz",
    "knees",
    "linear_solvers",
    "remeasurement",
)
"""Rooms within studies, the lowest first."""
ROLES = {"__init__", "command", "figures", "page"}
"""Names of files that say what a file is to its room, and so may stand in several rooms."""
MOST_FILES = 12
"""Files directly in the harness."""


def modules(root: Path) -> dict[str, Path]:
    """Files by their dotted names below `harness`."""
    return {".".join(path.relative_to(root).with_suffix("").parts): path for path in sorted(root.rglob("*.py"))}


def imports(path: Path, known: set[str]) -> set[str]:
    """Modules of the harness that a file imports, inside functions too."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {name.name.removeprefix("harness.") for name in node.names if name.name.startswith("harness.")}
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "harness":
            base = str(node.module).removeprefix("harness").lstrip(".")
            below = [f"{base}.{name.name}".lstrip(".") for name in node.names]
            found |= {name if name in known else base for name in below}
    return {name if name in known else f"{name}.__init__" for name in found}


def graph(root: Path) -> dict[str, set[str]]:
    """What each module imports."""
    files = modules(root)
    return {name: imports(path, set(files)) for name, path in files.items()}


def upward(found: dict[str, set[str]], rooms: tuple[str, ...], depth: int = 0) -> list[str]:
    """Imports from a room into a higher one."""

    def floor(name: str) -> int | None:
        parts = name.split(".")
        return rooms.index(parts[depth]) if len(parts) > depth and parts[depth] in rooms else None

    arrows = ((one, other, floor(one), floor(other)) for one, others in found.items() for other in sorted(others))
    return [f"{a} -> {b}" for a, b, low, high in arrows if low is not None and high is not None and low < high]


def cycle(found: dict[str, set[str]]) -> list[str]:
    """The modules of an import cycle, if there is one."""
    try:
        TopologicalSorter(found).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_no_import_cycle():
    assert cycle(graph(HARNESS)) == []


def test_no_arrow_up():
    found = graph(HARNESS)
    assert sum(map(len, found.values())) > 300
    assert upward(found, ROOMS) == []
    studies = {name: others for name, others in found.items() if name.startswith("studies.")}
    assert upward(studies, STUDIES, depth=1) == []


def test_every_file_is_in_a_declared_room():
    assert {name.split(".")[0] for name in modules(HARNESS)} - {"__init__"} == set(ROOMS)
    assert len(list(HARNESS.glob("*.py"))) <= MOST_FILES
    assert {path.stem for path in (HARNESS / "studies").glob("[!_]*")} == set(STUDIES)


def test_one_name_means_one_thing():
    names = Counter(name.rpartition(".")[2] for name in modules(HARNESS))
    assert [name for name, count in names.items() if count > 1 and name not in ROLES] == []


@pytest.mark.parametrize("folder", sorted({path.parent for path in HARNESS.rglob("*.py")}), ids=lambda path: path.name)
def test_every_package_says_what_it_is_for(folder):
    said = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""
    first = said.splitlines()[0] if said else ""
    assert len(first.split()) > 3
    assert first.endswith(".")


def test_a_cycle_and_an_arrow_up_are_seen(tmp_path):
    """The test of this test: two rooms that import each other."""
    for name, line in {
        "models/mesh.py": "def late():\n    from harness.run import engine\n",
        "run/engine.py": "from harness.models.mesh import late\n",
        "run/__init__.py": "",
        "models/__init__.py": "",
    }.items():
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(line)
    found = graph(tmp_path)
    assert upward(found, ROOMS) == ["models.mesh -> run.engine"]
    assert set(cycle(found)) == {"models.mesh", "run.engine"}


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
