"""The pages of the synthetic test scenes, from their results alone."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from studies import files, tables
from studies.files import Stamped
from studies.pages.texts import page_text

PAGE, ALL = "evidence/synthetic-scenes.md", "reference/synthetic-scenes.md"
DATA = Path("data", "synthetic-scenes.json")  # below docs/

HEAD = page_text("synthetic-scenes")
ALL_HEAD = page_text("synthetic-scenes-all")


FINER = (("elements-hex8", "finer"), ("biphasic", "biphasic-finer"), ("explicit", "explicit-finer"))
"""Scenes on two meshes, one twice as fine as the other."""
MOST = 1.2  # iterations over FEBio's, at most, in any scene
COLUMNS = (
    *("scene", "description", "FEBio", "converted", "displacements differ by", "fields differ by"),
    *("penalties deleted", "with `predictor` 1", "worse in"),
)
AT_LIMIT = "ended by the limit"  # why a run did not end that took all of its processor time
NOT_MADE = "not run"  # why there is no run where nobody asked for it
UNAVAILABLE = "not available in models with rigid bodies"  # what the plugin says of the predictor there


@dataclass(frozen=True)
class Took:
    """What a run took."""

    ended: bool
    steps: int = 0
    iterations: int = 0
    retries: int = 0
    difference: float = math.nan
    """Largest difference of displacements of the last state from that of FEBio's interface, relative to the largest
    displacement; 0 for FEBio's interface itself, not a number where a run did not end."""
    of_fields: float = math.nan
    """The same of pressure and concentrations, the largest of them; not a number where there are none."""
    why: str = ""  # why there is no run, or why it failed; `AT_LIMIT` where the limit ended it

    @property
    def at_limit(self) -> bool:
        """Whether the limit ended it."""
        return self.why == AT_LIMIT

    @property
    def available(self) -> bool:
        """Whether the plugin takes the model with the predictor."""
        return UNAVAILABLE not in self.why

    @property
    def made(self) -> bool:
        """Whether there was a run at all."""
        return self.why != NOT_MADE


NOT_RUN = Took(ended=False, why=NOT_MADE)  # stands for a run that nobody made


@dataclass(frozen=True)
class Row:
    """A scene and its runs: with FEBio's interface, converted, without penalties, and so with the predictor."""

    name: str
    about: str
    febio: Took
    converted: Took = NOT_RUN
    defaults: Took = NOT_RUN
    predicted: Took = NOT_RUN

    def worse(self, ours: Took) -> str:
        """In what a run of ours is worse than FEBio's; empty where in nothing."""
        if not self.febio.ended or not ours.made:
            return ""
        if not ours.ended:
            return ours.why or "does not end"
        found = ["more retries"] if ours.retries > self.febio.retries else []
        if ours.iterations > MOST * self.febio.iterations:
            found.append("more iterations")
        return ", ".join(found)


Results = Stamped[Row]


def read(path: Path) -> Results:
    """Read what the command wrote, as `files.read_stamped` does."""
    return files.read_stamped(path, _row, "synthetic-scenes --docs")


def _row(name: str, about: str, **runs: dict[str, bool | int | float | str]) -> Row:
    return Row(name, about, **{run: Took(**took) for run, took in runs.items()})  # type: ignore[arg-type]


def page(results: Results) -> str:
    """The page of evidence: what it comes to, and the scenes in which a run of ours is worse."""
    rows = results.rows
    told = [row for row in rows if not row.febio.ended or row.worse(row.converted) or row.worse(row.defaults)]
    return HEAD.format(stamp=results.stamp, summary=summary(rows), finer=finer(rows), table=table(told))


def all_scenes(results: Results) -> str:
    """The page with a row for each scene."""
    return ALL_HEAD.format(stamp=results.stamp, table=table(results.rows))


def finer(rows: Sequence[Row]) -> str:
    """How the difference falls with the mesh, of the scenes that are there on two meshes."""
    difference = {row.name: row.converted.difference for row in rows}
    pairs = [(one, two) for one, two in FINER if one in difference and two in difference]
    cells = [(f"`{one}`", _percent(difference[one]), f"`{two}`", _percent(difference[two])) for one, two in pairs]
    return tables.markdown(("scene", "differ by", "elements of half the size", "differ by"), cells)


def _percent(part: float, digits: int = 1) -> str:
    return f"{100.0 * part:.{digits}f} %"


