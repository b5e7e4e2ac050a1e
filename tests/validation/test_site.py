"""The site draws formulas and needs no network. Needs what `scripts/mixcontact docs` installs, and no FEBio."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

pytest.importorskip("tree_sitter_cpp", reason="`scripts/mixcontact docs` installs it")
pytest.importorskip("ziamath", reason="`scripts/mixcontact docs` installs it")

from mkdocs.exceptions import PluginError

import mkdocs_hooks

PAGE = SimpleNamespace(file=SimpleNamespace(src_uri="page.md"))


def test_a_formula_becomes_a_picture_with_its_words():
    made = mkdocs_hooks.on_page_content(r'<p>The gap <span class="arithmatex">\(g\)</span></p>', PAGE)
    assert made.startswith("<p>The gap <svg")
    assert 'aria-label="g"' in made


def test_a_numbered_formula_shows_its_number():
    made = mkdocs_hooks.on_page_content('<div class="arithmatex">\\[\na &lt; b \\tag{2.7}\n\\]</div>', PAGE)
    assert '<span class="number">(2.7)</span>' in made
    assert 'aria-label="a &lt; b"' in made


def test_aligned_lines_are_rows():
    two = r"\begin{aligned} a &amp;= b,\\ c &amp;= d \end{aligned}"
    one = r"\begin{aligned} a &amp;= b \end{aligned}"
    heights = [float(mkdocs_hooks.drawing(text, True, PAGE).split("height:")[1].split("em")[0]) for text in (one, two)]
    assert heights[1] > 1.5 * heights[0]


def test_an_unknown_command_of_a_formula_is_an_error():
    with pytest.raises(PluginError, match=r"page\.md: \\oops of the formula"):
        mkdocs_hooks.on_page_content(r'<span class="arithmatex">\(\oops\)</span>', PAGE)


@pytest.mark.parametrize(
    "tag",
    [
        '<script src="https://example.org/maths.js"></script>',
        '<link rel="stylesheet" href="https://example.org/site.css">',
        '<img alt="" src="http://example.org/picture.png">',
    ],
)
def test_a_page_that_fetches_from_the_network_is_an_error(tag):
    with pytest.raises(PluginError, match="fetches from the network"):
        mkdocs_hooks.on_post_page(f"<head>{tag}</head>", PAGE)


def test_links_and_local_files_are_no_errors():
    text = '<a href="https://febio.org">FEBio</a><script src="assets/bundle.js"></script>'
    assert mkdocs_hooks.on_post_page(text, PAGE) == text
