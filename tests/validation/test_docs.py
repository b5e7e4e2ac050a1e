"""The documentation and the code say the same: output variables, links, map. Needs neither FEBio nor a build."""

from __future__ import annotations

import re
import subprocess
import textwrap
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from harness.preflight.rules.settings import RENAMED

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES = sorted([*ROOT.glob("*.md"), *DOCS.rglob("*.md"), *(ROOT / "plugin").rglob("*.md")])
OUTPUT_PAGE = (DOCS / "reference" / "output.md").read_text(encoding="utf-8")
OUTPUT = (ROOT / "plugin" / "febio" / "output_variables.cpp").read_text(encoding="utf-8")

VECTORS = "MeanOfNodes"
"""Name of the classes that `offer_vector_logs` registers, component by component."""
CODE = re.compile(r"^```.*?^```|^ {4,}\S.*?$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")


def section(page: str, title: str) -> str:
    """The text below a heading, up to the next one of any level."""
    found = re.search(rf"^#+ {re.escape(title)}\n(.*?)(?=^#|\Z)", page, re.MULTILINE | re.DOTALL)
    assert found, f"no heading '{title}'"
    return found.group(1)


def first_column(text: str) -> list[str]:
    """First cells of all table rows that begin with a code word."""
    return re.findall(r"^\| (`.+?) \|", text, re.MULTILINE)


def names(cell: str) -> list[str]:
    """Names in a cell; "`x 1` to `x 8`" stands for all eight, "`v.x` (`.y`, `.z`)" for three components."""
    found: list[str] = re.findall(r"`([^`]+)`", re.sub(r"`([^`]+)\.x` \(`\.y`, `\.z`\)", r"`\1.x` `\1.y` `\1.z`", cell))
    if " to " not in cell:
        return found
    stem, first = found[0].rsplit(" ", 1)
    last = found[1].removeprefix(stem)
    return [f"{stem} {number}" for number in range(int(first), int(last) + 1)]


def listed(text: str) -> list[str]:
    return [name for cell in first_column(text) for name in names(cell)]


def offered(classes: str) -> list[str]:
    """Names that output_variables.cpp registers for classes whose name starts so, solutes counted."""
    plain = re.findall(rf'^  offer<{classes}\w*(?:<[^;]*?>)?>\("([^"]+)"\)', OUTPUT, re.MULTILINE)
    per_solute = re.findall(rf'\(offer<{classes}\w*<[^;]*?>>\(named\("([^"]+)", solutes\)', OUTPUT)
    solutes = re.search(r"logged_solutes = (\d+)", OUTPUT)
    assert solutes
    vectors = re.findall(r'^  offer_vector_logs<.*?>\("([^"]+)"\)', OUTPUT, re.MULTILINE) if VECTORS in classes else []
    plain += [f"{name}.{axis}" for name in vectors for axis in "xyz"]
    return plain + [f"{name} {number}" for name in per_solute for number in range(1, int(solutes.group(1)) + 1)]


