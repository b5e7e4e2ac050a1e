"""One run of a hard case as data, and the table of all of them."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from harness.errors import DataFileError, HarnessError
from harness.post.compare import Measure
from harness.run import febio_log
from harness.run.runner import Runner, RunResult
from harness.validate.results import measures_as_data, measures_from_data
from studies import diagnosis
from studies.hard_cases import invariants
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.outcomes import Attempt, Outcome
from studies.hard_cases.scene import Fineness, Interface
from studies.stamps import at_limit


@dataclass(frozen=True)
class Record(Attempt):
    """An attempt with what was checked of it."""

    failures: str  # how attempts at steps failed
    measures: list[Measure]  # all checks that could be made

    @property
    def missed(self) -> list[Measure]:
        """The measures that miss their tolerances."""
        return [measure for measure in self.measures if not measure.passed]

    @property
    def passed(self) -> bool:
        """Whether the run ended and all checks are met."""
        return self.ended and not self.missed

    @property
    def outcome(self) -> Outcome:
        """The record as a row of a table."""
        shared = {field.name: getattr(self, field.name) for field in fields(Attempt)}
        return Outcome(**shared, missed="; ".join(map(short, self.missed)))


def make(runner: Runner, name: str, mesh: Fineness, interface: Interface) -> Record:
    """Run a case and check it. Raises HarnessError for an unknown case, or without an engine or plugin."""
    if name not in CASES:
        raise HarnessError(f"'{name}' is no hard case; there is {', '.join(CASES)}")
    case = CASES[name]
    run = runner(case.scene.model(mesh, interface), check=False)
    measures: list[Measure] = []
    if run.report.normal:
        try:
            measures = [*case.scene.check(run, runner), *invariants.of_any_run(run, case)]
            measures += invariants.of_the_plugin(run, runner, case) if interface is Interface.MIXTURE else []
        except HarnessError as error:
            measures.append(Measure("a further run that a check needs", float("nan"), 0.0, note=str(error)))
    return Record(
        **vars(attempt(name, mesh, interface.value, run)), failures=diagnosis.summary(run.log), measures=measures
    )


def attempt(name: str, mesh: Fineness, interface: str, run: RunResult) -> Attempt:
    """How a run of a case went."""
    report = run.report
    counts = (report.steps, report.iterations, report.residuals, report.retries)
    limited = at_limit(report.normal, run.cpu, run.limit)
    return Attempt(name, mesh.value, interface, report.normal, _reached(run), limited, *counts)


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
    """Read what `write` wrote. Raises DataFileError: a missing file, or one that holds no such records."""
    try:
        entries = json.loads(path.read_text())
        return [Record(**e | {"measures": measures_from_data(e["measures"])}) for e in entries]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise DataFileError(f"{path} holds no records of a hard case ({error}); `hard-cases` writes it anew") from error


def short(measure: Measure) -> str:
    """A measure with its tolerance in a few words."""
    note = f", {measure.note}" if measure.note else ""
    return f"{measure.name} {measure.value:.2g} (tolerance {measure.tolerance:.2g}{note})"
