"""The page of what accuracy costs: docs/evidence/cost.md, from docs/data/cost.csv."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from harness.errors import DataFileError
from harness.models.interface import InterfaceType
from studies import files
from studies import tables as markdown_tables
from studies.cost import pareto
from studies.cost.point_runs import Datum
from studies.cost.points import INTERFACES, Parameter, Problem
from studies.pages.evidence import DATA, EvidencePage
from studies.stamps import at_limit

SOURCE, PICTURE = "cost.csv", "images/cost.svg"
OURS = InterfaceType.MIXTURE.value


ALIKE = 2.0  # errors within this factor count as the same
NOTES = {
    Problem.CONVECTION: "The whole error of problem 3.2 need not fall with the mesh: the closed form has bodies that "
    "do not deform, and the deformation of these is part of the difference.",
    Problem.INDENTATION: "The reference of problem 3.3 has a finer mesh than any run in the table.",
}
"""What has to be known of a problem to read the tables."""


class Advice(NamedTuple):
    """What one may want, what to set for it, and the point of the sweep that has it."""

    want: str
    setting: str
    parameter: Parameter
    value: float


RECOMMENDED = (
    Advice("a result", "the defaults", Parameter.DEFAULT, 0.0),
    Advice("a softer contact", "`auto_penalty` 1, all three penalties 100", Parameter.PENALTY, 100.0),
    Advice("no gap and no jump", "`laugon` `LAGMULT`", Parameter.LAGMULT, 1.0),
)


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    data = files.read_csv(DATA / SOURCE, Datum)
    problems = [problem for problem in Problem if any(d.problem == problem.value for d in data)]
    return {
        "headline": _headline(data, problems),
        "details": _details(data, problems),
        "recommendation": "\n".join(_recommended(data, problems, advice) for advice in RECOMMENDED),
        "problems": ", ".join(problem.value for problem in problems),
        "failed": _failed(data),
    }


def tables(data: Sequence[Datum]) -> Mapping[str, str]:
    """Errors by mesh and time step, with notes on them, and the least time of each interface for an error."""
    return {
        "discretisation": _discretisation(data),
        "notes": " ".join(NOTES.values()),
        "comparison": pareto.comparison(data),
    }


def _point(data: Sequence[Datum], problem: Problem, parameter: Parameter, value: float) -> Datum:
    wanted = (problem.value, OURS, parameter.value, value)
    found = [d for d in data if (d.problem, d.interface, d.parameter, d.value) == wanted]
    if not found:
        raise DataFileError(f"{SOURCE}: no run of {', '.join(map(str, wanted))}; `cost --docs` writes it")
    return found[0]


def _headline(data: Sequence[Datum], problems: Sequence[Problem]) -> str:
    """In which problems FEBio's best settings take less time, more time, or do not reach the error."""
    found: dict[str, list[str]] = {}
    for problem in problems:
        own = _point(data, problem, Parameter.DEFAULT, 0.0)
        fastest = pareto.fastest(_febio(data, problem), ALIKE * pareto.error_of(own))
        found.setdefault(_compared(own, fastest), []).append(problem.value)
    said = [f"{text} in problem{'s' * (len(names) > 1)} {' and '.join(names)}." for text, names in found.items()]
    return " ".join(said)


def _compared(own: Datum, fastest: Datum | None) -> str:
    if fastest is None:
        return "None of their settings reaches the error of `sliding-mixture`"
    faster = pareto.cost_of(fastest) < pareto.cost_of(own)
    return f"The best settings of FEBio's interfaces take {'less' if faster else 'more'} time"


def _febio(data: Sequence[Datum], problem: Problem) -> list[Datum]:
    return [d for d in pareto.comparable(data, problem) if d.interface != OURS]


def _details(data: Sequence[Datum], problems: Sequence[Problem]) -> str:
    told = []
    for problem in problems:
        own = _point(data, problem, Parameter.DEFAULT, 0.0)
        good = _febio(data, problem)
        told.append(
            f"The defaults of `sliding-mixture` reach an error of {pareto.error_of(own):.0e} in problem "
            f"{problem.value}. They take {own.iterations} iterations and {_time(own)}. {_theirs(own, good)}"
        )
    return (
        f"{' '.join(told)} FEBio's settings count if their error is at most twice that of `sliding-mixture`. All "
        "matrices are non-symmetric."
    )


def _theirs(own: Datum, good: Sequence[Datum]) -> str:
    """What the best of FEBio's settings take for about the same error, and whose run takes less time."""
    error = ALIKE * pareto.error_of(own)
    best, fastest = pareto.cheapest(good, error), pareto.fastest(good, error)
    if best is None or fastest is None:
        return "No setting of FEBio's interfaces reaches this error."
    faster = "FEBio's interface" if pareto.cost_of(fastest) < pareto.cost_of(own) else "`sliding-mixture`"
    return f"FEBio's best settings take {best.iterations} iterations and {_time(fastest)}. {faster} is faster."


def _time(datum: Datum) -> str:
    if datum.problem == Problem.INDENTATION.value:
        return f"{pareto.cost_of(datum):.1f} s"
    return f"{pareto.cost_of(datum):.2f} times the time of one body"


def _recommended(data: Sequence[Datum], problems: Sequence[Problem], advice: Advice) -> str:
    found = [_point(data, problem, advice.parameter, advice.value) for problem in problems]
    errors = ", ".join(f"{pareto.error_of(d):.0e}" for d in found)
    iterations = ", ".join(str(d.iterations) for d in found)
    times = ", ".join(f"{pareto.cost_of(d):.2f}" for d in found)
    return f"| {advice.want} | {advice.setting} | {errors} | {iterations} | {times} |"


def _discretisation(data: Sequence[Datum]) -> str:
    """The whole error with other meshes and steps, as a table."""
    rows = []
    for d in data:
        if d.interface == OURS and d.ended and d.parameter in (Parameter.MESH.value, Parameter.STEP.value):
            contact = "" if d.problem == Problem.INDENTATION.value else f"{d.contact_error:.0e}"
            rows.append((d.problem, d.parameter, f"{d.value:g}", f"{d.error:.1e}", contact, d.iterations))
    heads = ("problem", "changed", "to", "whole error", "error of the contact", "iterations")
    return markdown_tables.markdown(heads, rows) if rows else ""


def _failed(data: Sequence[Datum]) -> str:
    counts = []
    for interface in INTERFACES:
        own = [d for d in data if d.interface == interface.value]
        stopped = sum(at_limit(d.ended, d.cpu) for d in own)
        told = f" ({stopped} of them at the limit)" if stopped else ""
        counts.append(f"{sum(not d.ended for d in own)} of {len(own)} with `{interface.value}`{told}")
    return ", ".join(counts)


PAGE = EvidencePage("evidence/cost.md", (SOURCE,), Path(__file__).with_name("page.md"), figures)
