"""The page of the gallery and the numbers on it: docs/gallery.md and docs/data/gallery.json."""

import json
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.models.document import Model
from harness.run.runner import RunResult
from studies import tables
from studies.pages.gallery import cycle, entries, friction
from studies.pages.gallery.entries import Entry
from studies.pages.texts import page_text
from studies.stamps import Stamp

PAGE, DATA, IMAGES = "gallery.md", "data/gallery.json", "images/gallery"


@dataclass(frozen=True)
class Record:
    """What a run took."""

    nodes: int
    elements: int
    steps: int
    iterations: int
    retries: int
    cpu: float  # processor time, s, one thread


@dataclass(frozen=True)
class Results:
    """The numbers of runs by the names of their models, and what they were made with."""

    stamp: Stamp
    records: Mapping[str, Record]


def record(result: RunResult) -> Record:
    """The numbers of a run."""
    report, mesh = result.report, result.model.mesh
    elements = sum(len(part.elements) for part in mesh.parts)
    counts = (len(mesh.nodes), elements, report.steps, report.iterations, report.retries)
    return Record(*counts, round(result.cpu, 1))


def read(folder: Path) -> Results:
    """What `write` wrote into `folder`. Raises DataFileError: a missing file, or one that holds no such results."""
    path = folder / DATA
    try:
        data = json.loads(path.read_text())
        return Results(Stamp(**data["stamp"]), {name: Record(**entry) for name, entry in data["models"].items()})
    except (OSError, json.JSONDecodeError, KeyError, TypeError, AttributeError) as error:
        raise DataFileError(f"{path} holds no results ({error}); `gallery` writes it") from error


def made_alike(folder: Path, stamp: Stamp) -> dict[str, Record]:
    """The records in `folder`; none where they were made with something else, or no file is."""
    try:
        known = read(folder)
    except DataFileError:
        return {}
    return dict(known.records) if known.stamp == stamp else {}


def write(folder: Path, results: Results) -> list[Path]:
    """Write results and page into `folder`, in the order of the gallery."""
    records = results.records
    models = {entry.model.name: asdict(records[entry.model.name]) for entry in _recorded(records)}
    data = {"stamp": asdict(results.stamp), "models": models}
    (folder / DATA).parent.mkdir(parents=True, exist_ok=True)
    (folder / DATA).write_text(json.dumps(data, indent=1) + "\n")
    (folder / PAGE).write_text(page(results), encoding="utf-8")
    return [folder / PAGE, folder / DATA]


def _recorded(records: Mapping[str, Record]) -> list[Entry]:
    return [entry for entry in entries.ENTRIES if entry.model.name in records]


def page(results: Results) -> str:
    """The text of the page, with those models that have a record; friction has pictures of its own."""
    entries = _recorded(results.records)
    rubbing = zip(friction.MODELS, friction.PICTURES.items(), strict=True)
    sections = [*map(_section, entries), "## Friction", *(_pictured(model, *shown) for model, shown in rubbing)]
    return "\n\n".join([page_text("gallery").rstrip(), _table(entries, results), *sections]) + "\n"


def _table(entries: list[Entry], results: Results) -> str:
    heads = ("model", "nodes", "elements", "steps", "iterations", "retries", "processor time [s]")
    rows = []
    for entry in entries:
        r = results.records[entry.model.name]
        anchor = re.sub(r"[^\w\- ]", "", entry.title.lower()).replace(" ", "-")  # as MkDocs and GitHub make it
        counts = (r.nodes, r.elements, r.steps, r.iterations, r.retries, f"{r.cpu:g}")
        rows.append((f"[{entry.title}](#{anchor})", *counts))
    return f"{tables.markdown(heads, rows)}\n\nThe runs used {results.stamp}. Only the last model sets a penalty."


def _section(entry: Entry) -> str:
    name = entry.model.name
    pictures = {f"{name}-section.png": "Concentration in a section"}
    if name == cycle.MODEL:
        pictures[cycle.PICTURE] = cycle.TITLE
    shown_curves = "Solute, concentrations and force" if entry.driven else "Solute and concentrations"
    pictures[f"{name}-curves.png"] = f"{shown_curves} over time"
    shown = "\n\n".join(f"![{alt}]({IMAGES}/{picture})" for picture, alt in pictures.items())
    return f"""\
## {entry.title}

{entry.start_here}

```console
scripts/mixcontact run models/{name}.feb
```

{shown}"""


def _pictured(model: Model, picture: str, alt: str) -> str:
    """A model with its one picture, and a description of that; the head of its file begins with what it shows."""
    run = f"```console\nscripts/mixcontact run models/{model.name}.feb\n```"
    shows = model.header.split("\n\n")[0]
    return f"{shows}\n\n{run}\n\n![{alt}]({IMAGES}/{picture})"
