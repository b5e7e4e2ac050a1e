"""A scene with all devices of the solver, and with each of them left out."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from lxml import etree

from harness.models.interface import InterfaceType
from harness.paths import REPOSITORY
from harness.run import engine
from studies import feb
from studies.ablation.ablated_scenes import AblatedScene
from studies.price import table

SOURCE = REPOSITORY / "plugin" / "solver" / "devices.h"  # where the names of devices stand
ALL, NONE = "all", "none"
ACTED = re.compile(r"(?:Number of actions of each solver device: |: solver device )(.*)\.$", re.MULTILINE)


@dataclass(frozen=True)
class Ablated:
    """One run."""

    scene: str
    kind: str
    without: str  # the device that is left out, or ``nothing``, or ``any``
    ended: bool
    iterations: int
    retries: int
    matrices: int
    entries: int  # the most of the matrix in the run
    time: float  # processor time of the run [s]
    acted: str  # how often devices acted


def devices() -> list[str]:
    """The names of all devices, as the plugin has them."""
    block = re.search(r"device_names\{(.*?)\}", SOURCE.read_text(encoding="utf-8"), re.DOTALL)
    return re.findall(r'"(\w+)"', block.group(1)) if block else []


def ablate(name: str, scene: AblatedScene, left_out: Iterable[str], folder: Path, limit: float) -> list[Ablated]:
    """Run a scene with all devices, with those alone left out that acted, and without any.

    A device that did not act in the run with all of them changes nothing, and takes the figures of that run.
    """
    made = scene.write(folder / re.sub(r"\W+", "-", name))
    run = partial(_run, (name, scene.kind), made, limit)
    whole = run("nothing", ALL)
    rows = [whole]
    for device in left_out:
        if device not in whole.acted:
            rows.append(Ablated(**{**vars(whole), "without": device, "acted": ""}))
            continue
        rows.append(run(device, ", ".join(other for other in devices() if other != device)))
    return [*rows, run("any", NONE)]


def _run(scene: tuple[str, str], model: Path, limit: float, without: str, others: str) -> Ablated:
    """A scene, by its name and kind, without a device; `others` are those that it leaves on."""
    folder = model.parent / without
    folder.mkdir(exist_ok=True)
    for file in model.parent.iterdir():
        if file.is_file() and file != model and file.suffix not in (".log", ".xplt", ".txt"):
            (folder / file.name).write_bytes(file.read_bytes())
    changed = feb.read(model)
    for contact in changed.contacts:
        if contact.get("type") in (InterfaceType.MIXTURE.value, InterfaceType.TIED.value):
            etree.SubElement(contact, "solver_devices").text = others
    path = changed.write(folder)
    command = engine.limited(engine.Febio4().command(path, plugin=True), limit)
    done = engine.execute(command, folder, check=False)
    report = done.report
    log = path.with_suffix(".log").read_text(errors="replace")
    counts = (report.iterations, report.retries, report.reformations, table.entries(log))
    return Ablated(*scene, without, report.normal, *counts, done.cpu, "; ".join(ACTED.findall(log)))
