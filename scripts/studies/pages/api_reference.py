"""The API reference of the contact core, from the comments of its headers: one page per folder of plugin/contact.

tree-sitter reads the headers as text, so that neither a compiler nor Eigen is needed.
"""

import re
import textwrap
from collections.abc import Iterator
from itertools import takewhile

import tree_sitter
import tree_sitter_cpp

from harness.paths import REPOSITORY

CORE = REPOSITORY / "plugin/contact"
TYPES = ("class_specifier", "struct_specifier", "enum_specifier")
MARKDOWN = re.compile(r"([\\`*_{}\[\]<>#|$])")


def source(node: tree_sitter.Node) -> str:
    return (node.text or b"").decode()


def prose(comments: list[str]) -> str:
    """The text of lines of `///`, as a paragraph of Markdown."""
    lines = [re.sub(r"^///<?\s?", "", line.strip()) for comment in comments for line in comment.splitlines()]
    return "\n".join(MARKDOWN.sub(r"\\\1", line) for line in lines)


def declaration(node: tree_sitter.Node) -> str:
    """A declaration as it stands in the header, without the body of a function and what initialises members."""
    inner = node.children[-1] if node.type == "template_declaration" else node
    for child in inner.children:
        if inner.type == "function_definition" and child.type in ("compound_statement", "field_initializer_list"):
            assert node.text is not None
            head: bytes = node.text[: child.start_byte - node.start_byte]
            return head.decode().rstrip() + ";"
    return source(node)


def public_members(body: tree_sitter.Node, starts_public: bool) -> list[str]:
    """The lines of a class that its users see, with their comments."""
    lines: list[str] = []
    public, row = starts_public, -1
    for child in body.named_children:
        if child.type == "access_specifier":
            public = source(child) == "public"
            continue
        if not public:
            continue
        if child.start_point.row == row and child.type == "comment":
            lines[-1] += "  " + source(child).strip()
            continue
        if lines and child.start_point.row > row + 1:
            lines.append("")
        lines.append(" " * child.start_point.column + declaration(child).strip())
        row = child.end_point.row - (child.end_point.column == 0)
    return lines


def type_block(node: tree_sitter.Node) -> str:
    """A class, struct or enumeration with what is public of it."""
    inner = node.children[-2] if node.type == "template_declaration" else node
    body = inner.child_by_field_name("body")
    if body is None or inner.type == "enum_specifier":
        return source(node) + ";"
    assert node.text is not None
    head = node.text[: body.start_byte - node.start_byte].decode().rstrip()
    members = public_members(body, inner.type == "struct_specifier")
    return "\n".join(
        [f"{head} {{", *(" public:" for _ in members[:1] if inner.type == "class_specifier"), *members, "};"]
    )


def type_of(node: tree_sitter.Node) -> tree_sitter.Node | None:
    """The type that a node defines, perhaps as a template."""
    inner = node.children[-2] if node.type == "template_declaration" and len(node.children) > 1 else node
    has_body = inner.type in TYPES and inner.child_by_field_name("body") is not None
    return inner if has_body else None


def name_of(node: tree_sitter.Node) -> str:
    """What a declaration declares: the innermost name of its declarator."""
    found = type_of(node)
    if found is not None:
        return source(name) if (name := found.child_by_field_name("name")) is not None else ""
    inner = node.children[-1] if node.type == "template_declaration" else node
    while (deeper := inner.child_by_field_name("declarator")) is not None or inner.type == "reference_declarator":
        inner = deeper if deeper is not None else inner.named_children[-1]
    return source(name) if (name := inner.child_by_field_name("name")) is not None else source(inner)


def declarations(root: tree_sitter.Node) -> Iterator[tuple[list[str], tree_sitter.Node]]:
    """What stands in the namespace of a header, each with the comment above it."""
    for namespace in (node for node in root.children if node.type == "namespace_definition"):
        body = namespace.child_by_field_name("body")
        comments: list[str] = []
        for node in body.named_children if body is not None else []:
            if node.type == "comment":
                comments.append(source(node))
                continue
            yield comments, node
            comments = []


def entry(comments: list[str], node: tree_sitter.Node) -> str:
    code = type_block(node) if type_of(node) is not None else declaration(node)
    title = MARKDOWN.sub(r"\\\1", name_of(node))
    return f"### {title}\n\n{prose(comments)}\n\n```cpp\n{textwrap.dedent(code)}\n```\n"


def is_forward_declaration(node: tree_sitter.Node) -> bool:
    inner = node.children[-2] if node.type == "template_declaration" else node
    return inner.type in TYPES and inner.child_by_field_name("body") is None


def header_section(path: str, text: bytes) -> str:
    root = tree_sitter.Parser(tree_sitter.Language(tree_sitter_cpp.language())).parse(text).root_node
    above = [source(node) for node in takewhile(lambda node: node.type == "comment", root.children)]
    entries = [entry(*pair) for pair in declarations(root) if not is_forward_declaration(pair[1])]
    return "\n".join([f"## `{path}`", "", prose(above), "", *entries])


def purposes() -> dict[str, str]:
    """The folders of the core, from the table of its README, in their order."""
    rows = re.findall(r"^\| `(\w+)` \| (.*) \|$", (CORE / "README.md").read_text(), flags=re.MULTILINE)
    return dict(rows)


def folder_page(folder: str, purpose: str) -> str:
    headers = sorted((CORE / folder).glob("*.h"))
    sections = [header_section(f"{folder}/{path.name}", path.read_bytes()) for path in headers]
    return "\n".join([f"# {folder}", "", f"{purpose[:1].upper()}{purpose[1:]}.", "", *sections])


def index_page(folders: dict[str, str]) -> str:
    rows = [f"| [{folder}]({folder}.md) | {purpose} |" for folder, purpose in folders.items()]
    intro = (
        "What the headers of `plugin/contact` offer, with their comments. A folder uses those above it in this table. "
        "[`ContactInterface`](interface.md#contactinterface) is what a host talks to."
    )
    return "\n".join(["# API of the core", "", intro, "", "| folder | purpose |", "|---|---|", *rows, ""])


def api_pages() -> dict[str, str]:
    """The pages by their names in the site."""
    folders = purposes()
    pages = {f"api/{folder}.md": folder_page(folder, purpose) for folder, purpose in folders.items()}
    return {"api/index.md": index_page(folders), **pages}
