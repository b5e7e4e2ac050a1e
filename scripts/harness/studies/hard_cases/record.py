"""One run of a hard case as data, and the table of all of them."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from harness.errors import DataFileError, HarnessError
from harness.post.compare import Measure
from harness.run import diagnosis, febio_log
from harness.run.runner import Runner, RunResult
from harness.studies.hard_cases import invariants
from harness.studies.hard_cases.catalogue import CASES
from harness.studies.hard_cases.scene import Fineness, Interface
from harness.validate.results import measures_as_data, measures_from_data


@dataclass(frozen=True)
class Record:
    """What came of a case on one mesh with one interface.

    Attributes
    ----------
    case, mesh, interface : str
    ended : bool
        Whether the run ended normally.
    reached : float
        Part of the case's time that was reached.
    steps, iterations, residuals, retries : int
    failures : str
        How attempts failed.
    measures : list of Measure
        All checks that could be made.
    """

    case: str
    mesh: str
    interface: str
    ended: bool
    reached: float
    steps: int
    iterations: int
    residuals: int
    retries: int
    failures: str
    measures: list[Measure]

    @property
    def missed(self) -> list[Measure]:
        """The measures that miss their tolerances."""
        return [measure for measure in self.measures if not measure.passed]

    @property
    def passed(self) -> bool:
        """Whether the run ended and all checks are met."""
        return self.ended and not self.missed

    @property
    def key(self) -> tuple[str, str, str]:
        """Case, mesh, interface."""
        return self.case, self.mesh, self.interface


def make(runner: Runner, name: str, mesh: Fineness, interface: Interface) -> Record:
    """Run a case and check it.

    Raises
    ------
    HarnessError
        For an unknown case, or without an engine or plugin.
    """
    if name not in CASES:
        raise HarnessError(f"'{name}' is no hard case; there is {', '.join(CASES)}")
    case = CASES[name]
    run = runner(case.scene.model(mesh, interface), check=False)
    report = run.report
    measures: list[Measure] = []
    if report.normal:
        try:
            measures = [*case.scene.check(run, runner), *invariants.of_any_run(run, case)]
            measures += invariants.of_the_plugin(run, runner, case) if interface is Interface.MIXTURE else []
        except HarnessError as error:
            measures.append(Measure("a further run that a check needs", float("nan"), 0.0, note=str(error)))
    return Record(
        name,
        mesh.value,
        interface.value,
        report.normal,
        _reached(run),
        report.steps,
        report.iterations,
        report.residuals,
        report.retries,
        diagnosis.summary(run.log),
        measures,
    )


def _reached(run: RunResult) -> float:
    """Part of a run's time after which a step last converged."""
    times = febio_log.CONVERGED.findall(run.log)
    control = run.model.control
    return min(1.0, float(times[-1]) / (control.end or control.steps * control.step)) if times else 0.0


def write(records: Sequence[Record], path: Path) -> None:
    """Write records as JSON."""
    path.parent.mkdir(parents=True, exist_ok=True)
    data = [asdict(record) | {"measures": measures_as_data(record.measures)} for record in records]
    path.write_text(json.dumps(data, indent=1))


def read(path: Path) -> list[Record]:
    """Read what `write` wrote.

    Raises
    ------
    DataFileError
        A missing file, or one that holds no such records.
    """
    try:
        entries = json.loads(path.read_text())
        return [Record(**e | {"measures": measures_from_data(e["measures"])}) for e in entries]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(f"{path} holds no records of a hard case ({error}); `hard-cases` writes it anew") from error


def write_csv(records: Sequence[Record], path: Path) -> None:
    """Write records as a table, each with the checks that it misses."""
    names = ("case", "mesh", "interface", "ended", "steps", "iterations", "residuals", "retries")
    with path.open("w", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow([*names, "missed"])
        for record in records:
            values = asdict(record)
            rows.writerow([*(values[name] for name in names), "; ".join(map(_short, record.missed))])


HEADINGS = {"sliding-mixture": "`sliding-mixture`", "febio-1": "FEBio, factor 1", "febio-1000": "FEBio, factor 1000"}


def table(records: Sequence[Record]) -> str:
    """A Markdown table: a row for each case and mesh, a column for each interface."""
    found = {record.key: record for record in records}
    lines = [
        "| case | mesh | " + " | ".join(HEADINGS.values()) + " | what `sliding-mixture` misses |",
        "|---|---|" + "---|" * (len(HEADINGS) + 1),
    ]
    for name, case in CASES.items():
        for mesh in Fineness:
            row = [found.get((name, mesh.value, interface)) for interface in HEADINGS]
            if not any(row):
                continue
            missed = "; ".join(_short(m) for m in row[0].missed) if row[0] else ""
            cells = " | ".join(_cell(record) for record in row)
            lines.append(f"| {case.about} | {mesh.value} | {cells} | {missed} |")
    return "\n".join(lines)


def _short(measure: Measure) -> str:
    note = f"; {measure.note}" if measure.note else ""
    return f"{measure.name} {measure.value:.2g} (tolerance {measure.tolerance:.2g}{note})"


def _cell(record: Record | None) -> str:
    """RunResult, and steps / iterations / retries."""
    if record is None:
        return "not run"
    if _timed_out(record):
        return f"ended by its limit, {record.steps} / - / {record.retries}"
    result = "passes" if record.passed else f"misses {len(record.missed)}" if record.ended else "fails"
    return f"{result}, {record.steps} / {record.iterations} / {record.retries}"


def _timed_out(record: Record) -> bool:
    """Whether the run was ended by its limit of time: FEBio then writes no summary with the number of iterations."""
    return not record.ended and record.iterations == 0


def summary(records: Sequence[Record]) -> str:
    """How many runs end, fail, are ended by their limit and pass, and the steps tried again, for each interface."""
    columns = ("interface", "runs", "end", "fail", "ended by the limit", "pass all checks", "retries")
    lines = ["| " + " | ".join(columns) + " |", "|---" * len(columns) + "|"]
    for interface, heading in HEADINGS.items():
        own = [record for record in records if record.interface == interface]
        ended, limited, passed = sum(r.ended for r in own), sum(map(_timed_out, own)), sum(r.passed for r in own)
        failed = len(own) - ended - limited
        counts = (len(own), ended, failed, limited, passed, sum(r.retries for r in own))
        lines.append(f"| {heading} | " + " | ".join(map(str, counts)) + " |")
    return "\n".join(lines)
