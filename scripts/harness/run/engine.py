"""Finds febio4 and runs it, with the plugin where a model needs it."""

import math
import os
import re
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from harness.errors import EngineFailedError, EngineNotFoundError, PluginNotFoundError
from harness.paths import PLUGIN_NAME, PLUGIN_VARIABLE, is_checkout, plugin_library
from harness.run import febio_log

Progress = Callable[[float], None]  # called with the time (s) that a run has reached
_THREADS = "OMP_NUM_THREADS"
_PEAK = re.compile(r"^VmHWM:\s+(\d+) kB$", re.MULTILINE)
_FEBIO = "febio4.exe" if sys.platform == "win32" else "febio4"


@dataclass(frozen=True)
class Run:
    """A finished run: where its files are, what febio4 said, wall and processor time (both s), and memory."""

    folder: Path
    report: febio_log.Report
    output: str
    wall: float
    cpu: float
    memory: float = math.nan  # the largest it had, MB; NaN where the system does not say


class Host(Protocol):
    """A program that runs models."""

    name: str

    def binaries(self, plugin: bool) -> tuple[Path, ...]:
        """The files that decide what a run gives; those for a contact of type 'sliding-mixture' too if `plugin`."""

    def command(self, model: Path, plugin: bool, options: Sequence[str] = ()) -> list[str]:
        """The command line that runs a model file from its own folder."""


class Febio4:
    """Runs models with febio4 and, where they need it, the plugin."""

    name = "febio4"

    def binaries(self, plugin: bool) -> tuple[Path, ...]:
        return (find_engine(), required_plugin()) if plugin else (find_engine(),)

    def command(self, model: Path, plugin: bool, options: Sequence[str] = ()) -> list[str]:
        return command(model, required_plugin() if plugin else None, options)


USUAL_ROOTS = ("~/febio4", "/usr/local/febio4", "/opt/febio4", "~/FEBioStudio", "~/FEBioStudio2", "/opt/FEBioStudio")
"""Folders of FEBio, as in cmake/FindFEBio.cmake."""


def find_engine() -> Path:
    """The febio4 executable: under ``$FEBIO_ROOT``, else in the folders that the build searches, else on the PATH.

    Raises EngineNotFoundError where there is none, saying where it was looked for.
    """
    given = os.environ.get("FEBIO_ROOT")
    roots = [Path(given)] if given else [Path(root).expanduser() for root in USUAL_ROOTS]
    candidates = [root / part / _FEBIO for root in roots for part in ("bin", "../bin", "febio/bin", ".")]
    on_path = shutil.which("febio4")
    if on_path:
        candidates.append(Path(on_path))
    for candidate in candidates:
        if candidate.is_file() and os.access(candidate, os.X_OK):
            return candidate.resolve()
    looked = ", ".join(str(root) for root in roots)
    raise EngineNotFoundError(
        f"febio4 was not found (looked in {looked}, and on the PATH). "
        "Set FEBIO_ROOT to the folder that holds bin/febio4."
    )


def required_plugin() -> Path:
    """The plugin library: that of `plugin_library`; outside a checkout else one beside febio4 or in ../lib from it.

    Raises PluginNotFoundError where it has not been built, or where an installed command finds none.
    """
    library = plugin_library()
    if is_checkout() or os.environ.get(PLUGIN_VARIABLE):
        if not library.is_file():
            raise PluginNotFoundError(f"the plugin library {library} does not exist; build it first.")
        return library.resolve()
    return _plugin_beside(find_engine())


def _plugin_beside(febio: Path) -> Path:
    folders = (febio.parent, febio.parent.parent / "lib")
    for folder in folders:
        if (folder / PLUGIN_NAME).is_file():
            return folder / PLUGIN_NAME
    raise PluginNotFoundError(
        f"{PLUGIN_NAME} is in none of {', '.join(map(str, folders))}. "
        f"Put it there from a release of the plugin, or set {PLUGIN_VARIABLE} to its path."
    )


