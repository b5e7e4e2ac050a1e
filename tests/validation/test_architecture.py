"""The contact core by concern: each folder has a purpose, and uses only those before it in the table."""

from __future__ import annotations

import re
from graphlib import TopologicalSorter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORE = ROOT / "plugin" / "contact"
UNIT = ROOT / "tests" / "unit"
HELPERS = ROOT / "plugin" / "solver"
INDEXING = ROOT / "plugin" / "indexing"
"""Below all others: the core and the helpers index alike and know nothing of each other."""
ADAPTER = ROOT / "plugin" / "febio"

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


def floors() -> list[str]:
    """The folders of the README's table, the lowest first."""
    found: list[str] = re.findall(
        r"^\| `(\w+)` \| \S.* \|$", (CORE / "README.md").read_text(encoding="utf-8"), re.MULTILINE
    )
    return found


def sources() -> list[Path]:
    return sorted(path for path in CORE.rglob("*") if path.suffix in (".h", ".cpp"))


def includes(path: Path) -> list[str]:
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def test_every_folder_has_a_purpose_and_every_file_a_folder() -> None:
    assert sorted(floors()) == sorted({path.parent.name for path in sources()})
    assert all(path.parent.parent == CORE for path in sources())


def test_no_folder_uses_one_above_it() -> None:
    height = {folder: floor for floor, folder in enumerate([INDEXING.name, *floors()])}
    arrows_up = [
        f"{path.relative_to(CORE)} includes {name}"
        for path in sources()
        for name in includes(path)
        if height[Path(name).parent.name] > height[path.parent.name]
    ]
    assert arrows_up == []


def test_no_headers_include_each_other_in_a_circle() -> None:
    graph = {str(path.relative_to(CORE)): includes(path) for path in sources()}
    assert list(TopologicalSorter(graph).static_order())  # raises CycleError


def test_unit_tests_stand_in_the_folders_of_the_core() -> None:
    assert {path.parent.name for path in UNIT.rglob("test_*.cpp")} == {*floors(), "host", "solver"}


def test_folders_that_are_named_elsewhere_are_there() -> None:
    """In the order of the guide for developers, which is the other way round, and in what runs under Wine."""
    guide = (ROOT / "docs" / "development" / "code.md").read_text(encoding="utf-8")
    listed = re.search(r"The folders (.*?) of `plugin/contact` each use only those after them", guide, re.DOTALL)
    assert listed is not None
    named = re.findall(r"`(\w+)`", listed[1])
    assert named == [folder for folder in reversed(floors()) if folder in named]
    tested = re.search(r"folders=\((.*?)\)", (ROOT / ".ci" / "run").read_text(encoding="utf-8"))
    assert tested is not None
    assert set(tested[1].split()) <= {path.name for path in UNIT.iterdir()}


def test_what_helps_the_solver_knows_nothing_of_contact() -> None:
    """What connects it with FEBio uses the core's containers and threads."""
    of_others = [
        f"{path.relative_to(HELPERS)} includes {name}"
        for path in sorted(HELPERS.rglob("*"))
        if path.suffix in (".h", ".cpp")
        for name in includes(path)
        if name.split("/")[0] in ("contact", "host", "febio")
        if not (path.parent.name == "febio" and name.startswith("contact/base/"))
    ]
    assert of_others == []


def test_indexing_knows_nothing_of_the_project() -> None:
    assert [name for path in sorted(INDEXING.iterdir()) for name in includes(path)] == []


def test_members_of_febios_solver_are_named_behind_one_interface() -> None:
    member = re.compile(
        r"\b(m_R0|m_R1|m_breshape|m_qnstrategy|m_nups|m_maxups|m_breformAugment|m_ntotref|m_nref|m_maxref"
        r"|m_bforceReform|m_LStol|m_pK|m_ui|QNForceReform|ReformStiffness)\b"
    )
    elsewhere = [
        f"{path.name}: {line.strip()}"
        for path in sorted((ROOT / "plugin").rglob("*"))
        if path.suffix in (".h", ".cpp") and path.parent != HELPERS / "febio"
        for line in path.read_text(encoding="utf-8").splitlines()
        if member.search(line)
    ]
    assert elsewhere == []


def test_the_adapter_names_a_helper_where_it_registers_it_and_nowhere_else() -> None:
    helpers = "Predictor", "NonNegativeConcentrations", "LineSearchGuard"
    lines = [
        line.strip()
        for path in sorted(ADAPTER.iterdir())
        if path.suffix in (".h", ".cpp")
        for line in path.read_text(encoding="utf-8").splitlines()
        if not line.startswith("#include")
    ]
    snake_case = {helper: re.sub(r"(?<!^)([A-Z])", r"_\1", helper).lower() for helper in helpers}
    found = {
        helper: [line for line in lines if re.search(rf"\b(?:{helper}|{switch})\b", line)]
        for helper, switch in snake_case.items()
    }
    assert {helper: len(lines) for helper, lines in found.items()} == dict.fromkeys(helpers, 1), found


FRICTION = re.compile(
    r"\bby_friction<|\bhas_friction\(|[!=]= (?:mixture_contact::)?FrictionKind::none"
    r"|\bfriction\w*\.empty\(\)|\bfriction(?:\.\w+)?\.(?:size|cols|count)\(\) [!=<>]"
)
"""A branch that asks whether a contact has friction."""
ROOMS_OF_FRICTION = re.compile(
    r"contact/conditions/|contact/mortar/(?:slip|trial_variation)|contact/interface/friction_rows"
    r"|contact/enforcement/friction_penalty|host/friction\."
)
"""The files that contain the forms of friction, and the choice between them."""


def test_callers_do_not_ask_whether_a_contact_has_friction() -> None:
    plugin = ROOT / "plugin"
    found = [
        str(path.relative_to(plugin))
        for path in sorted(plugin.rglob("*"))
        if path.suffix in (".h", ".cpp") and not ROOMS_OF_FRICTION.search(str(path.relative_to(plugin)))
        if FRICTION.search(re.sub(r"//[^\n]*", "", path.read_text(encoding="utf-8")))
    ]
    assert found == []
