"""What the data of the sweep say: Pareto fronts, pictures, and which setting reaches a given error."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

from harness.models import indentation_mesh
from harness.studies.cost.point_runs import Datum
from harness.studies.cost.points import Parameter, Problem

COLOURS = {"sliding-mixture": "#c1272d", "sliding-biphasic-solute": "#0000a7", "sliding-multiphasic": "#008176"}
MARKERS = {
    Parameter.MESH: "s",
    Parameter.STEP: "D",
    Parameter.ORDER: "v",
    Parameter.INTEGRATION: "h",
    Parameter.PENALTY: "o",
    Parameter.AUGLAG: "^",
    Parameter.LAGMULT: "X",
    Parameter.PREDICTOR: ">",
    Parameter.NEWTON: "P",
    Parameter.DEFAULT: "*",
}
DISCRETISATION = (Parameter.MESH, Parameter.STEP)
SAME_MESH = (Problem.INDENTATION.value, Parameter.MESH.value)
"""The runs among which one has the mesh of the reference, the medium one."""


def error_of(datum: Datum) -> float:
    """The error that the parameters of the contact change: that of the contact for 3.1 and 3.2, the whole for 3.3."""
    return datum.error if datum.problem == Problem.INDENTATION.value else datum.contact_error


def cost_of(datum: Datum) -> float:
    """Processor time: relative to the unsplit body for 3.1 and 3.2, in s for 3.3."""
    return datum.cpu if datum.problem == Problem.INDENTATION.value else datum.ratio


def comparable(data: Sequence[Datum], problem: Problem) -> list[Datum]:
    """Runs of a problem that ended, on the mesh and in the steps of the defaults."""
    parameters = {parameter.value for parameter in Parameter if parameter not in DISCRETISATION}
    return [d for d in data if d.problem == problem.value and d.ended and d.parameter in parameters]


def pareto(data: Sequence[Datum]) -> list[Datum]:
    """Data than which no other one is both cheaper and more accurate, from the cheapest on."""
    front: list[Datum] = []
    for datum in sorted(data, key=lambda d: (cost_of(d), error_of(d))):
        if not front or error_of(datum) < error_of(front[-1]):
            front.append(datum)
    return front


def cheapest(data: Sequence[Datum], error: float) -> Datum | None:
    """The cheapest datum whose error is at most `error`; iterations decide, as they are exact, then time."""
    good = [d for d in data if error_of(d) <= error]
    return min(good, key=lambda d: (d.iterations, d.residuals, cost_of(d)), default=None)


def draw(data: Sequence[Datum], folder: Path) -> list[Path]:
    """Error against time for each problem that has data; returns the pictures."""
    mpl.use("Agg")
    written = []
    for problem in Problem:
        if not any(d.problem == problem.value for d in data):
            continue
        figure = Figure(figsize=(9.0, 5.0), layout="constrained")
        left, right = figure.subplots(1, 2)
        _panel(left, comparable(data, problem))
        unit = "processor time, s" if problem is Problem.INDENTATION else "processor time over that of the unsplit body"
        what = (
            "error against the finest run"
            if problem is Problem.INDENTATION
            else "error of the contact (cut against uncut)"
        )
        left.set(xlabel=unit, ylabel=what, title=f"{problem.value}: parameters of contact and solver")
        _total(right, [d for d in data if d.problem == problem.value and d.ended])
        right.set(xlabel="processor time, s", ylabel="whole error", title=f"{problem.value}: mesh and time steps")
        path = folder / f"cost-{problem.value}.png"
        figure.savefig(path, dpi=110)
        written.append(path)
    return written


def _logarithmic(axes: Axes) -> None:
    """Both axes logarithmic; the times span little, so some digits between the powers of ten are written."""
    axes.set(xscale="log", yscale="log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 1.5, 2.0, 3.0, 5.0)))
    axes.xaxis.set_major_formatter(FormatStrFormatter("%g"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def _panel(axes: Axes, data: Sequence[Datum]) -> None:
    _logarithmic(axes)
    for interface, colour in COLOURS.items():
        own = [d for d in data if d.interface == interface]
        for datum in own:
            star = datum.parameter == Parameter.DEFAULT.value
            axes.plot(
                cost_of(datum),
                max(error_of(datum), 1e-12),
                MARKERS[Parameter(datum.parameter)],
                color=colour,
                markersize=14 if star else 5,
                markeredgecolor="black" if star else colour,
                alpha=1.0 if star else 0.6,
            )
    front = pareto(data)
    axes.step([cost_of(d) for d in front], [max(error_of(d), 1e-12) for d in front], "k-", where="post", linewidth=0.8)
    handles = [axes.plot([], [], "o", color=colour, label=name)[0] for name, colour in COLOURS.items()]
    handles += [
        axes.plot([], [], marker, color="grey", linestyle="", label=parameter.value)[0]
        for parameter, marker in MARKERS.items()
        if parameter not in DISCRETISATION
    ]
    handles.append(axes.plot([], [], "k-", label="Pareto front")[0])
    axes.legend(handles=handles, fontsize=6, ncols=3, loc="upper center", bbox_to_anchor=(0.5, -0.14))


def _total(axes: Axes, data: Sequence[Datum]) -> None:
    _logarithmic(axes)
    for interface, colour in COLOURS.items():
        for parameter in DISCRETISATION:
            own = [
                d
                for d in data
                if d.interface == interface and d.parameter in (parameter.value, Parameter.DEFAULT.value)
            ]
            own.sort(key=lambda d: d.cpu)
            times, errors = [d.cpu for d in own], [d.error for d in own]
            axes.plot(
                times,
                errors,
                marker=MARKERS[parameter],
                linestyle="-" if parameter is Parameter.MESH else "--",
                color=colour,
                alpha=0.7,
                markersize=5,
            )
        for datum in (d for d in data if d.interface == interface and d.parameter == Parameter.DEFAULT.value):
            axes.plot(datum.cpu, datum.error, "*", color=colour, markersize=14, markeredgecolor="black")
    _flattered(axes, data)
    styles = ((Parameter.MESH, "-", "mesh"), (Parameter.STEP, "--", "time step"))
    handles = [axes.plot([], [], MARKERS[k], linestyle=s, color="grey", label=n)[0] for k, s, n in styles]
    axes.legend(handles=handles, fontsize=6, loc="best")


def _flattered(axes: Axes, data: Sequence[Datum]) -> None:
    """Say of each run of 3.3 on the mesh of its reference that the mesh is not in its error."""
    for datum in data:
        if (datum.problem, datum.parameter, datum.value) == (*SAME_MESH, indentation_mesh.LEVELS[1].across):
            axes.annotate("mesh of the reference  ", (datum.cpu, datum.error), fontsize=7, ha="right", va="center")


LEVELS = tuple(10.0**-k for k in range(1, 8))
"""Errors at which the interfaces are compared."""


def comparison(data: Sequence[Datum]) -> str:
    """A Markdown table: the least each interface pays for an error, and the ratio of times to FEBio's better one."""
    names = list(COLOURS)
    lines = [
        "| problem | error | " + " | ".join(f"`{name}`" for name in names) + " | ratio of times |",
        "|---|---|" + "---|" * (len(names) + 1),
    ]
    for problem in Problem:
        own = comparable(data, problem)
        for error in LEVELS:
            best = [_fastest([d for d in own if d.interface == name], error) for name in names]
            if not any(best):
                continue
            others = [cost_of(d) for d in best[1:] if d]
            ratio = f"{cost_of(best[0]) / min(others):.2f}" if best[0] and others else "-"
            lines.append(f"| {problem.value} | {error:.0e} | " + " | ".join(map(_paid, best)) + f" | {ratio} |")
    return "\n".join(lines)


def _fastest(data: Sequence[Datum], error: float) -> Datum | None:
    return min((d for d in data if error_of(d) <= error), key=cost_of, default=None)


def _paid(datum: Datum | None) -> str:
    if datum is None:
        return "not reached"
    what = "default" if datum.parameter == Parameter.DEFAULT.value else f"{datum.parameter} {datum.value:g}"
    return f"{what}: {datum.iterations} it., {cost_of(datum):.3g}"


def table(data: Sequence[Datum]) -> str:
    """All data as a Markdown table."""
    lines = [
        "| problem | interface | parameter | value | contact error | error | steps | iterations | residuals | retries "
        "| time |",
        "|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for d in data:
        errors = f"{d.contact_error:.1e} | {d.error:.1e}" if d.ended else "fails | fails"
        lines.append(
            f"| {d.problem} | `{d.interface}` | {d.parameter} | {d.value:g} | {errors} | {d.steps} | {d.iterations} | "
            f"{d.residuals} | {d.retries} | {cost_of(d):.3g} |"
        )
    return "\n".join(lines)
