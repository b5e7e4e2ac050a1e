"""Hooks of MkDocs (mkdocs.yml): they write the API reference of the core, show CONTRIBUTING.md and CHANGELOG.md as
pages, draw formulas, and refuse generated pages that are out of date and pages that fetch from the network.
"""

import html
import re
import sys
import warnings
from pathlib import Path
from xml.etree import ElementTree

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

with warnings.catch_warnings():  # ziamath finds its font by a function that Python will drop
    warnings.simplefilter("ignore", DeprecationWarning)
    import ziamath

sys.path.insert(0, str(Path(__file__).resolve().parent))

from harness.errors import HarnessError
from harness.paths import REPOSITORY
from studies.pages.api_reference import api_pages
from studies.site import pages

ziamath.config.math.color = "currentColor"
ziamath.config.svg2 = False
ziamath.config.precision = 2

ROOT_PAGES = {"development/contributing.md": "CONTRIBUTING.md", "development/changelog.md": "CHANGELOG.md"}
"""Pages of the site whose text stands at the root of the repository."""
INLINE = re.compile(r'<span class="arithmatex">\\\((.+?)\\\)</span>', re.DOTALL)
DISPLAY = re.compile(r'<div class="arithmatex">\\\[(.+?)\\\]</div>', re.DOTALL)
NUMBER = re.compile(r"\\tag\{(.+?)\}")
SIZE = 20.0  # height of the letters of a formula as it is drawn
EM = 17.0
"""Length in the drawing that becomes the height of the letters around it. Formulas are a little larger than text."""
FETCHED = re.compile(
    r'<(?:script|img|iframe)[^>]*\ssrc="(https?:[^"]+)"|<link[^>]*rel="stylesheet"[^>]*href="(https?:[^"]+)"'
)


def on_pre_build(**_: object) -> None:
    """Fails where a generated page differs from the code and the results in docs/data, or mixes their stamps."""
    try:
        pages(check=True)
    except HarnessError as error:
        raise PluginError(str(error)) from error


def on_files(files: Files, config: MkDocsConfig) -> Files:
    for name, text in api_pages().items():
        files.append(File.generated(config, name, content=text))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """The text of a page that stands at the root of the repository, with links from the page's own folder."""
    source = ROOT_PAGES.get(page.file.src_uri)
    return (REPOSITORY / source).read_text(encoding="utf-8").replace("](docs/", "](../") if source else markdown


def drawing(latex: str, display: bool, page: Page) -> str:
    """A formula as a picture in the text, with its LaTeX as the words for it. An unknown command is an error."""
    latex = html.unescape(latex).strip()
    made = ziamath.Latex(latex.replace("{aligned}", "{align*}"), size=SIZE, inline=not display, margin=0)
    if unknown := re.findall(r"\\[a-zA-Z]+", "".join(made.mathml.itertext())):
        raise PluginError(f"{page.file.src_uri}: {', '.join(unknown)} of the formula {latex} is unknown")
    picture = made.svgxml()
    width, height = made.getsize()
    picture.set("role", "img")
    picture.set("aria-label", latex)
    size = f"width:{width / EM:.3f}em;height:{height / EM:.3f}em;"
    picture.set("style", f"{size}vertical-align:{made.getyofst() / EM:.3f}em")
    return ElementTree.tostring(picture, encoding="unicode")


def on_page_content(content: str, page: Page, **_: object) -> str:
    """Formulas as pictures, so that a browser needs neither a script nor a font from the network."""

    def block(match: re.Match[str]) -> str:
        number = NUMBER.search(match[1])
        shown = f'<span class="number">({number[1]})</span>' if number else ""
        return f'<div class="formula">{shown}{drawing(NUMBER.sub("", match[1]), True, page)}</div>'

    content = DISPLAY.sub(block, content)
    return INLINE.sub(lambda match: drawing(match[1], False, page), content)


def on_post_page(output: str, page: Page, **_: object) -> str:
    """Fails where a page would fetch a script, a style or a picture from the network."""
    if found := [first or second for first, second in FETCHED.findall(output)]:
        raise PluginError(f"{page.file.src_uri} fetches from the network: {', '.join(found)}")
    return output
