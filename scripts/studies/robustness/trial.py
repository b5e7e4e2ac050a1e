"""A model in all its variations, what each is held to, and the report of it."""

import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from studies import feb as xml
from studies import files, tables
from studies.feb import Feb
from studies.robustness import archives, differences, execution, sanitized, solvers, variations
from studies.robustness.execution import Ended, Way
from studies.robustness.variations import EVERY

ROUND_OFF = 1e-8
"""Relative difference that rounding may grow to in a run. FEBio writes twelve digits, and times with nine."""
SOLVED = 0.05  # relative difference between two methods of solution that both converge to the tolerances of the model


@dataclass(frozen=True)
class Finding:
    """What came of one variation of a model."""

    model: str
    variation: str
    ended: str  # how it ended
    steps: int
    retries: int
    difference: float | None = None
    """From the run that it is compared with, as in `differences.largest`; None where there is nothing to compare."""
    faults: tuple[str, ...] = ()  # what must not be
    note: str = ""

    @property
    def passed(self) -> bool:
        """Whether there is no fault."""
        return not self.faults


@dataclass(frozen=True)
class Trial:
    """A model, how it is run, where its runs are, and how many of its time steps (0: all) are made."""

    model: Feb
    way: Way
    folder: Path
    steps: int

    def findings(self) -> Iterator[Finding]:
        """All variations, one after the other."""
        shutil.rmtree(self.folder, ignore_errors=True)
        end = self._end()
        model = variations.shortened(self.model, end) if end else self.model
        yield self._as_it_is(model)
        seen = variations.watched(model)
        plain = self._run(seen, "plain")
        if plain.how == "normal":
            yield self._with_two_threads(seen, plain)
            yield self._restarted(seen, plain)
            size = variations.end_of(seen) / plain.report.steps
            yield self._cut_back("cut back", seen, variations.cut_back(seen, size), forced=True)
            yield self._cut_back("few matrices", seen, variations.starved(seen, variations.FEWEST), forced=False)
        if model.module == "solid":
            for name in solvers.SOLVERS:
                yield self._solved_by(name, seen, plain)

    def _run(self, model: Feb, folder: str) -> Ended:
        return execution.run(model, self.folder / folder, self.way)

    def _end(self) -> float:
        """The time at which the runs end; 0 where the model does not take a step."""
        end = variations.end_of(self.model)
        if not self.steps:
            return end
        if not self.model.has_own_stepper:
            return min(end, self.steps * xml.number(self.model.controls[0], "step_size", 1.0))
        times = execution.run_for(variations.watched(self.model), self.folder / "times", self.way, self.steps)
        return times[-1] if times else 0.0

    def _as_it_is(self, model: Feb) -> Finding:
        """The file as it stands, with its own output; what it loses must not grow with the number of steps."""
        run = execution.run(model, self.folder / "as-it-is", self.way, leaks=True)
        normal = run.how == "normal"
        faults = [] if normal else [run.how, *run.report.errors[:1]]
        lost = sanitized.lost_bytes(run.folder)
        if lost and normal:
            half = variations.shortened(model, 0.5 * variations.end_of(model))
            before = sanitized.lost_bytes(execution.run(half, self.folder / "half", self.way, leaks=True).folder)
            faults += [f"a leak that grows, from {before} to {lost} bytes"] if lost > before else []
        return self._finding("as it is", run, faults, note=f"{lost} bytes lost" if lost else "")

    def _with_two_threads(self, model: Feb, plain: Ended) -> Finding:
        run = execution.run(model, self.folder / "two-threads", replace(self.way, threads=2))
        return self._same("2 threads", run, plain)

    def _restarted(self, model: Feb, plain: Ended) -> Finding:
        """Started anew from each third state, each time from the archive of the run before."""
        links = list(self._links(model, plain.report.steps))
        runs = links[1:]
        gaps = [_difference(run, plain) for run in runs]
        wanted = (plain.report.steps - 1) // EVERY
        faults = [fault for run in links for fault in run.faults]
        faults += [f"{len(runs)} restarts instead of {wanted}"] if len(runs) < wanted else []
        gap = max(gaps, default=None)
        faults += _beyond(gap, ROUND_OFF)
        return self._finding("restarted", links[-1], faults, gap, note=f"{len(runs)} times")

    def _links(self, model: Feb, steps: int) -> Iterator[Ended]:
        """A run, and those that continue the one before from its first archive."""
        folder = self.folder / "restarted"
        start = ["-i", model.write(folder).name]
        for done in range(EVERY, steps + EVERY, EVERY):
            with archives.first_archive(folder / f"{model.name}.dmp") as caught:
                dump = ("-dump=1", f"-dump_stride={EVERY}")
                run = execution.execute([*start, *dump], folder, self.way, model.columns)
            yield run
            if run.how != "normal" or not caught or done >= steps:
                return
            start = ["-r", f"from-{done}.dmp"]
            (folder / start[1]).write_bytes(caught[0])

    def _cut_back(self, variation: str, model: Feb, changed: Feb, *, forced: bool) -> Finding:
        """Against a run that makes the steps that were accepted, and no other ones; `forced` where some must fail."""
        name = variation.replace(" ", "-")
        run = self._run(changed, name)
        times = [] if run.nodes is None else [time for time in run.nodes.times.tolist() if time > 0.0]
        not_cut_back = () if run.report.retries or not forced else ("no step was cut back",)
        if not times:
            return self._finding(variation, run, not_cut_back, note="no step was accepted")
        straight = self._run(variations.with_times(model, times), f"{name}-straight")
        stopped = () if straight.how == "normal" else (f"the same steps, not cut back: {straight.how}",)
        return self._same(variation, run, straight, [*straight.faults, *not_cut_back, *stopped])

    def _solved_by(self, name: str, model: Feb, plain: Ended) -> Finding:
        run = self._run(solvers.solved_by(model, name), name.replace(" ", "-"))
        comparable = run.how == plain.how == "normal" and name in solvers.SAME_SOLUTION
        gap = _difference(run, plain) if comparable else None
        note = "" if run.how == "normal" else "; ".join(run.report.errors[:1])
        return self._finding(f"solver: {name}", run, _beyond(gap, SOLVED), gap, note)

    def _same(self, variation: str, run: Ended, reference: Ended, faults: Sequence[str] = ()) -> Finding:
        gap = _difference(run, reference)
        return self._finding(variation, run, [*faults, *_beyond(gap, ROUND_OFF)], gap)

    def _finding(
        self, variation: str, run: Ended, faults: Sequence[str], gap: float | None = None, note: str = ""
    ) -> Finding:
        report = run.report
        every = tuple(dict.fromkeys([*run.faults, *faults]))
        return Finding(self.model.name, variation, run.how, report.steps, report.retries, gap, every, note)


