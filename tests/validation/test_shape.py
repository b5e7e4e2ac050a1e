"""Functions of the plugin stay small, and indices need no cast."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

PLUGIN = Path(__file__).resolve().parents[2] / "plugin"
MOST_CASTS = 6.0
"""`static_cast` per 1000 lines."""
MEDIAN_LINES, MOST_LINES = 6, 33
"""Of functions with their heads: the median, and the 99th percentile."""

NOT_CODE = re.compile(r"//[^\n]*|/\*.*?\*/|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.DOTALL | re.MULTILINE)
QUOTED = re.compile(r"\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'")
SCOPE = re.compile(r"\bnamespace\b[^{};]*$|^extern \"\"$|\b(?:class|struct) \w+(?: final)?(?:\s*:[^{;()]*)?$")
FUNCTION = re.compile(r"\)\s*(?:const|noexcept|override|final|->[\w\s:<>,&*]+|\s)*$|\)\s*:\s[^;]*[)}]$")
LABEL = re.compile(r"\b(?:public|private|protected):(?!:)")


def plain(text: str) -> str:
    """C++ without comments, preprocessor lines and the content of literals; lines stay where they are."""
    return QUOTED.sub('""', NOT_CODE.sub(lambda match: "\n" * match[0].count("\n"), text))


def closing(text: str, opening: int) -> int:
    """Where the brace that opens at `opening` is closed."""
    depth = 0
    for at in range(opening, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return at
    raise ValueError("a brace is not closed")


def functions(code: str) -> Iterator[int]:
    """Lines of each function that is defined in a file or in its classes; lambdas are part of theirs."""
    start = at = 0
    while at < len(code):
        if code[at] == ";":
            start = at + 1
        elif code[at] == "{":
            head, end = LABEL.sub("", code[start:at]).strip(), closing(code, at)
            if SCOPE.search(head):
                yield from functions(code[at + 1 : end])
            elif FUNCTION.search(head):
                yield 1 + head.count("\n") + code[at:end].count("\n")
            is_part = re.match(r"\s*[;,{]", code[end + 1 :])  # of a declaration, or of a constructor's head
            at, start = end, start if is_part else end + 1
        at += 1


def sources() -> list[str]:
    return [path.read_text(encoding="utf-8") for path in sorted(PLUGIN.rglob("*")) if path.suffix in (".h", ".cpp")]


def test_functions_are_small() -> None:
    lines = sorted(count for text in sources() for count in functions(plain(text)))
    assert len(lines) > 1000
    assert lines[len(lines) // 2] <= MEDIAN_LINES
    assert lines[len(lines) * 99 // 100] <= MOST_LINES


def test_indices_need_no_cast() -> None:
    texts = sources()
    lines = sum(len(text.splitlines()) for text in texts)
    assert sum(text.count("static_cast<") for text in texts) <= MOST_CASTS * lines / 1000.0


def test_the_lines_of_a_function_are_counted() -> None:
    """The test of this test."""
    text = """
    namespace one {
    enum class Kind { a, b };
    constexpr std::array<int, 2> two{1, 2};
    class Box {
     public:
      Box() : size_{1}, name_(2) {}
      int twice() const { return 2 * size_; }
    };
    // A comment.
    int longer(int a,
               int b) {
      const auto sum = [](int c, int d) {
        return c + d;
      };
      return sum(a, b);
    }
    }  // namespace one
    """
    assert list(functions(plain(text))) == [1, 1, 7]
