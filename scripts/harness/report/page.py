"""Writes the page of a run: one HTML file that holds its pictures and needs no network."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

_STYLE = """
body{font:16px/1.5 system-ui,sans-serif;margin:0 auto;max-width:1100px;padding:1rem;color:#222}
h1{font-size:1.5rem}h2{font-size:1.2rem;margin-top:2rem}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:1rem}
figure{margin:0}img{width:100%;height:auto;border:1px solid #ddd}figcaption{font-size:.9rem;color:#555}
.wide{overflow-x:auto}table{border-collapse:collapse}
td,th{padding:.25rem .7rem;border-bottom:1px solid #ddd;text-align:left}
td.n{text-align:right;font-variant-numeric:tabular-nums}
.warning{background:#fff4e0;border-left:4px solid #c77d0a;padding:.4rem .8rem;margin:.4rem 0}
"""


@dataclass(frozen=True)
class Table:
    """A table under a heading."""

    heading: str
    columns: tuple[str, ...]
    rows: list[tuple[str, ...]]


@dataclass(frozen=True)
class Picture:
    """A picture with its caption."""

    file: Path
    caption: str


@dataclass(frozen=True)
class Page:
    """The content of the page, in the order in which it stands there."""

    title: str
    summary: str
    warnings: Sequence[str]
    surfaces: Sequence[Picture]
    curves: Sequence[Picture]
    tables: Sequence[Table]
    notes: Sequence[str]


def write(page: Page, folder: Path) -> Path:
    """Write `index.html` into a folder; its pictures stand in the page itself."""
    body = [f"<h1>{escape(page.title)}</h1>", f"<p>{escape(page.summary)}</p>"]
    body += [f'<p class="warning">{escape(warning)}</p>' for warning in page.warnings]
    body += ["<h2>Contact pressure</h2>", _figures(page.surfaces), "<h2>Over time</h2>", _figures(page.curves)]
    body += [_table(table) for table in page.tables]
    body += [f"<p>{escape(note)}</p>" for note in page.notes]
    head = (
        '<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(page.title)}</title><style>{_STYLE}</style>"
    )
    file = folder / "index.html"
    text = "\n".join(body)
    file.write_text(f'<!doctype html>\n<html lang="en"><head>{head}</head>\n<body>{text}</body></html>\n', "utf-8")
    return file


def _figures(pictures: Sequence[Picture]) -> str:
    made = ""
    for picture in pictures:
        data, caption = base64.b64encode(picture.file.read_bytes()).decode("ascii"), escape(picture.caption)
        image = f'<img alt="{caption}" src="data:image/png;base64,{data}">'
        made += f"<figure>{image}<figcaption>{caption}</figcaption></figure>"
    return f'<div class="figures">{made}</div>'


def _table(table: Table) -> str:
    head = "".join(f"<th>{escape(column)}</th>" for column in table.columns)
    rows = "".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in table.rows)
    return f'<h2>{escape(table.heading)}</h2><div class="wide"><table><tr>{head}</tr>{rows}</table></div>'


def _cell(text: str) -> str:
    try:
        float(text)
    except ValueError:
        return f"<td>{escape(text)}</td>"
    return f'<td class="n">{escape(text)}</td>'
