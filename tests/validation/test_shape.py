"""Classes and functions of the plugin stay small, and indices need no cast."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

PLUGIN = Path(__file__).resolve().parents[2] / "plugin"
MOST_METHODS, MOST_MEMBERS, MOST_BOOLEANS = 30, 14, 3
"""Of a class; functions that are deleted or defaulted do not count."""
MOST_CASTS = 6.0
"""`static_cast` per 1000 lines."""
MOST_REFERENCES = 49
"""Private data members of all classes that are references, whose lifetime a reader has to know."""
MEDIAN_LINES, MOST_LINES = 6, 33
"""Of functions with their heads: the median, and the 99th percentile."""

NOT_CODE = re.compile(r"//[^\n]*|/\*.*?\*/|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.DOTALL | re.MULTILINE)
QUOTED = re.compile(r"\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'")
CLASS = re.compile(r"(?<!enum )\b(?:class|struct) (\w+)(?: final)?(?:\s*:[^{;()]*)?\s*\{")
SCOPE = re.compile(r"\bnamespace\b[^{};]*$|^extern \"\"$|\b(?:class|struct) \w+(?: final)?(?:\s*:[^{;()]*)?$")
FUNCTION = re.compile(r"\)\s*(?:const|noexcept|override|final|->[\w\s:<>,&*]+|\s)*$|\)\s*:\s[^;]*[)}]$")
LABEL = re.compile(r"\b(?:public|private|protected):(?!:)")
NO_MEMBER = re.compile(r"(?:using|friend|typedef|enum|static constexpr|static inline constexpr|DECLARE_\w+)\b")
TEMPLATE_ARGUMENTS = re.compile(r"<[^<>]*>")


@dataclass(frozen=True)
class Shape:
    """How many methods, data members and booleans a class has."""

    name: str
    methods: int
    members: int
    booleans: int


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


def declarations(body: str) -> Iterator[str]:
    """What a class declares, what stands in braces left out."""
    statement, at = "", 0
    while at < len(body):
        if body[at] == "{":
            at = closing(body, at)
            statement += "{}"
            ends = not re.match(r"\}\s*[;,){]", body[at:])
        else:
            ends = body[at] == ";"
            statement += "" if ends else body[at]
        if ends:
            yield " ".join(LABEL.sub("", statement).split())
            statement = ""
        at += 1


def without_templates(text: str) -> str:
    """The same without template arguments, so that no comma or parenthesis of theirs is left."""
    while (shorter := TEMPLATE_ARGUMENTS.sub("", text)) != text:
        text = shorter
    return text


def shape(name: str, body: str) -> Shape:
    """The shape of a class."""
    methods = members = booleans = 0
    for declaration in declarations(body):
        head = re.split(r"(?<![=!<>])=(?!=)|\{", without_templates(declaration))[0]
        if not head.strip() or NO_MEMBER.match(declaration):
            continue
        if "(" in head or "operator" in head:
            methods += re.search(r"= (?:delete|default)$", declaration) is None
        elif not re.match(r"(?:class|struct) \w+$", head.strip()):
            count = 1 + without_templates(declaration).count(",")
            members += count
            booleans += count if re.match(r"(?:mutable )?bool\b", head) else 0
    return Shape(name, methods, members, booleans)


def references(text: str) -> int:
    """The number of private data members that are references, of the classes in a file."""
    code = plain(text)
    bodies = (code[m.end() : closing(code, m.end() - 1)] for m in CLASS.finditer(code))
    declared = (without_templates(declaration) for body in bodies for declaration in declarations(body))
    return sum(re.search(r"&\s*\w+_$", declaration) is not None for declaration in declared)


def shapes(text: str) -> list[Shape]:
    """Of the classes in a file, nested ones too."""
    code = plain(text)
    return [shape(m[1], code[m.end() : closing(code, m.end() - 1)]) for m in CLASS.finditer(code)]


def sources() -> list[str]:
    return [path.read_text(encoding="utf-8") for path in sorted(PLUGIN.rglob("*")) if path.suffix in (".h", ".cpp")]


def test_no_class_does_everything() -> None:
    found = [each for text in sources() for each in shapes(text)]
    assert len(found) > 200
    large = [
        each
        for each in found
        if each.methods > MOST_METHODS or each.members > MOST_MEMBERS or each.booleans > MOST_BOOLEANS
    ]
    assert large == []


def test_few_members_are_references() -> None:
    assert references("class A { int& f(B& b_); std::map<int, B*>& b_; C& c_; };") == 2
    assert sum(references(text) for text in sources()) <= MOST_REFERENCES


def test_functions_are_small() -> None:
    lines = sorted(count for text in sources() for count in functions(plain(text)))
    assert len(lines) > 1000
    assert lines[len(lines) // 2] <= MEDIAN_LINES
    assert lines[len(lines) * 99 // 100] <= MOST_LINES


def test_indices_need_no_cast() -> None:
    texts = sources()
    lines = sum(len(text.splitlines()) for text in texts)
    assert sum(text.count("static_cast<") for text in texts) <= MOST_CASTS * lines / 1000.0


def test_the_shape_of_a_class_is_counted() -> None:
    """The test of this test."""
    text = """
    /// A comment with a brace {.
    class Box final : public Base {
     public:
      explicit Box(int n) : size_(n), name_("{") {}
      Box(const Box&) = delete;
      ~Box() override = default;
      int size() const { return size_; }
      std::function<void(int, int)> call;
      void set(int size, bool open = false);
      bool operator==(const Box& other) const { return size_ == other.size_; }
      enum class Kind { a, b };
      struct Inner {
        bool one = true, two = false;
      };
     private:
      bool open_ = true, shut_ = false;
      std::array<std::pair<int, int>, 3> pairs_{};
      int size_;
    };
    """
    assert shapes(text) == [Shape("Box", 4, 5, 2), Shape("Inner", 0, 2, 2)]


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
