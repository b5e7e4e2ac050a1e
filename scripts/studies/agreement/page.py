"""The page of how far a converted model's answer is from the old one: docs/evidence/agreement.md, from its data."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from studies import files
from studies import tables as markdown_tables
from studies.agreement.comparisons import FEBIO, MESHES, OURS, Row
from studies.agreement.quantities import FACETS_AREA
from studies.files import Stamped
from studies.pages.evidence import DATA
from studies.pages.texts import page_text

SOURCE, PAGE, ALL = "agreement.json", "evidence/agreement.md", "reference/agreement.md"
NUMBERS, FIELDS = "forces, approaches, areas and contents", "fields (L2)"

HEAD = page_text("agreement")

ALL_HEAD = page_text("agreement-all")


Results = Stamped[Row]


def read() -> Results:
    """The results in docs/data."""
    return files.read_stamped(DATA / SOURCE, Row, "agreement --docs")


def page(results: Results) -> str:
    """The page."""
    rows = results.rows
    return HEAD.format(headline=headline(rows), details=details(rows), stamp=results.stamp, coarse=coarse(rows))


def all_meshes(results: Results) -> str:
    """The page with a table for each scene."""
    return ALL_HEAD.format(stamp=results.stamp, tables=tables(results.rows))


def coarse(rows: Sequence[Row]) -> str:
    """A table of the coarsest mesh, a row for each quantity."""
    cells = (
        (febio.scene, febio.quantity, _error(febio), _error(ours), _percent(febio.apart))
        for febio, ours in ((pair.febio, pair.ours) for pair in pairs(rows))
        if febio.quantity != FACETS_AREA
    )
    return markdown_tables.markdown(("scene", "quantity", "error: FEBio's", "converted", "apart"), cells)


def _error(row: Row) -> str:
    return _percent(row.error) if math.isnan(row.rms) else f"{_percent(row.rms)} ({_percent(row.error)})"


@dataclass(frozen=True)
class Pair:
    """A quantity on the coarsest mesh by both interfaces."""

    febio: Row
    ours: Row

    @property
    def number(self) -> bool:
        """Whether it is a number, and not a field."""
        return math.isnan(self.febio.rms)

    @property
    def errors(self) -> tuple[float, float]:
        """FEBio's and ours: of a field by L2."""
        return (self.febio.error, self.ours.error) if self.number else (self.febio.rms, self.ours.rms)


def pairs(rows: Sequence[Row], fineness: int = 1) -> list[Pair]:
    """Quantities of all scenes on one mesh."""
    own = {(row.scene, row.quantity, row.interface): row for row in rows if row.fineness == fineness}
    keys = dict.fromkeys((scene, quantity) for scene, quantity, _ in own)
    return [Pair(own[scene, quantity, FEBIO], own[scene, quantity, OURS]) for scene, quantity in keys]


def headline(rows: Sequence[Row]) -> str:
    """Not the same answer: by how much both are off, and which one is nearer how often."""
    own = [pair for pairs in _kinds(rows).values() for pair in pairs]
    nearer = sum(febio < ours for febio, ours in _errors(own))
    left = [2.0 * pair.febio.apart for pair in own]
    return (
        f"The answers differ by {100 * median(left):.1f} % in the median and by up to {100 * max(left):.0f} % on the "
        f"finest mesh. FEBio's answer on a coarse mesh is nearer to the fine one in {nearer} of {len(own)} quantities."
    )


def details(rows: Sequence[Row]) -> str:
    """How often ours is nearer, and smallest and largest errors of both interfaces on the coarse mesh."""
    kinds = _kinds(rows)
    counts = [f"{sum(a > b for a, b in _errors(own))} of {len(own)} {name}" for name, own in kinds.items()]
    told = [f"The converted model is nearer to the fine answer in {' and in '.join(counts)}."]
    for name, own in _kinds(rows).items():
        theirs, ours = zip(*_errors(own), strict=True)
        told.append(
            f"Errors of {name} are {_span(ours)} in the converted model and {_span(theirs)} with FEBio's interface."
        )
    return " ".join(told)


def _kinds(rows: Sequence[Row]) -> dict[str, list[Pair]]:
    """Numbers and fields on the coarse mesh, by name."""
    found = pairs(rows)
    numbers = [pair for pair in found if pair.number and pair.febio.quantity != FACETS_AREA]
    return {NUMBERS: numbers, FIELDS: [pair for pair in found if not pair.number]}


def _errors(own: Sequence[Pair]) -> list[tuple[float, float]]:
    return [pair.errors for pair in own]


def _span(values: Sequence[float]) -> str:
    return f"{100 * min(values):.1f} to {100 * max(values):.1f} %"


def tables(rows: Sequence[Row]) -> str:
    """A table for each scene."""
    scenes = [scene for scene in MESHES if any(row.scene == scene for row in rows)]
    return "\n\n".join(_table(scene, [row for row in rows if row.scene == scene]) for scene in scenes)


def _table(scene: str, rows: Sequence[Row]) -> str:
    head = "| quantity | mesh | FEBio's | converted | error: FEBio's | converted | mean | | L2 | | apart |"
    lines = [_line(pair) for fineness in dict.fromkeys(row.fineness for row in rows) for pair in pairs(rows, fineness)]
    numbers_first = sorted(lines, key=lambda line: ("[" not in line.split("|")[1], line))
    return "\n".join([f"## `{scene}`", "", head, "|---" * 11 + "|", *numbers_first])


def _line(pair: Pair) -> str:
    one, two = pair.febio, pair.ours
    values = (f"{one.value:.4g}", f"{two.value:.4g}") if pair.number else ("", "")
    errors = (_percent(one.error), _percent(two.error))
    norms = tuple(_percent(value) for value in (one.mean, two.mean, one.rms, two.rms))
    cells = (one.quantity, f"{one.fineness}", *values, *errors, *norms, _percent(one.apart))
    return "| " + " | ".join(cells) + " |"


def _percent(value: float) -> str:
    return "" if math.isnan(value) else f"{100 * value:.2f} %"
