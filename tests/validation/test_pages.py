"""The generated pages are what their sources say. Needs neither FEBio nor a build."""

from __future__ import annotations

import pytest

from harness.errors import DataFileError
from harness.paths import DOCS
from harness.validate.checks import CHECKS
from studies import site
from studies.pages import plugin_parameters, verification


@pytest.mark.parametrize("name", site.PAGES)
def test_a_generated_page_is_up_to_date(name):
    """Where this fails: `scripts/mixcontact pages`."""
    assert (DOCS / name).read_text(encoding="utf-8") == site.PAGES[name]()


def altered(tmp_path, monkeypatch, old: str, new: str) -> None:
    """The table of parameters is that of the code, but for one replacement."""
    text = plugin_parameters.DECLARATION.read_text(encoding="utf-8")
    assert old in text
    changed = tmp_path / plugin_parameters.DECLARATION.name
    changed.write_text(text.replace(old, new), encoding="utf-8")
    monkeypatch.setattr(plugin_parameters, "DECLARATION", changed)


def test_a_parameter_without_a_note_is_named(tmp_path, monkeypatch):
    line = '  take_given({"gaptol", "gap tolerance", Group::enforcement, Unit::length}, p.tolerances.gaptol);'
    another = '  take_given({"gap_limit", "gap limit", Group::enforcement}, p.tolerances.gaptol);'
    altered(tmp_path, monkeypatch, line, f"{another}\n{line}")
    with pytest.raises(DataFileError, match="do not agree on gap_limit"):
        plugin_parameters.page()


def test_a_note_without_a_parameter_is_named(tmp_path, monkeypatch):
    altered(tmp_path, monkeypatch, '"gaptol"', '"ptol"')
    with pytest.raises(DataFileError, match="do not agree on gaptol"):
        plugin_parameters.page()


def test_a_registration_of_another_form_is_an_error(tmp_path, monkeypatch):
    altered(
        tmp_path,
        monkeypatch,
        'take_given({"gaptol", "gap tolerance", Group::enforcement, Unit::length}, p.tolerances.gaptol)',
        "take_given(tag, p.tolerances.gaptol)",
    )
    with pytest.raises(DataFileError, match="is not of the form"):
        plugin_parameters.page()


def test_a_group_without_a_sentence_is_named(tmp_path, monkeypatch):
    altered(tmp_path, monkeypatch, "case ParameterGroup::enforcement:", "case ParameterGroup::insistence:")
    with pytest.raises(DataFileError, match="do not agree on enforcement, insistence"):
        plugin_parameters.page()


def test_a_parameter_stands_under_the_heading_of_its_group(tmp_path, monkeypatch):
    assert plugin_parameters.page().index("## Enforcement") < plugin_parameters.page().index("| `maxaug` |")
    altered(
        tmp_path, monkeypatch, '"maximum augmentations", Group::enforcement', '"maximum augmentations", Group::effects'
    )
    assert plugin_parameters.page().index("| `maxaug` |") < plugin_parameters.page().index("## Enforcement")


def test_defaults_come_from_the_code(tmp_path, monkeypatch):
    assert "| `maxaug` | - | 10 |" in plugin_parameters.page()
    altered(tmp_path, monkeypatch, "int maxaug = 10;", "int maxaug = 20;")
    assert "| `maxaug` | - | 20 |" in plugin_parameters.page()


def test_the_report_has_every_check_and_each_figure_meets_its_bar():
    made = verification.read(DOCS)
    assert [section.name for section in made.sections] == [check.name for check in CHECKS]
    assert [m.name for section in made.sections for m in section.measures if not m.passed] == []
    for section in made.sections:
        assert section.runs or section.name == "closed-forms"


def test_a_report_is_read_as_it_was_written(tmp_path):
    made = verification.read(DOCS)
    verification.write(tmp_path, made)
    assert verification.read(tmp_path) == made
