"""What the generated pages say beside their tables, a Markdown file each, and how it is read."""

from pathlib import Path

FOLDER = Path(__file__).parent


def page_text(name: str) -> str:
    """The text of a page, with places in braces for what is computed."""
    return (FOLDER / f"{name}.md").read_text(encoding="utf-8")