def _difference(run: Ended, reference: Ended) -> float:
    if run.nodes is None or reference.nodes is None:
        return float("inf")
    return differences.largest(run.nodes, reference.nodes)


def _beyond(gap: float | None, tolerance: float) -> list[str]:
    return [f"difference above {tolerance:.0e}"] if gap is not None and gap > tolerance else []


_HEAD = ("model", "variation", "ended", "steps", "retries", "difference", "faults")


def table(findings: Sequence[Finding]) -> str:
    """A Markdown table, a row for each variation of each model."""
    return tables.markdown(_HEAD, map(_row, findings))


def _row(found: Finding) -> tuple[str, ...]:
    difference = "" if found.difference is None else f"{found.difference:.1e}"
    said = "; ".join([*(f"**{fault}**" for fault in found.faults), *filter(None, [found.note])])
    return (found.model, found.variation, found.ended, str(found.steps), str(found.retries), difference, said)


def summary(findings: Sequence[Finding]) -> str:
    """How many there are, and how many have a fault."""
    faulty = [found for found in findings if not found.passed]
    models = len({found.model for found in findings})
    return f"{len(findings)} variations of {models} models: {len(faulty) or 'none'} with a fault."


def write(findings: Sequence[Finding], folder: Path) -> list[Path]:
    """Write the table and the same as JSON, and return the paths."""
    folder.mkdir(parents=True, exist_ok=True)
    text, data = folder / "robustness.md", folder / "robustness.json"
    text.write_text(f"{summary(findings)}\n\n{table(findings)}\n")
    files.write_json(findings, data)
    return [text, data]
