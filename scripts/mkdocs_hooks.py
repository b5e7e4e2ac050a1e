"""What MkDocs does as it builds the site (mkdocs.yml): makes the API reference of the core and the page of
CONTRIBUTING.md, and refuses generated pages that are out of date.
"""

from __future__ import annotations

import sys
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness.errors import HarnessError
from harness.pages.api_reference import api_pages
from harness.paths import REPOSITORY
from harness.site import pages


def on_pre_build(**_: object) -> None:
    """Fails where a generated page is not what the code and the results in docs/data say, or mixes their stamps."""
    try:
        pages(check=True)
    except HarnessError as error:
        raise PluginError(str(error)) from error


def on_files(files: Files, config: MkDocsConfig) -> Files:
    for name, text in api_pages().items():
        files.append(File.generated(config, name, content=text))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """CONTRIBUTING.md as a page of the site, which stands a folder deeper."""
    if page.file.src_uri != "development/contributing.md":
        return markdown
    return (REPOSITORY / "CONTRIBUTING.md").read_text(encoding="utf-8").replace("](docs/", "](../")
