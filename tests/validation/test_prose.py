"""The check of the style finds bad sentences and passes good ones."""

from __future__ import annotations

import pytest

pytest.importorskip("lemminflect", reason="`scripts/mixcontact docs` installs it")

from prose import check, count
from prose.check import house, of_comments
from prose.text import Sentence, sentences

RULES = house()

BAD = {
    "The log tells the gap.": "'tells' is no word of the field",
    "FEBio's interface stands beside it.": "'stands beside'",
    "The run ends in 40 iterations.": "'run ends'",
    "Of 0 it says what it means.": "not with 'Of'",
    "So the node opens.": "not with 'So'",
    "What is not exchanged has no entry.": "a noun in place of 'What'",
    "With one pass the integral runs over the primary surface.": "the subject first",
    "In the middle of the page stands the table.": "the subject first",
    "Reported are the two slips.": "not with 'Reported are'",
    "Not in these data: one mesh.": "not with 'Not'",
    "* `--folder`: Where results go.": "not with 'Where'",
    "The error is 5%.": "a space before the percent sign",
    "**What passes** is too little.": "a noun in place of 'What'",
    "**The answer of the run.**": "without a verb",
    "A residual of the solid in the log.": "without a verb",
    "Off by default.": "without a verb",
    "The log says why.": "'log says'",
    "The bodies stick for ever.": "'for ever'",
    "Made with FEBio 4.11 and one thread.": "not with 'Made with",
    "The node " + "closes and " * 20 + "opens.": "words in one sentence",
}
GOOD = (
    "The log gives the gap.",
    "With one pass, the integral runs over the primary surface.",
    "What wets the open surfaces?",
    "Set `gaptol`, or leave it out.",
    "The contact transmits traction.",
    "**In your model.** Refine the mesh.",
    "**Friction.** The law holds.",
    "**Friction** takes 5 % more time.",
    "* `--folder`, `--out`: Write results to this folder.",
)


def complaints(markdown: str) -> list[str]:
    return [found for sentence in sentences(markdown) for rule in RULES for found in rule(sentence)]


@pytest.mark.parametrize("text", BAD)
def test_a_bad_sentence_is_found(text):
    assert any(BAD[text] in found for found in complaints(text))


@pytest.mark.parametrize("text", GOOD)
def test_a_good_sentence_passes(text):
    assert complaints(text) == []


def test_code_and_formulas_have_no_words():
    assert complaints("Write `tells`.\n\n    Of code\n\n```\nSo it is.\n```\n\n$$ told $$\n") == []


def test_cells_need_no_verb():
    cells = list(sentences("| a |\n|---|\n| off by default. |\n"))
    assert cells == [Sentence(1, "a", False), Sentence(3, "off by default.", False)]


def test_the_page_of_commands_is_checked():
    assert {"docs/reference/commands.md", "README.md", check.ENTRY} <= set(check.pages())


def test_names_of_commands_in_the_help_are_no_prose():
    said = [sentence.text for sentence in check.read(check.ENTRY)]
    assert "run one model" in said
    assert not any(text.startswith("price ") for text in said)


def test_the_head_of_a_model_is_read_between_its_title_and_its_commands():
    text = "<?xml?>\n<!--\n  A slab.\n\n  It creeps. The face\n  is fixed.\n\n  Commands: run it\n-->\n<febio_spec/>"
    read = [Sentence(2, "A slab.", False), Sentence(2, "It creeps.", True), Sentence(2, "The face is fixed.", True)]
    assert check.head_of_model(text) == read
    assert "models/joint.feb" in check.pages()


def test_messages_are_read_without_comments():
    cpp = '// it tells\nlog("the gap " \n    "stands beside it"); f("short");\n'
    assert check.messages_of_cpp(cpp) == [Sentence(2, "the gap stands beside it", False)]
    python = '"""It tells a story."""\nsay("the gap stands beside it")\n'
    assert check.messages_of_python(python) == [Sentence(2, "the gap stands beside it", False)]


def test_the_documentation_without_its_reference_is_short():
    """Where this fails: `python scripts/prose/count.py` gives the words of each folder."""
    assert 0 < count.counts().total() <= count.MOST


def test_words_have_letters():
    assert count.words("| a word | 12 | `x = 1` |") == 3


HEADER = """
/// Which facets face each other: unbroken pairs() alone. Of a pair, the points.
/// What a pair keeps.
struct Pair {
  int points;  ///< what the search told, "told"
  bool open;   // and no other
};

/// Points of a pair by `told`.
int stands_beside();
"""


def test_comments_of_a_header_are_sentences():
    found = [(sentence.line, sentence.text) for sentence in check.comments_of_cpp(HEADER)]
    assert found == [
        (2, "Which facets face each other: unbroken Code alone."),
        (2, "Of a pair, the points."),
        (2, "What a pair keeps."),
        (5, "what the search told, Code"),
        (6, "and no other"),
        (9, "Points of a pair by Code."),
    ]


def test_comments_of_a_header_follow_the_rules_on_subjects_and_words():
    found = list(check.objections(check.comments_of_cpp(HEADER), of_comments()))
    assert [text.split(":")[0] for _, text in found] == [
        "'unbroken' is no word of the field",
        "a sentence begins with its subject, not with 'Of'",
        "a noun in place of 'What'",
        "a noun in place of 'what'",
        "'told' is no word of the field",
    ]


@pytest.mark.parametrize("suffix", [".h", ".cpp"])
def test_comments_of_headers_and_sources_are_checked(suffix, tmp_path):
    path = tmp_path / f"pair{suffix}"
    path.write_text(HEADER, encoding="utf-8")
    assert len(check.findings(str(path), RULES)) == len(
        list(check.objections(check.comments_of_cpp(HEADER), of_comments()))
    )
