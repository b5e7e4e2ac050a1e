"""The verification report: every check of `validate` with its runs, as docs/verification.json and a page of it."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

from harness.errors import DataFileError
from harness.models.document import Model
from harness.models.parts import text_of
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from harness.validate.checks import Check, Context
from harness.validate.results import measures_as_data, measures_from_data
from studies import tables
from studies.pages.texts import page_text
from studies.stamps import Stamp

PAGE, DATA = "reference/verification-report.md", "data/verification.json"


@dataclass(frozen=True)
class Run:
    """A run behind a figure."""

    model: str
    mesh: str
    steps: str
    contact: str
    tolerances: str  # name, and the rest as the page shows it
    iterations: int


@dataclass(frozen=True)
class Section:
    """A check: its name and what it does in one line, its measures, its runs."""

    name: str
    about: str
    measures: list[Measure]
    runs: list[Run]


@dataclass(frozen=True)
class Report:
    """Everything on the page, and what it was made with."""

    stamp: Stamp
    sections: list[Section]


@dataclass
class Recorder(Runner):
    """A runner that notes what was run."""

    results_: list[RunResult] = field(default_factory=list)

    def __call__(self, model: Model, *, options: Sequence[str] = (), check: bool = True) -> RunResult:
        """As `Runner`."""
        result = super().__call__(model, options=options, check=check)
        self.results_.append(result)
        return result


def make(root: Path, checks: Sequence[Check]) -> Iterator[Section]:
    """Make the checks one after the other, with runs below `root`."""
    for check in checks:
        recorder = Recorder(root)
        measures = check.run(Context(recorder))
        unique = {result.folder: result for result in recorder.results_}
        yield Section(check.name, check.about, measures, [_run(result) for result in unique.values()])


def _run(result: RunResult) -> Run:
    model = result.model
    kinds = " and ".join(sorted({f"hex{part.elements.shape[1]}" for part in model.mesh.parts}))
    elements = sum(len(part.elements) for part in model.mesh.parts)
    control = model.control
    tolerances = {"dtol": control.displacement_tolerance, "ptol": control.pressure_tolerance}
    if model.n_solutes:
        tolerances["ctol"] = control.concentration_tolerance
    return Run(
        model=model.name,
        mesh=f"{elements} {kinds}, {len(model.mesh.nodes)} nodes",
        steps=f"{result.report.steps} adaptive" if control.stepper else f"{control.steps} of {control.step:g} s",
        contact="; ".join(_settings(model)) or "none: one body",
        tolerances=", ".join(f"{name} {value:g}" for name, value in tolerances.items()),
        iterations=result.report.iterations,
    )


def _settings(model: Model) -> list[str]:
    """Each contact with the parameters that its model gives."""
    given = [", ".join(f"`{p.tag}` {text_of(p.value)}" for p in contact.params) for contact in model.contacts]
    kinds = [contact.kind for contact in model.contacts]
    return [f"`{kind}`, {params or 'defaults'}" for kind, params in zip(kinds, given, strict=True)]


def write(folder: Path, report: Report) -> list[Path]:
    """Write data and page into `folder`, which is made where needed."""
    for name in (PAGE, DATA):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
    sections = [asdict(s) | {"measures": measures_as_data(s.measures)} for s in report.sections]
    data = {"stamp": asdict(report.stamp), "sections": sections}
    (folder / DATA).write_text(json.dumps(data, indent=1, allow_nan=False) + "\n")
    (folder / PAGE).write_text(page(report), encoding="utf-8")
    return [folder / PAGE, folder / DATA]


def read(folder: Path) -> Report:
    """Read what `write` wrote. Raises DataFileError: a missing file, or one that is not such a file."""
    path = folder / DATA
    try:
        data = json.loads(path.read_text())
        sections = [
            Section(s["name"], s["about"], measures_from_data(s["measures"]), [Run(**run) for run in s["runs"]])
            for s in data["sections"]
        ]
        return Report(Stamp(**data["stamp"]), sections)
    except OSError as error:
        raise DataFileError(f"cannot read {path}: {error.strerror}; `report` writes it") from error
    except (json.JSONDecodeError, KeyError, TypeError) as error:
        raise DataFileError(f"{path}: {error}; `report` writes it anew") from error


def page(report: Report) -> str:
    """The text of the page."""
    introduction = page_text("verification").rstrip().format(stamp=report.stamp)
    return "\n\n".join([introduction, *map(_text, report.sections)]) + "\n"


def _text(section: Section) -> str:
    """One check. Its command repeats it alone; what needs no run has no table of runs."""
    command = f"```console\nscripts/mixcontact validate --only {section.name}\n```"
    parts = [f"## {section.name}", section.about, command, _measures(section.measures)]
    return "\n\n".join(parts + ([_runs(section.runs)] if section.runs else []))


def _measures(measures: list[Measure]) -> str:
    rows = []
    for m in measures:
        tolerance = f"<= {m.tolerance:.4g}" if m.lowest == -float("inf") else f"{m.lowest:.4g} to {m.tolerance:.4g}"
        rows.append((m.name, f"{m.value:.4g}", tolerance, "met" if m.passed else "**missed**"))
    return tables.markdown(("result", "measured", "tolerance", "outcome"), rows)


def _runs(runs: list[Run]) -> str:
    heads = ("model", "mesh", "steps", "contact", "tolerances", "iterations")
    return tables.markdown(heads, ((r.model, r.mesh, r.steps, r.contact, r.tolerances, r.iterations) for r in runs))