def command(model: Path, plugin: Path | None = None, options: Sequence[str] = ()) -> list[str]:
    """The command line that runs a model file from its own folder.

    model: the .feb file; FEBio's output is written next to it.
    plugin: library to load with ``-import``.
    options: further arguments of febio4, such as ``-dump``.
    Raises EngineNotFoundError without febio4.
    """
    load = [] if plugin is None else ["-import", str(plugin)]
    return [str(find_engine()), "-i", model.name, *options, *load]


def limited(command: Sequence[str], seconds: float | None) -> list[str]:
    """The same command line, ended by the system after so much processor time, which other work does not change.

    Raises EngineFailedError where the system has no ``prlimit`` for it.
    """
    if seconds is None:
        return list(command)
    program = shutil.which("prlimit")
    if program is None:
        raise EngineFailedError(
            "a limit of processor time needs the program prlimit (util-linux), which is not installed"
        )
    return [program, f"--cpu={math.ceil(seconds)}", *command]


def execute(
    command: Sequence[str],
    folder: Path,
    *,
    progress: Progress | None = None,
    check: bool = True,
    timeout: float | None = None,
) -> Run:
    """Run a febio4 command line in `folder` with one thread unless ``OMP_NUM_THREADS`` says otherwise.

    progress: called with each time reached, s.
    check: whether a run that does not end normally is an error.
    timeout: s after which the run is ended, and then did not end normally.
    Raises EngineFailedError, with `check`, where febio4 did not end normally; quotes FEBio's own words.
    """
    environment = {_THREADS: "1", **os.environ}
    start = time.perf_counter()
    with subprocess.Popen(
        command,
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        text=True,
        errors="replace",
    ) as process:
        watch = threading.Timer(timeout, process.kill) if timeout is not None else None
        if watch:
            watch.start()
        output, peak = _follow(process, progress)
        code, cpu = _wait(process)
        if watch:
            watch.cancel()
    finished = Run(folder, febio_log.parse(output), output, time.perf_counter() - start, cpu, peak)
    if check and (code != 0 or not finished.report.normal):
        raise EngineFailedError(_complaint(command, finished, code))
    return finished


def _wait(process: subprocess.Popen[str]) -> tuple[int, float]:
    """The exit code of a process and its processor time, s; Python does not tell the time on Windows."""
    if sys.platform == "win32":
        return process.wait(), math.nan
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime


def _follow(process: subprocess.Popen[str], progress: Progress | None) -> tuple[str, float]:
    """What a process prints, and its largest memory up to the last time step that it completed, MB."""
    lines: list[str] = []
    peak = math.nan
    assert process.stdout is not None
    for line in process.stdout:
        lines.append(line)
        match = febio_log.CONVERGED.search(line)
        if match is None:
            continue
        peak = _peak_memory(process, peak)
        if progress:
            progress(float(match.group(1)))
    return "".join(lines), peak


def _peak_memory(process: subprocess.Popen[str], before: float) -> float:
    """The largest memory of a process so far, MB; `before` if it has ended, or if the system is not Linux.

    The figure of ``os.wait4`` is no measure: it is at least the memory of the Python process that starts another one.
    """
    try:
        found = _PEAK.search(Path(f"/proc/{process.pid}/status").read_text(encoding="ascii"))
    except OSError:
        return before
    return float(found.group(1)) / 1000.0 if found else before


def _complaint(command: Sequence[str], finished: Run, code: int) -> str:
    report = finished.report
    last = [line.strip() for line in finished.output.splitlines() if re.search(r"\w", line)][-5:]
    said = "; ".join(report.errors) or " | ".join(last)
    name = Path(command[0]).name
    who = name if name == "mixture-contact" else "FEBio"
    return (
        f"{name} did not end normally (exit code {code}, {report.steps} time steps done).\n"
        f"{who} says: {said}\nCommand: {' '.join(command)}\nFolder: {finished.folder}"
    )
