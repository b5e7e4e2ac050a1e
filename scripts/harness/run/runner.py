"""Runs models, each once: what was run before with the same text, plugin and engine is read back.

Written here and not taken from joblib or diskcache, because those keep values of functions, and what is kept here is
the folder that an engine wrote into; and a second process that wants the same run has to wait for it.
"""

import hashlib
import json
import math
import shutil
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from filelock import FileLock

from harness.errors import EngineFailedError
from harness.models.document import Model
from harness.models.interface import InterfaceType
from harness.run import engine, febio_log, logdata

Announce = Callable[[str, float], None]  # called with the name of a model and the fraction of its time that is done


@dataclass(frozen=True)
class RunResult:
    """A model and what came of it."""

    model: Model
    folder: Path  # where its files are
    report: febio_log.Report
    wall: float  # s, of the run itself
    cpu: float  # its processor time, s
    limit: float | None = None  # s of processor time after which it was to be ended
    memory: float = math.nan  # the largest it had, MB; NaN where it is not known

    @property
    def nodes(self) -> logdata.History:
        """The node data over time."""
        return logdata.read_history(self.folder / self.model.node_file, self.model.node_columns)

    @property
    def elements(self) -> logdata.History:
        """The element data over time; the model must ask for some."""
        return logdata.read_history(self.folder / self.model.element_file, self.model.element_columns)

    def surface(self, name: str) -> logdata.History:
        """The data of a contact surface over time, one item; the model must ask for some."""
        return logdata.read_history(self.folder / self.model.surface_file(name), self.model.surface_columns)

    def part(self, name: str) -> logdata.History:
        """The element data of one part over time; the model must ask for some."""
        return logdata.read_history(self.folder / self.model.part_file(name), self.model.part_columns[name])

    def facets(self, name: str) -> logdata.History:
        """The data of the facets of a contact surface over time; the model must ask for some."""
        return logdata.read_history(self.folder / self.model.facet_file(name), self.model.facet_columns)

    @property
    def log(self) -> str:
        """The text of the engine's log."""
        return (self.folder / f"{self.model.name}.log").read_text(errors="replace")


@dataclass
class Runner:
    """Runs models in folders below `root` and keeps what they wrote; safe for several processes at a time."""

    root: Path
    announce: Announce | None = None  # told of progress
    timeout: float | None = None  # s after which a run is ended
    processor_limit: float | None = None  # s of processor time after which a run is ended
    host: engine.Host = field(default_factory=engine.Febio4)  # what runs them; febio4 without it
    _known: dict[str, RunResult] = field(default_factory=dict)

    def __call__(self, model: Model, *, options: Sequence[str] = (), check: bool = True) -> RunResult:
        """Run a model, or read back what an earlier run left.

        options: further arguments of febio4.
        check: whether a run that does not end normally is an error.
        Raises EngineNotFoundError, PluginNotFoundError, EngineFailedError: see `harness.run.engine`.
        """
        key = _key(model, self.host.binaries(needs_plugin(model)), options)
        if key not in self._known:
            self._known[key] = self._locked(model, tuple(options), key)
        result = self._known[key]
        if check and not result.report.normal:
            said = "; ".join(result.report.errors) or "no reason given"
            raise EngineFailedError(f"model '{model.name}' did not end normally: {said} (see {result.folder})")
        return result

    def _locked(self, model: Model, options: tuple[str, ...], key: str) -> RunResult:
        folder = self.root / f"{model.name}-{key}"
        self.root.mkdir(parents=True, exist_ok=True)
        with FileLock(self.root / f"{key}.lock"):
            return _read_back(model, folder, self.processor_limit) or self._run(model, options, folder)

    def _run(self, model: Model, options: tuple[str, ...], folder: Path) -> RunResult:
        with suppress(FileNotFoundError):
            shutil.rmtree(folder)
        path = model.write(folder)
        command = engine.limited(self.host.command(path, needs_plugin(model), options), self.processor_limit)
        progress = self._progress(model)
        finished = engine.execute(command, folder, progress=progress, check=False, timeout=self.timeout)
        (folder / "screen.txt").write_text(finished.output)
        times = {"wall": finished.wall, "cpu": finished.cpu, "limit": self.processor_limit, "memory": finished.memory}
        (folder / "done.json").write_text(json.dumps({"report": asdict(finished.report), **times}))
        return RunResult(
            model, folder, finished.report, finished.wall, finished.cpu, self.processor_limit, finished.memory
        )

    def _progress(self, model: Model) -> engine.Progress | None:
        if self.announce is None:
            return None
        announce, end = self.announce, model.control.end or model.control.steps * model.control.step
        announce(model.name, 0.0)
        return lambda time: announce(model.name, min(1.0, time / end))


def needs_plugin(model: Model) -> bool:
    """Whether a contact of the model is the plugin's."""
    return InterfaceType.ours_in([contact.kind for contact in model.contacts]).needs_plugin


def _key(model: Model, binaries: Sequence[Path], options: Sequence[str]) -> str:
    digest = hashlib.sha256(model.text().encode())
    digest.update("\0".join(options).encode())
    for binary in binaries:
        state = binary.stat()
        digest.update(f"{binary} {state.st_size} {state.st_mtime_ns}".encode())
    return digest.hexdigest()[:16]


def _read_back(model: Model, folder: Path, limit: float | None) -> RunResult | None:
    """What an earlier run left, where it would end in the same way with this limit (s) of processor time."""
    try:
        done = json.loads((folder / "done.json").read_text())
    except FileNotFoundError:
        return None
    if "limit" not in done or not _ends_alike(done, limit):
        return None
    report = done["report"]
    report["errors"], report["warnings"] = tuple(report["errors"]), tuple(report["warnings"])
    memory = done.get("memory", math.nan)
    return RunResult(model, folder, febio_log.Report(**report), done["wall"], done["cpu"], done["limit"], memory)


def _ends_alike(done: Mapping[str, Any], limit: float | None) -> bool:
    if done["report"]["normal"]:
        return limit is None or done["cpu"] <= limit
    return bool(done["limit"] == limit)
