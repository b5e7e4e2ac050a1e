"""The API reference of the core has all headers, and of a class what is public."""

from __future__ import annotations

import importlib

import pytest


@pytest.fixture
def api_reference():
    """The module that makes the pages, where its parser is installed."""
    pytest.importorskip("tree_sitter_cpp", reason="`scripts/mixcontact docs` installs it")
    return importlib.import_module("studies.pages.api_reference")


def test_every_header_of_the_core_is_in_the_reference(api_reference):
    pages = api_reference.api_pages()
    headers = sorted(api_reference.CORE.rglob("*.h"))
    assert headers
    for path in headers:
        assert f"## `{path.relative_to(api_reference.CORE)}`" in pages[f"api/{path.parent.name}.md"]


def test_the_navigation_names_every_page(api_reference):
    text = (api_reference.REPOSITORY / "mkdocs.yml").read_text(encoding="utf-8")
    for name in api_reference.api_pages():
        assert f"{name}\n" in text


def test_a_class_shows_what_is_public_and_no_body(api_reference):
    header = b"""/// Of the header.
#pragma once
namespace n {
class Forward;
/// A counter.
class Counter {
 public:
  explicit Counter(int start) : count_(start) {}
  int count() const { return count_; }  ///< so far

 private:
  int count_;
};
}  // namespace n
"""
    section = api_reference.header_section("a/b.h", header)
    assert "Of the header." in section
    assert "### Counter\n\nA counter.\n" in section
    assert "  explicit Counter(int start);\n  int count() const;  ///< so far\n};" in section
    assert "Forward" not in section
    assert "int count_" not in section
