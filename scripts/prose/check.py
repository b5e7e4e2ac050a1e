"""Holds README, CONTRIBUTING, all pages, heads of models, help of commands, messages and comments of C++ to the style.

    python scripts/prose/check.py [file ...]

The help of each command is on the page of commands. Messages are texts of several words in the plugin's sources and in
those of the commands for users. Exit code 1: something was found.
Comments of the plugin's headers and sources follow the rules on subjects and words.
"""

import ast
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import yaml
from lemminflect import getAllInflections, getAllLemmas

from prose.text import Sentence

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from prose.text import CODE, END, sentences  # noqa: E402

HOUSE = Path(__file__).parent / "house"
Rule = Callable[[Sentence], Iterator[str]]


def substitution(rule: dict[str, Any]) -> Rule:
    """Words with others in their place, anywhere."""
    swaps = [(re.compile(word, re.IGNORECASE), other) for word, other in rule["swap"].items()]

    def found(sentence: Sentence) -> Iterator[str]:
        for word, other in swaps:
            for match in word.finditer(sentence.text):
                yield rule["message"].replace("%s", match[0], 1).replace("%s", other, 1)

    return found


def existence(rule: dict[str, Any]) -> Rule:
    """Patterns that a whole sentence must not have."""
    patterns = [re.compile(raw) for raw in rule["raw"]]

    def found(sentence: Sentence) -> Iterator[str]:
        if sentence.whole:
            matches = (pattern.search(sentence.text) for pattern in patterns)
            yield from (rule["message"].replace("%s", match[0][:60]) for match in matches if match)

    return found


def occurrence(rule: dict[str, Any]) -> Rule:
    """A pattern that a whole sentence may have so many times."""
    token = re.compile(rule["token"])

    def found(sentence: Sentence) -> Iterator[str]:
        count = len(token.findall(sentence.text))
        if sentence.whole and count > rule["max"]:
            yield rule["message"].replace("%s", str(count))

    return found


KINDS = {"substitution": substitution, "existence": existence, "occurrence": occurrence}

ARTICLES = {"a", "an", "the", "its", "their", "our", "your", "no", "each", "every"}
PREPOSITIONS = {"of", "in", "on", "at", "by", "from", "with", "for", "between"}
NO_VERB_AFTER = ARTICLES | PREPOSITIONS  # words that a finite verb does not follow
FINITE = ("VB", "VBP", "VBZ", "VBD", "MD")


def is_finite_verb(word: str) -> bool:
    """True where the lexicon has the word as a finite form of a verb."""
    for kind in ("AUX", "VERB"):
        for lemma in getAllLemmas(word, upos=kind).get(kind, ()):
            forms = getAllInflections(lemma, upos=kind)
            if any(word in forms.get(tag, ()) for tag in FINITE):
                return True
    return False


def fragment(sentence: Sentence) -> Iterator[str]:
    """A sentence that ends with a full stop and in which no word can be its verb."""
    words = re.findall(r"[A-Za-z0-9']+", sentence.text)
    begun_before = sentence.text[:1].islower()  # a sentence that goes on after a displayed formula
    if not sentence.whole or begun_before or not sentence.text.endswith(".") or len(words) < 2:
        return
    pairs = zip(["", *words], words, strict=False)
    if not any(is_finite_verb(word.lower()) for before, word in pairs if before.lower() not in NO_VERB_AFTER):
        yield "a sentence without a verb"


def rule(name: str) -> Rule:
    """The rule of a file in `house`."""
    text = yaml.safe_load((HOUSE / f"{name}.yml").read_text(encoding="utf-8"))
    return KINDS[text["extends"]](text)


def house() -> list[Rule]:
    """All rules."""
    return [*(rule(path.stem) for path in sorted(HOUSE.glob("*.yml"))), fragment]


@cache
def of_comments() -> list[Rule]:
    """The rules of comments in C++, which may be noun phrases, and long with their formulas."""
    return [rule(name) for name in ("fronted", "noun_what", "openings", "words")]


ENTRY = "scripts/mixcontact"
TALKING = (
    "collection",
    "conversion",
    "ecosystem",
    "indentation",
    "models",
    "post",
    "preflight",
    "report",
    "run",
    "validate",
)
"""Folders of the harness, whose messages users read."""
LISTED = re.compile(r"^  (?:[a-z-]+, )*[a-z-]+  +(?=\S)")
"""Names of commands at the start of a line of the entry's help."""
COMMENT = re.compile(r"^(?P<code>(?:[^\"\n]|\"[^\"\n]*\")*?)///?<? ?(?P<words>.*)$")  # a line with a comment of C++
NAME = re.compile(r"`[^`]*`|\"[^\"]*\"|\w+::[\w:]+|\b\w+\(\)?")  # names of the code in a comment
FEW_WORDS = 2  # spaces in a text that is a message, at least


