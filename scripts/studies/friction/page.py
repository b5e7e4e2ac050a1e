"""The page of friction: docs/evidence/friction.md, from hard cases, elastic slip, and test scenes."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from harness.paths import DOCS
from studies import files
from studies import tables as markdown_tables
from studies.friction import stick_points
from studies.hard_cases.outcomes import OURS, Outcome, Table, arranged
from studies.hard_cases.rubbing import CASES
from studies.hard_cases.rubbing_record import FRICTIONLESS, MOST_ITERATIONS
from studies.hard_cases.scene import Fineness
from studies.pages import scene_results
from studies.pages.evidence import DATA, EvidencePage
from studies.pages.scene_results import Row, Took

CASES_SOURCE = "friction-cases.csv"
MODELS_SOURCE = scene_results.DATA.name
RUBS = "friction-"  # what the names of the synthetic test scenes with friction begin with


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    rows = arranged(files.read_csv(DATA / CASES_SOURCE, Outcome))
    models = _models()
    return {
        "beside": beside(models),
        "headline": " ".join(_headline(rows, mesh) for mesh in Fineness),
        "meshes": meshes(rows),
        **stick_points.figures(files.read_csv(DATA / stick_points.SOURCE, stick_points.Datum)),
    }


def tables() -> Mapping[str, str]:
    """Cases with friction and without it, and synthetic test scenes with FEBio's friction and ours."""
    rows = arranged(files.read_csv(DATA / CASES_SOURCE, Outcome))
    return {"friction_cases": "\n".join(_lines(rows)), "friction_scenes": "\n".join(map(_model, _models()))}


def _models() -> list[Row]:
    """Synthetic test scenes with friction."""
    return [row for row in scene_results.read(DOCS / scene_results.DATA).rows if row.name.startswith(RUBS)]


def beside(models: Sequence[Row]) -> str:
    """In how many of the synthetic test scenes ours take at most the iterations of FEBio's interface."""
    converted, defaults = (
        sum(_at_most(took, row.febio) for took, row in pairs)
        for pairs in ([(row.converted, row) for row in models], [(row.defaults, row) for row in models])
    )
    return (
        f"{converted} of {len(models)} scenes take no more iterations than FEBio's interface with the same penalties. "
        f"This holds with the stiffer default penalties for {defaults} scenes."
    )


def _at_most(took: Took, febio: Took) -> bool:
    return took.ended and (not febio.ended or took.iterations <= febio.iterations)


def _model(row: Row) -> str:
    """A row of the table: iterations, and which of the runs take more than FEBio's."""
    runs = {"with its penalties": row.converted, "defaults": row.defaults}
    fewer = ", ".join(name for name, took in runs.items() if not _at_most(took, row.febio))
    cells = (row.about, *map(scene_results.cell, (row.febio, row.converted, row.defaults)), fewer)
    return f"| {' | '.join(cells)} |"


def _on(rows: Table, mesh: Fineness) -> Sequence[tuple[str, Outcome, Outcome]]:
    """Cases on a mesh: name, with friction, without."""
    return [(case, row[OURS], row[FRICTIONLESS]) for (case, each), row in rows.items() if each == mesh.value]


def _headline(rows: Table, mesh: Fineness) -> str:
    return f"{len(_ended(rows, mesh))} of {len(_on(rows, mesh))} scenes complete on the {mesh.value} mesh."


def _ended(rows: Table, mesh: Fineness) -> list[tuple[Outcome, Outcome]]:
    """Runs with friction and without it, of the cases that complete with both."""
    return [(with_it, without) for _, with_it, without in _on(rows, mesh) if with_it.ended and without.ended]


def meshes(rows: Table) -> str:
    """A row for each mesh: iterations over those without friction, and repeated steps."""
    heads = ("mesh", "iterations over those without friction", f"at most {MOST_ITERATIONS:g} times", "more repeats")
    return markdown_tables.markdown(heads, (_mesh(rows, mesh) for mesh in Fineness))


def _mesh(rows: Table, mesh: Fineness) -> tuple[str, ...]:
    ended = _ended(rows, mesh)
    ratios = [with_it.iterations / without.iterations for with_it, without in ended]
    most = sum(ratio <= MOST_ITERATIONS for ratio in ratios)
    more = sum(with_it.retries > without.retries for with_it, without in ended)
    return (mesh.value, f"{min(ratios):.2f} to {max(ratios):.2f}", f"{most} of {len(ended)}", f"{more} of {len(ended)}")


def _lines(rows: Table) -> list[str]:
    """Rows of the table: counts with friction and without, and their ratio, on both meshes."""
    found: dict[str, list[str]] = {}
    for mesh in Fineness:
        for case, with_it, without in _on(rows, mesh):
            ratio = f"{with_it.iterations / without.iterations:.2f}" if with_it.ended and without.ended else "-"
            found.setdefault(case, [CASES[case].about]).extend((with_it.counts, without.counts, ratio))
    return [f"| {' | '.join(cells)} |" for cells in found.values()]


PAGE = EvidencePage(
    "evidence/friction.md",
    (CASES_SOURCE, stick_points.SOURCE, MODELS_SOURCE),
    Path(__file__).with_name("page.md"),
    figures,
)
