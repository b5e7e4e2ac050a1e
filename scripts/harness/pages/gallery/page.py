"""The page of the gallery and the numbers on it: docs/gallery.md and docs/gallery.json."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.models.document import Model
from harness.pages.gallery import entries, friction
from harness.pages.gallery.entries import Entry
from harness.run import provenance
from harness.run.runner import RunResult

PAGE, DATA, IMAGES = "gallery.md", "data/gallery.json", "images/gallery"


@dataclass(frozen=True)
class Record:
    """What a run took.

    Attributes
    ----------
    plugin, engine : str
        Versions.
    nodes, elements, steps, iterations, retries : int
    cpu : float
        Processor time, s, one thread.
    """

    plugin: str
    engine: str
    nodes: int
    elements: int
    steps: int
    iterations: int
    retries: int
    cpu: float


def record(result: RunResult) -> Record:
    """The numbers of a run."""
    report, mesh = result.report, result.model.mesh
    elements = sum(len(part.elements) for part in mesh.parts)
    versions = provenance.plugin_version(), provenance.engine_version(result.log)
    counts = (len(mesh.nodes), elements, report.steps, report.iterations, report.retries)
    return Record(*versions, *counts, round(result.cpu, 1))


def read(folder: Path) -> dict[str, Record]:
    """The records in `folder`, none where no file is.

    Raises
    ------
    DataFileError
        For a file that is not what `write` writes.
    """
    path = folder / DATA
    if not path.exists():
        return {}
    try:
        return {name: Record(**entry) for name, entry in json.loads(path.read_text()).items()}
    except (json.JSONDecodeError, TypeError, AttributeError) as error:
        raise DataFileError(f"{path}: {error}; `gallery` writes it anew where it is removed") from error


def write(folder: Path, records: Mapping[str, Record]) -> list[Path]:
    """Write records and page into `folder`, in the order of the gallery."""
    data = {entry.model.name: asdict(records[entry.model.name]) for entry in _recorded(records)}
    (folder / DATA).parent.mkdir(parents=True, exist_ok=True)
    (folder / DATA).write_text(json.dumps(data, indent=1) + "\n")
    (folder / PAGE).write_text(page(records), encoding="utf-8")
    return [folder / PAGE, folder / DATA]


def _recorded(records: Mapping[str, Record]) -> list[Entry]:
    return [entry for entry in entries.entries() if entry.model.name in records]


def page(records: Mapping[str, Record]) -> str:
    """The text of the page, with those models that have a record."""
    entries = _recorded(records)
    sections = [*(_section(entry) for entry in entries), _friction()]
    return "\n\n".join([_INTRODUCTION, _table(entries, records), *sections]) + "\n"


_INTRODUCTION = """\
# Gallery

<!-- Written by `scripts/mixcontact gallery --folder docs`: change scripts/harness/pages/gallery/entries.py instead. -->

Models to start from, each a file in `models/` whose head says what is prescribed, its units and how to run it. All use
mm, N, s, nmol and K; hence MPa, mM = nmol/mm³, mm⁴/(N s) for permeabilities and mm²/s for diffusivities. The pictures
show the effective concentration over the deformed bodies.

To make one your own, copy its file, change it and run the copy. To change the mesh as well, the builders are in
`scripts/harness/models`. This runs all of them, draws the pictures and writes this page:

```console
scripts/mixcontact gallery --folder docs
```

The same with fewer elements and steps goes to `results/gallery`:

```console
scripts/mixcontact gallery --small
```"""


def _table(entries: list[Entry], records: Mapping[str, Record]) -> str:
    lines = [
        "| model | nodes | elements | steps | iterations | retries | processor time [s] |",
        "|---|---|---|---|---|---|---|",
    ]
    for entry in entries:
        r = records[entry.model.name]
        lines.append(
            f"| [{entry.title}](#{_anchor(entry.title)}) | {r.nodes} | {r.elements} | {r.steps} | {r.iterations} | "
            f"{r.retries} | {r.cpu:g} |"
        )
    versions = sorted({f"plugin {r.plugin}, {r.engine}" for r in records.values()})
    lines += [
        "",
        f"Run with {' and '.join(versions)}, default penalties, one thread of a machine shared with other work.",
    ]
    return "\n".join(lines)


def _anchor(title: str) -> str:
    """What MkDocs and GitHub make of a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def _section(entry: Entry) -> str:
    name = entry.model.name
    first_paragraph = _about(entry.model).split("\n\n")[0]
    return f"""\
## {entry.title}

{first_paragraph}

{entry.start_here}

```console
scripts/mixcontact run models/{name}.feb
```

![Effective concentration over the deformed bodies]({IMAGES}/{name}-section.png)

![{_curves(entry)}]({IMAGES}/{name}-curves.png)"""


def _friction() -> str:
    """The section on friction, whose pictures are of their own."""
    shown = zip(friction.MODELS, friction.PICTURES.items(), strict=True)
    return "\n\n".join(["## Friction", *(_pictured(model, picture, alt) for model, (picture, alt) in shown)])


def _pictured(model: Model, picture: str, alt: str) -> str:
    """A model with its one picture, and a description of that."""
    run = f"```console\nscripts/mixcontact run models/{model.name}.feb\n```"
    return f"{_about(model)}\n\n{run}\n\n![{alt}]({IMAGES}/{picture})"


def _curves(entry: Entry) -> str:
    force = ", force" if entry.driven else ""
    return f"Over time: solute in each body, concentration on the two sides of the contact{force}"


def _about(model: Model) -> str:
    """What the head of the model file says it shows, without its title line, units and commands."""
    paragraphs = model.header.split("\n\n")
    return "\n\n".join(paragraphs[:-2])