def table(rows: Sequence[Row]) -> str:
    """A Markdown table, a row for each scene: iterations, and retries in brackets where there are any."""
    return tables.markdown(COLUMNS, map(_cells, rows))


def _cells(row: Row) -> tuple[str, ...]:
    apart = (_number(row.converted.difference), _number(row.converted.of_fields))
    found = worse(row, {"converted": "converted", "defaults": "penalties deleted"})
    return (
        row.name,
        row.about,
        *map(cell, (row.febio, row.converted)),
        *apart,
        *map(cell, (row.defaults, row.predicted)),
        found,
    )


def worse(row: Row, ways: Mapping[str, str]) -> str:
    """In what each of some runs of ours is worse than FEBio's, by the titles of the runs."""
    return "; ".join(f"{title}: {what}" for way, title in ways.items() if (what := row.worse(getattr(row, way))))


def _number(difference: float) -> str:
    return "" if math.isnan(difference) else f"{difference:.1e}"


def cell(took: Took) -> str:
    """Iterations, with retries in brackets; of a run that did not end, how far it came."""
    if not took.made:
        return ""
    retries = f" ({took.retries})" if took.retries else ""
    if took.ended:
        return f"{took.iterations}{retries}"
    if not took.available:
        return "not available"
    return f"{'limit' if took.at_limit else 'fails'} after {took.steps} steps{retries}"


def summary(rows: Sequence[Row]) -> str:
    """How many scenes end, how many are no worse than FEBio's, and what the limit and the predictor do."""
    sound = [row for row in rows if row.febio.ended]
    own = f"FEBio's interface completes {len(sound)} of {len(rows)} scenes. The table counts runs of these:"
    ways = {"converted": [row.converted for row in sound], "penalties deleted": [row.defaults for row in sound]}
    heads = ("model", "completes", "at most FEBio's iterations", "worse")
    counts = tables.markdown(heads, ((name, *_counts(sound, runs)) for name, runs in ways.items()))
    worse = f"A worse run fails, has more retries, or takes more than {MOST} times the iterations."
    return "\n\n".join([own, counts, worse, f"{_apart(sound)} {_predictor(rows)} {_limit(rows)}".strip()])


def _counts(rows: Sequence[Row], runs: Sequence[Took]) -> tuple[int, int, int]:
    """Runs that complete, those with at most FEBio's iterations, and those that are worse than FEBio's."""
    pairs = list(zip(rows, runs, strict=True))
    fewer = sum(run.ended and run.iterations <= row.febio.iterations for row, run in pairs)
    return sum(run.ended for run in runs), fewer, sum(bool(row.worse(run)) for row, run in pairs)


def _apart(rows: Sequence[Row]) -> str:
    both = [row.converted for row in rows if row.converted.ended]
    displacements = sorted(took.difference for took in both if not math.isnan(took.difference))
    fields = [took.of_fields for took in both if not math.isnan(took.of_fields)]
    if not displacements or not fields:
        return ""
    return (
        f"The largest difference of a displacement is {_percent(median(displacements))} of the "
        f"largest displacement in the median, and at most {_percent(displacements[-1], 0)}. The largest difference of "
        f"a field is {_percent(min(fields), 0)} to {_percent(max(fields), 0)} of its largest value in {len(fields)} "
        "porous scenes. [Another page](agreement.md) shows which answer is nearer to that of a fine mesh."
    )


def _predictor(rows: Sequence[Row]) -> str:
    runs = [(row.defaults, row.predicted) for row in rows if row.predicted.available]
    both = [(plain, predicted) for plain, predicted in runs if plain.ended and predicted.ended]
    without, with_it = sum(plain.iterations for plain, _ in both), sum(predicted.iterations for _, predicted in both)
    return (
        f"The predictor is available in {len(runs)} scenes. {sum(took.ended for _, took in runs)} of these complete. "
        f"The {len(both)} scenes that complete in both ways take {with_it} iterations with the predictor and {without} "
        "without."
    )


def _limit(rows: Sequence[Row]) -> str:
    ways = ("febio", "converted", "defaults", "predicted")
    counts = [sum(getattr(row, way).at_limit for row in rows) for way in ways]
    names = ("FEBio's", "converted", "penalties deleted", "with the predictor")
    told = ", ".join(f"{name} {count}" for name, count in zip(names, counts, strict=True) if count)
    return f"The limit stopped runs: {told}." if told else "The limit stopped no run."
