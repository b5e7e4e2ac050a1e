"""The page of verification: docs/evidence/verification.md, from the checks of `validate` and the thin layers."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from harness.paths import DOCS
from harness.post.compare import Measure
from studies import files
from studies.hertz import elastic_profiles
from studies.hertz.elastic_profiles import ProfileRow
from studies.hertz.growth_records import PROBLEMS, Record, largest_errors
from studies.models.biphasic_hertz import BiphasicHertz
from studies.pages import verification
from studies.pages.evidence import DATA, EvidencePage
from studies.pages.verification import Section

SOURCE, ELASTIC_SOURCE = "biphasic-hertz.csv", "elastic-hertz.csv"
SPLIT = ("split against conforming", "in excess of the conforming reference")
"""In names of measures that compare with the conforming reference."""


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    sections = verification.read(DOCS).sections
    measures = [measure for section in sections for measure in section.measures]
    return {
        "headline": headline(sections),
        "details": details(len(sections)),
        "checks": "\n".join(map(_check, sections)),
        "split": "\n".join(f"| {_cell(m.name)} | {m.value:.2g} |" for m in measures if any(s in m.name for s in SPLIT)),
        "layers": "\n".join(map(_layers, PROBLEMS)),
        "elastic": "\n".join(_line(name, map(abs, found)) for name, found in _elastic_errors()),
    }


HALF = 0.5  # part of its tolerance from which on a figure is near to it


def headline(sections: Sequence[Section]) -> str:
    """How many figures meet the tolerances chosen for them, and how near."""
    measures = [measure for section in sections for measure in section.measures]
    near = sum(_used(measure) > HALF for measure in measures)
    return (
        f"{sum(measure.passed for measure in measures)} of {len(measures)} results meet the tolerances that this "
        f"project chose. {near} results use more than half of their tolerance."
    )


def details(checks: int) -> str:
    """The number of checks, and the largest errors of contacts that have no tolerance."""
    layers = max(error for problem in PROBLEMS for error in _layer_errors(problem).values())
    hertz = max(abs(error) for _, found in _elastic_errors() for error in found)
    return (
        f"The results come from {checks} checks against closed forms, conforming references and balances. Hertz's "
        "contacts have no tolerance and are not among these results. Half-widths, radii and peak pressures of a "
        f"cylinder and a sphere differ from the closed forms by up to {100.0 * hertz:.1f} %. These values of thin "
        f"biphasic layers, whose closed form is asymptotic, differ by up to {100.0 * layers:.1f} %."
    )


def _used(measure: Measure) -> float:
    """Part of its tolerance that a measure uses."""
    return measure.value / measure.tolerance if measure.tolerance else 0.0


def _check(section: Section) -> str:
    """A check with its number of measures, and the one that uses the largest part of its tolerance."""
    met = sum(measure.passed for measure in section.measures)
    most = max(section.measures, key=_used)
    closest = f"{most.value:.3g} of {most.tolerance:.3g}"
    return f"| {_cell(section.about)} | {len(section.measures)} | {met} | {closest} |"


def _layer_errors(problem: BiphasicHertz) -> dict[str, float]:
    rows = [row for row in files.read_csv(DATA / SOURCE, Record) if row.model == problem.name]
    return largest_errors(rows, problem.load.points[1][0])


def _layers(problem: BiphasicHertz) -> str:
    drained = "drain" if problem.draining else "impermeable"
    shape = problem.shape.name.lower()
    name = f"{shape}, {problem.across} by {problem.through} elements in a layer, free surfaces {drained}"
    return _line(name, _layer_errors(problem).values())


def _line(name: str, errors: Iterable[float]) -> str:
    return f"| {name} | " + " | ".join(f"{100.0 * error:.2f} %" for error in errors) + " |"


def _elastic_errors() -> list[tuple[str, tuple[float, float]]]:
    """By problem and mesh: relative errors of half-width or radius, and of the peak."""
    rows = files.read_csv(DATA / ELASTIC_SOURCE, ProfileRow)
    return [
        (f"{problem}, {mesh}", elastic_profiles.errors([r for r in rows if (r.problem, r.mesh) == (problem, mesh)]))
        for problem, mesh in dict.fromkeys((row.problem, row.mesh) for row in rows)
    ]


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


PAGE = EvidencePage(
    "evidence/verification.md",
    ("verification.json", SOURCE, ELASTIC_SOURCE),
    Path(__file__).with_name("page.md"),
    figures,
)
