"""What a model is turned into: shortened, watched at all nodes, cut back, with given times, with another solver."""

from collections.abc import Sequence

from lxml import etree

from studies import feb as xml
from studies.feb import Element, Feb

CUT = 0.5  # what is left of a step that failed
FEW, FEWEST = 8, 3  # matrices in a step
TOLERANCES = {"dtol": 1e-3, "min_residual": 1e-20}  # without which no step ends, with FEBio's own values
EVERY = 3  # of the steps each third one is made to fail, and after each third one the run is restarted
_PULSE = 1e-4  # half the time for which nothing converges, relative to a step
_NOTHING = 1e-30  # zero would switch a tolerance off


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


def with_given_penalty(model: Feb) -> Feb:
    """The same model with the factor on the traction that the plugin chooses by itself.

    An automatic one is reduced after a failed step, one that is given never.
    """

    def change(contact: Element) -> None:
        if contact.get("type") == "sliding-mixture" and contact.find("penalty") is None:
            xml.put(contact, "auto_penalty", 1)
            xml.put(contact, "penalty", 100 if xml.number(contact, "two_pass", 0.0) else 1000)

    return model.changed("contact", change)


def cut_back(model: Feb, step: float) -> Feb:
    """The same model in steps of equal size, each third of which cannot converge at the time that it first aims at.

    Then the tolerances are zero, which load curves can do; the number of matrices that may be formed is small.
    """
    made = starved(model, FEW)
    curve = xml.add_curve(made, _pulses(end_of(model), step))
    for control in made.controls:
        solver = xml.only(control, "solver")
        for tag, usual in TOLERANCES.items():
            xml.put(solver, tag, f"{xml.number(solver, tag, usual):.17g}", lc=curve)
        _stepper(control, f"{step:.17g}", 20)
    return made


def starved(model: Feb, matrices: int) -> Feb:
    """The same model with so few matrices in a step that steps which need more iterations are cut back."""

    def change(control: Element) -> None:
        xml.put(xml.only(control, "solver"), "max_refs", matrices)
        if control.find("time_stepper") is None:
            _stepper(control, f"{xml.number(control, 'step_size', 1.0):.17g}", 5)

    return with_given_penalty(model).changed("Control", change)


def _pulses(end: float, step: float) -> list[tuple[float, float]]:
    width = _PULSE * step
    points = [(0.0, 1.0)]
    for time in _doomed(end, step):
        points += [(time - 2 * width, 1.0), (time - width, _NOTHING), (time + width, _NOTHING), (time + 2 * width, 1.0)]
    return [*points, (2.0 * end, 1.0)]


def _doomed(end: float, step: float) -> list[float]:
    """The times before the end that the attempts which are to fail aim at, if they fail once and no other ones do."""
    times, time, count = [], 0.0, 0
    while time + step < end * (1.0 - 1e-9):
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
        _stepper(control, 0, 0)
        xml.put(xml.only(control, "time_stepper"), "dtmax", 0, lc=curve)
    return made


def _stepper(control: Element, dtmax: str | float, max_retries: int) -> None:
    """Let FEBio take steps of size `dtmax` throughout, and a part of it where one fails."""
    for old in control.findall("time_stepper"):
        control.remove(old)
    made = etree.SubElement(control, "time_stepper", type="default")
    given = {"max_retries": max_retries, "opt_iter": 10**6, "dtmin": 0, "dtmax": dtmax}
    for tag, value in (given | {"aggressiveness": 1, "cutback": CUT, "dtforce": 1}).items():
        xml.put(made, tag, value)