def pages() -> list[str]:
    """All that is checked, from the root of the repository."""
    found = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "plugin").rglob("*.md")]
    found += [*(ROOT / "plugin").rglob("*.cpp"), *(ROOT / "plugin").rglob("*.h")]
    found += [path for folder in TALKING for path in (ROOT / "scripts" / "harness" / folder).rglob("*.py")]
    found += (ROOT / "models").glob("*.feb")
    return [*sorted(path.relative_to(ROOT).as_posix() for path in found), ENTRY]


def messages_of_cpp(text: str) -> list[Sentence]:
    """Texts in double quotes, with the pieces of each put together."""
    code = "\n".join("" if line.lstrip().startswith("//") else line for line in text.splitlines())
    pieces = re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', code)
    found = ((code[: match.start()].count("\n") + 1, re.sub(r'"\s*"', "", match[0])) for match in pieces)
    return [Sentence(line, said.strip('"'), whole=False) for line, said in found if said.count(" ") >= FEW_WORDS]


def head_of_model(text: str) -> list[Sentence]:
    """Sentences of the comment at the start of a model: below its title, and above its commands."""
    head = text.partition("<!--")[2].partition("-->")[0]
    title, *about, _ = re.split(r"\n\s*\n", head.strip())
    whole = [sentence for paragraph in about for sentence in END.split(" ".join(paragraph.split()))]
    return [Sentence(2, title, whole=False), *(Sentence(2, said, whole=True) for said in whole)]


def comments_of_cpp(text: str) -> Iterator[Sentence]:
    """Sentences of all comments, in order; the lines of one comment, or of one paragraph of it, belong together."""
    held: list[str] = []
    for number, line in enumerate([*text.splitlines(), ""], start=1):
        found = COMMENT.match(line)
        words = found["words"].strip() if found else ""
        if held and (not words or (found and found["code"].strip())):
            begins = number - len(held)
            yield from (Sentence(begins, said, whole=True) for said in END.split(NAME.sub(CODE, " ".join(held))))
            held = []
        if words:
            held.append(words)


def messages_of_python(text: str) -> list[Sentence]:
    """Texts of several words that are no comment on the code."""
    nodes = list(ast.walk(ast.parse(text)))
    comments = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    found = (node for node in nodes if isinstance(node, ast.Constant) and id(node) not in comments)
    return [
        Sentence(node.lineno, node.value, whole=False)
        for node in found
        if isinstance(node.value, str) and node.value.count(" ") >= FEW_WORDS
    ]


def read(name: str) -> list[Sentence]:
    """Sentences of a page. Each line of the entry's help counts as a cell of a table, without the names of commands."""
    text = (ROOT / name).read_text(encoding="utf-8")
    if name != ENTRY:
        return READERS[Path(name).suffix](text)
    lines = enumerate((ast.get_docstring(ast.parse(text)) or "").splitlines(), start=2)
    return [Sentence(number, LISTED.sub("", line).strip(), whole=False) for number, line in lines]


READERS: dict[str, Callable[[str], list[Sentence]]] = {
    ".md": lambda text: list(sentences(text)),
    ".py": messages_of_python,
    ".cpp": messages_of_cpp,
    ".h": messages_of_cpp,
    ".feb": head_of_model,
}
"""How each kind of file is read."""


def objections(said: Iterable[Sentence], rules: list[Rule]) -> Iterator[tuple[int, str]]:
    """What the rules object to, with the line and the sentence."""
    for sentence in said:
        for rule in rules:
            yield from ((sentence.line, f"{complaint}: {sentence.text[:100]}") for complaint in rule(sentence))


def findings(name: str, rules: list[Rule]) -> list[str]:
    """What the rules object to in a file, with the place."""
    found = [*objections(read(name), rules)]
    if name.endswith((".h", ".cpp")):
        found += objections(comments_of_cpp((ROOT / name).read_text(encoding="utf-8")), of_comments())
    return [f"{name}:{line}: {text}" for line, text in found]


def main(names: list[str]) -> int:
    rules = house()
    found = [line for name in names or pages() for line in findings(name, rules)]
    print("".join(f"{line}\n" for line in found), end="")
    print(f"prose: {len(found)} findings")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