def anchors(page: Path) -> set[str]:
    """Anchors of the headings, as GitHub makes them, and those that a page keeps for older links."""
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    titles = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    named = re.findall(r'^<a id="([\w-]+)"></a>$', text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-") for title in titles} | set(named)


def links() -> list[tuple[Path, str]]:
    found = []
    for page in PAGES:
        text = CODE.sub("", page.read_text(encoding="utf-8"))
        found += [(page, target) for target in LINK.findall(text) if not re.match(r"[a-z]+:", target)]
    return found


@pytest.mark.parametrize(
    ("classes", "title", "part"),
    [
        ("FEPlot", "Plot file", slice(0, None)),
        ("FELog(?:Bonds|ContactForce|Flow|FrictionForce|FrictionPower)", "Log file", slice(0, 1)),
        ("FELog(?:Facet|MeanOfNodes)", "Log file", slice(1, 2)),
    ],
    ids=["plot", "surface_data", "face_data"],
)
def test_the_output_tables_are_complete(classes, title, part):
    tables = re.split(r"(?=^`face_data`)", section(OUTPUT_PAGE, title), flags=re.MULTILINE)
    documented = listed("".join(tables[part]))
    assert len(documented) >= 5
    assert sorted(documented) == sorted(offered(classes))


def test_no_output_variable_is_overlooked():
    total = len(re.findall(r"offer<FE", OUTPUT))
    plain = len(re.findall(r'offer<FE[^;]*?>\("', OUTPUT))
    per_solute = len(re.findall(r'offer<FE[^;]*?>\(named\("', OUTPUT))
    components = len(re.findall(r'offer<FE[^;]*?>\(name \+ "\.[xyz]"\)', OUTPUT))
    assert total == plain + per_solute + components


OF_FEBIO_ALONE = {"penalty_sf", "max_penalty_sf", "dxtol", "fric_penalty", "ktmult"}
"""Parameters of FEBio's types that `sliding-mixture` does not have."""


def test_migration_covers_every_parameter():
    page = (DOCS / "reference" / "from-febio.md").read_text(encoding="utf-8")
    new = set(names(re.search(r"^New: (.+)$", page, re.MULTILINE).group(1)))  # type: ignore[union-attr]
    covered = set(listed(section(page, "Parameter by parameter"))) - OF_FEBIO_ALONE
    assert covered | new == set(listed((DOCS / "reference" / "parameters.md").read_text(encoding="utf-8"))) - set(
        RENAMED
    )
    assert not covered & new


@pytest.mark.parametrize(("page", "target"), links(), ids=lambda value: getattr(value, "name", value))
def test_relative_links_lead_somewhere(page, target):
    path, _, anchor = target.partition("#")
    goal = (page.parent / path).resolve() if path else page
    assert goal.exists()
    if anchor:
        assert anchor in anchors(goal)


SOURCES = ("plugin/", "tests/", "scripts/", "docs/", "models/", "cmake/", ".github/", ".ci/")
SUFFIXES = (".h", ".cpp", ".py")


def alternatives(name: str) -> list[str]:
    """`facet.{h,cpp}` as two names."""
    found = re.fullmatch(r"(.*)\{([\w,]+)\}(.*)", name)
    return [f"{found[1]}{one}{found[3]}" for one in found[2].split(",")] if found else [name]


def named_files() -> list[tuple[Path, str]]:
    """Names in code of files in this repository, from its root or from a folder below it."""
    found = []
    for page in PAGES:
        for word in re.findall(r"(?<!`)`([^`\s]+)`", page.read_text(encoding="utf-8")):
            names = [name for name in alternatives(word) if name.startswith(SOURCES) or name.endswith(SUFFIXES)]
            found += [(page, name) for name in names if not re.search(r"[*<>=()]", name)]
    return found


def files_of_the_repository() -> list[str]:
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return listed.splitlines()


def test_files_that_pages_name_are_there():
    """From the root, or from a folder below it where that is plain."""
    paths = [f"/{name}" for name in files_of_the_repository()]
    lost = [
        f"{page.relative_to(ROOT)}: {name}"
        for page, name in named_files()
        if not (ROOT / name).exists() and not any(path.endswith(f"/{name}") for path in paths)
    ]
    assert len(named_files()) > 50
    assert lost == []


INVENTED = {"FacetType::tri10", "FEPlotSolventPower"}
"""Names that the worked examples add."""


def test_names_of_the_code_on_pages_for_developers_are_in_the_code():
    pages = [ROOT / "CONTRIBUTING.md", ROOT / "plugin" / "contact" / "README.md", *(DOCS / "development").glob("*.md")]
    code = " ".join(
        (ROOT / name).read_text(encoding="utf-8")
        for name in files_of_the_repository()
        if name.endswith(SUFFIXES) and (ROOT / name).exists()
    )
    known = set(re.findall(r"\w+", code))
    for page in pages:
        names = set(re.findall(r"(?<!`)`([A-Z]\w*[a-z]\w*(?:::\w+)*)(?:\(\))?`", page.read_text(encoding="utf-8")))
        assert [name for name in names - INVENTED if not set(name.split("::")) <= known] == [], page.name


def examples(language: str) -> list[tuple[str, str]]:
    """Blocks of code in a language, with the name of their page."""
    fence = re.compile(rf"^( *)```{language}\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
    return [
        (page.relative_to(ROOT).as_posix(), textwrap.dedent(body))
        for page in PAGES
        for _, body in fence.findall(page.read_text(encoding="utf-8"))
    ]


@pytest.mark.parametrize(("page", "text"), examples("xml"))
def test_examples_of_model_files_are_well_formed(page, text):
    assert len(ET.fromstring(f"<example>{text}</example>")) > 0, page


@pytest.mark.parametrize(("page", "text"), examples("xml"))
def test_parameters_in_examples_are_those_of_the_contact(page, text):
    """Children of a contact of this type, and lines of parameters that stand alone."""
    known = set(listed((DOCS / "reference" / "parameters.md").read_text(encoding="utf-8")))
    contacts = ET.fromstring(f"<example>{text}</example>").iter("contact")
    given = {child.tag for contact in contacts if contact.get("type") == "sliding-mixture" for child in contact}
    assert given <= known, page


@pytest.mark.parametrize(("page", "text"), examples("python"))
def test_examples_in_python_compile(page, text):
    compile(text, page, "exec")


def commands_on_pages() -> set[tuple[str, str, str]]:
    """Page, command and options of each call of `scripts/mixcontact`, in blocks and in lines."""
    call = re.compile(r"scripts/mixcontact ([a-z][a-z-]*)([^`\n|;,.]*)")
    return {
        (page.relative_to(ROOT).as_posix(), command, rest)
        for page in PAGES
        for command, rest in call.findall(page.read_text(encoding="utf-8"))
    }


def test_commands_and_options_on_pages_are_there():
    """By the page of the commands, which is written from them, and by the text of the entry."""
    entry = (ROOT / "scripts" / "mixcontact").read_text(encoding="utf-8")
    known = set(
        re.findall(r"[a-z][a-z-]+", " ".join(re.findall(r"^  ((?:[a-z-]+, )*[a-z-]+)  +\S", entry, re.MULTILINE)))
    )
    options = set(re.findall(r"--[a-z-]+", entry + (DOCS / "reference" / "commands.md").read_text(encoding="utf-8")))
    found = commands_on_pages()
    assert len(found) > 50
    assert [call for call in found if call[1] not in known] == []
    assert [call for call in found if not set(re.findall(r"--[a-z-]+", call[2])) <= options] == []


def test_every_page_is_on_the_map():
    """And in the navigation of the site."""
    index, site = (path.read_text(encoding="utf-8") for path in (DOCS / "index.md", ROOT / "mkdocs.yml"))
    for page in DOCS.rglob("*.md"):
        name = page.relative_to(DOCS).as_posix()
        assert name == "index.md" or f"]({name})" in index
        assert re.search(rf"(: |- ){re.escape(name)}$", site, re.MULTILINE), name


LONGEST = 1500
"""Words on a page."""


@pytest.mark.parametrize("page", [page for page in DOCS.rglob("*.md") if page.parent.name != "reference"], ids=str)
def test_a_page_can_be_read_in_a_few_minutes(page):
    """But for the reference, which is looked up."""
    assert len(page.read_text(encoding="utf-8").split()) <= LONGEST
