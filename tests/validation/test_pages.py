"""The generated pages are what their sources say. Needs neither FEBio nor a build."""

from __future__ import annotations

from dataclasses import replace

import pytest

from harness.errors import DataFileError
from harness.paths import DOCS
from harness.preflight.plugin_types import PLUGIN_TYPES, Parameter
from harness.validate.checks import CHECKS
from studies import site
from studies.pages import plugin_parameters, verification

PARAMETERS = PLUGIN_TYPES["sliding-mixture"]


@pytest.mark.parametrize("name", site.PAGES)
def test_a_generated_page_is_up_to_date(name):
    """Where this fails: `scripts/mixcontact pages`."""
    assert (DOCS / name).read_text(encoding="utf-8") == site.PAGES[name]()


def altered(name: str, **changes: str) -> list[Parameter]:
    """The parameters, one of which is altered."""
    return [replace(each, **changes) if each.name == name else each for each in PARAMETERS]


def test_a_parameter_without_a_note_is_named():
    with pytest.raises(DataFileError, match="do not agree on gap_limit"):
        plugin_parameters.page([*PARAMETERS, replace(PARAMETERS[0], name="gap_limit")])


def test_a_note_without_a_parameter_is_named():
    with pytest.raises(DataFileError, match="do not agree on gaptol"):
        plugin_parameters.page([each for each in PARAMETERS if each.name != "gaptol"])


def test_a_group_without_a_sentence_is_named():
    with pytest.raises(DataFileError, match="do not agree on Insistence"):
        plugin_parameters.page(altered("maxaug", group="Insistence"))


def test_a_parameter_stands_under_the_heading_of_its_group():
    assert plugin_parameters.page().index("## Enforcement") < plugin_parameters.page().index("| `maxaug` |")
    page = plugin_parameters.page(altered("maxaug", group="Effects"))
    assert page.index("| `maxaug` |") < page.index("## Enforcement")


def test_defaults_come_from_the_code():
    assert "| `maxaug` | - | 10 |" in plugin_parameters.page()
    assert "| `maxaug` | - | 20 |" in plugin_parameters.page(altered("maxaug", default="20"))


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
