"""What a model is turned into: shortened, watched at all nodes, cut back, with given times, with another solver."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle

from lxml import etree

from harness.robustness import feb as xml
from harness.robustness.feb import Element, Feb

CUT = 0.4
"""What is left of a step that failed."""
LIMITS = (1, 2, 3)
"""Reformations allowed in the attempts that are to fail: they fail at different moments of an iteration."""
EVERY = 3
"""Of the steps each third one is made to fail, and after each third one the run is restarted."""
_PULSE = 1e-4
"""Half the time that such a limit holds, relative to a step."""


def shortened(model: Feb, end: float) -> Feb:
    """The same model until the time `end`."""
    made, before = model.copy(), 0.0
    for control in made.controls:
        last = before + duration(control)
        if before >= end * (1.0 - 1e-9):
            _remove(control)
        elif last > end:
            xml.put(control, "time_steps", -1)
            xml.put(control, "final_time", f"{end - before:.17g}")
        before = last
    return made


def duration(control: Element) -> float:
    """How long an analysis step lasts."""
    steps = xml.number(control, "time_steps", -1.0)
    return xml.number(control, "final_time", 0.0) if steps < 0.0 else steps * xml.number(control, "step_size", 1.0)


def end_of(model: Feb) -> float:
    """The time at which a model ends."""
    return sum(duration(control) for control in model.controls)


def _remove(control: Element) -> None:
    step = control.getparent()
    steps = None if step is None else step.getparent()
    if step is not None and steps is not None and step.tag == "step":
        steps.remove(step)


def watched(model: Feb) -> Feb:
    """The same model that writes the data of all its nodes at each step and nothing else, and a plot file.

    FEBio can restart only a run that writes a plot file, and crashes in one that wrote data of surfaces or facets.
    """
    made = model.copy()
    for control in made.controls:
        xml.put(control, "output_level", "OUTPUT_MAJOR_ITRS")
        xml.put(control, "plot_level", "PLOT_MAJOR_ITRS")
    for output in made.root.findall("Output"):
        made.root.remove(output)
    output = etree.SubElement(made.root, "Output")
    log = etree.SubElement(output, "logfile")
    etree.SubElement(log, "node_data", data=";".join(made.columns), file=xml.NODE_FILE, delim=" ")
    etree.SubElement(etree.SubElement(output, "plotfile", type="febio"), "var", type="displacement")
    return made


def cut_back(model: Feb, step: float) -> Feb:
    """The same model in steps of equal size, each third of which may not form enough matrices to converge."""
    made = model.copy()
    solvers = [xml.only(control, "solver") for control in made.controls]
    for control, solver in zip(made.controls, solvers, strict=True):
        usual = xml.number(solver, "max_refs", 15.0)
        curve = xml.add_curve(made, _pulses(end_of(model), step, usual))
        xml.put(solver, "max_refs", int(usual), lc=curve)
        _stepper(control, dtmax=f"{step:.17g}", max_retries=20, cutback=CUT)
    return made


def _pulses(end: float, step: float, usual: float) -> list[tuple[float, float]]:
    width = _PULSE * step
    points = [(0.0, usual)]
    for time, limit in zip(_doomed(end, step), cycle(LIMITS)):
        points += [(time - 2 * width, usual), (time - width, limit), (time + width, limit), (time + 2 * width, usual)]
    return [*points, (2.0 * end, usual)]


def _doomed(end: float, step: float) -> list[float]:
    """The times that the attempts which are to fail aim at, if each of them fails once and no other one does."""
    times, time, count = [], 0.0, 0
    while time + step <= end * (1.0 + 1e-9):
        if count % EVERY == 0:
            times.append(time + step)
        time += CUT * step if count % EVERY == 0 else step
        count += 1
    return times


def with_times(model: Feb, times: Sequence[float]) -> Feb:
    """The same model with steps that end at these times."""
    made = shortened(model, times[-1])
    curve = xml.add_curve(made, [(0.0, times[-1]), *((time, times[-1]) for time in times)], "STEP")
    for control in made.controls:
        xml.put(control, "step_size", f"{times[0]:.17g}")
        xml.put(control, "time_steps", -1)
        xml.put(control, "final_time", f"{times[-1]:.17g}")
        _stepper(control, dtmax=0, max_retries=0, cutback=CUT)
        xml.put(xml.only(control, "time_stepper"), "dtmax", 0, lc=curve)
    return made


def _stepper(control: Element, *, dtmax: str | float, max_retries: int, cutback: float) -> None:
    """Let FEBio take steps of size `dtmax` throughout, and a part of it where one fails."""
    for old in control.findall("time_stepper"):
        control.remove(old)
    made = etree.SubElement(control, "time_stepper", type="default")
    given = {"max_retries": max_retries, "opt_iter": 10**6, "dtmin": 0, "dtmax": dtmax}
    for tag, value in (given | {"aggressiveness": 1, "cutback": cutback, "dtforce": 1}).items():
        xml.put(made, tag, value)
