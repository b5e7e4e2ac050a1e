"""One run of febio4: how it ended, and what the sanitizers said."""

import os
import signal
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.run import engine, febio_log, logdata
from studies.feb import NODE_FILE, Feb
from studies.robustness import sanitized
from studies.robustness.sanitized import Plugin

_BEGUN = b"===== beginning time step"


@dataclass(frozen=True)
class Way:
    """How models are run: with which library, for how long at most (s), and with how many threads."""

    plugin: Plugin
    timeout: float
    threads: int = 1


@dataclass(frozen=True)
class Ended:
    """A run that has ended."""

    folder: Path  # where its files are
    code: int | None  # febio4's exit code; minus the number of the signal that ended it; None where it took too long
    report: febio_log.Report
    sanitizers: tuple[str, ...]  # their findings, a line for each
    nodes: logdata.History | None  # the data of all nodes, where it wrote them

    @property
    def how(self) -> str:
        """How it ended, in a few words."""
        if self.code is None:
            return "took too long"
        if self.code < 0:
            return f"signal {-self.code} ({signal.strsignal(-self.code)})"
        return "normal" if self.report.normal else "error termination"

    @property
    def faults(self) -> tuple[str, ...]:
        """What no run may do, whatever is asked of it: crash, or do what the language leaves undefined."""
        crashed = (self.how,) if self.code is None or self.code < 0 else ()
        return (*crashed, *self.sanitizers)


def run(model: Feb, folder: Path, way: Way, *, leaks: bool = False) -> Ended:
    """Run a model in a folder of its own."""
    return execute(["-i", model.write(folder).name], folder, way, model.columns, leaks=leaks)


def execute(options: Sequence[str], folder: Path, way: Way, columns: tuple[str, ...], *, leaks: bool = False) -> Ended:
    """Run febio4 with these options in a folder; its screen output goes into ``screen.txt`` there."""
    screen, data = folder / sanitized.SCREEN, folder / NODE_FILE
    data.unlink(missing_ok=True)
    with screen.open("wb") as out:
        try:
            done = subprocess.run(
                _command(options, way),
                cwd=folder,
                env=_environment(way, leaks),
                stdout=out,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                timeout=way.timeout,
                check=False,
            )
            code: int | None = done.returncode
        except subprocess.TimeoutExpired:
            code = None
    report = febio_log.parse(screen.read_text(errors="replace"))
    return Ended(folder, code, report, sanitized.reports(folder), _read(data, columns))


def _command(options: Sequence[str], way: Way) -> list[str]:
    return [str(engine.find_engine()), *options, "-import", str(way.plugin.library)]


def _environment(way: Way, leaks: bool) -> dict[str, str]:
    return os.environ | {"OMP_NUM_THREADS": str(way.threads), **way.plugin.environment(leaks)}


def _read(path: Path, columns: tuple[str, ...]) -> logdata.History | None:
    """The node data of a run; None where it did not get so far as to write them."""
    try:
        return logdata.read_history(path, columns)
    except DataFileError:
        return None


def run_for(model: Feb, folder: Path, way: Way, steps: int) -> list[float]:
    """Run a model until it has done so many steps, and return the times at which they ended."""
    command = _command(["-i", model.write(folder).name], way)
    limit = time.monotonic() + way.timeout
    with subprocess.Popen(
        command,
        cwd=folder,
        env=_environment(way, leaks=False),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
    ) as process:
        assert process.stdout is not None
        done = 0
        for line in process.stdout:
            done += line.startswith(_BEGUN)
            if done > steps or time.monotonic() > limit:
                process.kill()
                break
    nodes = _read(folder / NODE_FILE, model.columns)
    return [] if nodes is None else [t for t in nodes.times.tolist() if t > 0.0][:steps]
