"""Figures in the documentation come from stamped files of results, and from nowhere else."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, replace

import pytest

from harness.errors import DataFileError, HarnessError
from harness.paths import DOCS, MODELS, REPOSITORY
from studies import site, stamps, workflow
from studies.cli import COMMANDS
from studies.evidence import command
from studies.evidence.steps import ALONE, LIMITS, STEPS, Step
from studies.pages import evidence, front
from studies.pages.evidence import EvidencePage
from studies.stamps import Stamp

STAMP = Stamp("0.1.0", "abc1234", "FEBio 4.11.0", 60.0)
MEASURED = re.compile(r"\d ?%|\b\d+ (?:Newton )?iterations\b|\b\d+ retries\b|\b\d+(?:\.\d+)? times (?:as|FEBio|the)\b")
"""What only a measurement can say: parts of a hundred, counts of iterations, ratios."""
DEFINITIONS = ("agree to 1 %",)
"""Constants of the method, which are given in parts of a hundred."""
PROSE = [path for folder in ("start", "how-to", "explanation") for path in (DOCS / folder).glob("*.md")]
MEASURED_PAGES = [DOCS / page.name for page in site.EVIDENCE]
PROSE += [DOCS / "index.md", DOCS / "faq.md", REPOSITORY / "README.md"]


@pytest.fixture
def page(tmp_path, monkeypatch):
    """Make a page of two sources in a folder of its own."""
    monkeypatch.setattr(evidence, "DATA", tmp_path)
    monkeypatch.setattr(evidence, "REPOSITORY", tmp_path)

    def make(text: str, stamps: tuple[Stamp, Stamp] = (STAMP, STAMP)) -> str:
        (tmp_path / "one.csv").write_text(f"# {json.dumps(asdict(stamps[0]))}\nname\n")
        (tmp_path / "two.json").write_text(json.dumps({"stamp": asdict(stamps[1]), "rows": []}))
        (tmp_path / "page.md").write_text(text)
        return EvidencePage("page.md", ("one.csv", "two.json"), tmp_path / "page.md", lambda: {"count": "17"})()

    return make


def test_a_page_has_its_figures_from_its_sources(page):
    assert page("{written}: {count} of problem 3.1, {stamp}").endswith(f": 17 of problem 3.1, {STAMP}")


def test_a_page_does_not_mix_stamps(page):
    for other in (replace(STAMP, commit="def5678"), replace(STAMP, limit=120.0), replace(STAMP, engine="FEBio 4.10.0")):
        with pytest.raises(DataFileError, match=r"made with different things: one\.csv: .*; two\.json: "):
            page("{written} {count} {stamp}", (STAMP, other))


def test_a_source_without_a_stamp_is_named(page, tmp_path):
    page("{written} {count} {stamp}")
    (tmp_path / "one.csv").write_text("name\n")
    with pytest.raises(DataFileError, match=r"one\.csv says not what it was made with"):
        evidence.one_stamp([tmp_path / "one.csv"])


@pytest.mark.parametrize("text", ["takes 12 iterations", "half, 0.5 of it", "| 3 | 4 |", "fails in 3.5 s"])
def test_a_figure_in_the_text_is_refused(page, text):
    with pytest.raises(DataFileError, match=f"stands in no file of results: {re.escape(text)}"):
        page(f"{{written}} {{count}} {{stamp}}\n{text}")


@pytest.mark.parametrize("text", ["problem 3.1", "`penalty` 1".replace(" 1", ""), "[a](b-2.md)", "`12`", "FEBio 4"])
def test_names_may_hold_digits(text):
    assert evidence.figures_in(text) == ""


def test_places_and_figures_agree(page):
    with pytest.raises(DataFileError, match="do not agree on ratio"):
        page("{written} {count} {ratio} {stamp}")


@pytest.mark.parametrize("made", site.EVIDENCE, ids=lambda made: made.name)
def test_the_results_of_each_page_have_one_stamp(made):
    paths = [evidence.DATA / source for source in made.sources]
    assert evidence.one_stamp(paths, any_commit=not made.compares_sources).commit


def test_all_results_were_measured_in_one_go():
    """Where this fails: `scripts/mixcontact evidence`."""
    assert {*LIMITS, *ALONE} == {path.name for path in evidence.DATA.iterdir()}
    evidence.check_together(LIMITS)


def test_results_that_stand_alone_have_their_limit():
    assert {name: evidence.stamp_of(evidence.DATA / name).limit for name in ALONE} == ALONE


def test_results_of_several_goes_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(evidence, "DATA", tmp_path)
    limits = {"one.csv": 60.0, "two.csv": 0.0}

    def check(*stamps: Stamp) -> None:
        for name, stamp in zip(limits, stamps, strict=True):
            (tmp_path / name).write_text(f"# {json.dumps(asdict(stamp))}\nname\n")
        evidence.check_together(limits)

    free = replace(STAMP, limit=0.0)
    check(STAMP, free)
    for mixed in ((STAMP, replace(free, commit="def5678")), (replace(STAMP, limit=120.0), free), (STAMP, STAMP)):
        with pytest.raises(DataFileError, match=r"not measured in one go.*one\.csv: .*; two\.csv: "):
            check(*mixed)


def test_a_step_is_done_where_its_files_have_the_commit_and_the_limit(tmp_path, monkeypatch):
    monkeypatch.setattr(evidence, "DATA", tmp_path)
    step = Step("one", ("one.csv",), (("cost", "--folder", "{folder}"),), STAMP.limit)
    assert not step.is_done(STAMP.commit)
    (tmp_path / "one.csv").write_text(f"# {json.dumps(asdict(STAMP))}\nname\n")
    assert step.is_done(STAMP.commit)
    assert not step.is_done("def5678")
    assert not replace(step, limit=600.0).is_done(STAMP.commit)
    assert step.commands_in(tmp_path) == [("cost", "--folder", str(tmp_path / "one"))]


def test_each_step_of_the_evidence_is_a_command():
    assert {command[0] for step in STEPS for command in step.commands} <= set(COMMANDS)


def test_steps_are_done_in_turn_and_the_last_one_at_the_end(tmp_path):
    """A command whose checks do not hold (exit code 1) is done; bad input (2) is not, and keeps the last from being."""
    good, bad = ("check", str(MODELS / "joint-before.feb")), ("check", str(tmp_path / "none.feb"))
    assert workflow.in_turn({"one": [good, ("check", "--help")], "last": [good]}, tmp_path) == {"one", "last"}
    assert workflow.in_turn({"one": [good], "two": [good, bad], "last": [good]}, tmp_path) == {"one"}
    assert "none.feb" in (tmp_path / "two.log").read_text()


def test_evidence_of_sources_that_are_not_committed_is_refused(monkeypatch):
    monkeypatch.setattr(stamps, "plugin_commit", lambda: "abc1234+")
    with pytest.raises(HarnessError, match=r"plugin, cmake, CMakeLists\.txt have changes that are not committed"):
        command.committed()


@pytest.mark.parametrize("path", [path for path in PROSE if path not in MEASURED_PAGES], ids=lambda path: path.name)
def test_measured_figures_stand_on_pages_of_evidence_alone(path):
    text = path.read_text(encoding="utf-8")
    for constant in (*DEFINITIONS, *(row[0] for row in front.QUOTED.finditer(text))):
        text = text.replace(constant, "")
    found = [line for line in text.splitlines() if MEASURED.search(line)]
    assert found == []


def test_readme_quotes_what_each_page_says_first():
    text = (REPOSITORY / "README.md").read_text(encoding="utf-8")
    assert text == front.page()
    pages = ("verification", "hard-cases", "reported-scenes", "agreement", "cost", "price")
    assert [row[2] for row in front.QUOTED.finditer(text)] == [f"docs/evidence/{name}.md" for name in pages]
