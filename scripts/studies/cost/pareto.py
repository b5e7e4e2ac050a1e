"""What the data of the sweep say: Pareto fronts, pictures, and which setting reaches a given error."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from studies.cost.point_runs import Datum
from studies.cost.points import Parameter, Problem

LOOKS = {
    "sliding-mixture": ("#7a1f1f", "#7a1f1f"),
    "sliding-biphasic-solute": ("#2f5d9e", "none"),
    "sliding-multiphasic": ("#4f9a8a", "#cfe6e1"),
}
"""Colour of lines and of the inside of marks: filled, empty, light, so that grey tells them apart, too."""
SMALLEST = 1e-12
"""Errors below are drawn there."""
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


def error_of(datum: Datum) -> float:
    """The error that the parameters of the contact change: that of the contact for 3.1 and 3.2, the whole for 3.3."""
    return datum.error if datum.problem == Problem.INDENTATION.value else datum.contact_error


def cost_of(datum: Datum) -> float:
    """Processor time: relative to the conforming reference for 3.1 and 3.2, in s for 3.3."""
    return datum.cpu if datum.problem == Problem.INDENTATION.value else datum.ratio


def span_of(datum: Datum) -> tuple[float, float]:
    """Least and largest cost of repeated runs."""
    whole = datum.problem == Problem.INDENTATION.value
    return (datum.cpu_low, datum.cpu_high) if whole else (datum.ratio_low, datum.ratio_high)


def comparable(data: Sequence[Datum], problem: Problem, *, ended: bool = True) -> list[Datum]:
    """Runs of a problem that ended, or did not, on the mesh and in the steps of the defaults."""
    parameters = {parameter.value for parameter in Parameter if parameter not in DISCRETISATION}
    return [d for d in data if d.problem == problem.value and d.ended == ended and d.parameter in parameters]


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


def draw(data: Sequence[Datum], path: Path) -> Path:
    """Error against time, a panel for each problem that has data."""
    mpl.use("Agg")
    problems = [problem for problem in Problem if any(d.problem == problem.value for d in data)]
    figure = Figure(figsize=(max(7.0, 3.3 * len(problems)), 4.4), layout="constrained", facecolor="white")
    for axes, problem in zip(np.atleast_1d(figure.subplots(1, len(problems))), problems, strict=True):
        _panel(axes, comparable(data, problem))
        _mark_failed(axes, comparable(data, problem, ended=False))
        whole = problem is Problem.INDENTATION
        axes.set_xlabel("processor time [s]" if whole else "processor time over that\nof the conforming reference [-]")
        axes.set_ylabel("error against the finest run [-]" if whole else "error of the contact [-]")
        axes.set_title(f"problem {problem.value}", fontsize=10, pad=10)
    figure.legend(handles=_handles(data), fontsize=8, ncols=4, loc="outside lower center", frameon=False)
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    return path


def _panel(axes: Axes, data: Sequence[Datum]) -> None:
    axes.set(yscale="log")
    axes.spines[["top", "right"]].set_visible(False)
    for datum in data:
        default = datum.parameter == Parameter.DEFAULT.value
        colour, fill = LOOKS[datum.interface]
        low, high = span_of(datum)
        axes.errorbar(
            cost_of(datum),
            max(error_of(datum), SMALLEST),
            xerr=[[cost_of(datum) - low], [high - cost_of(datum)]],
            fmt=MARKERS[Parameter(datum.parameter)],
            color=colour,
            ecolor="#b0b0b0",
            elinewidth=0.7,
            markersize=13 if default else 5,
            markerfacecolor=fill,
            zorder=3 if default else 2,
        )
    front = pareto(data)
    axes.step([cost_of(d) for d in front], [max(error_of(d), SMALLEST) for d in front], "k:", where="post", lw=0.9)


def _mark_failed(axes: Axes, data: Sequence[Datum]) -> None:
    """Runs that did not end, at the upper edge of the panel: over the time that they reached, or right where times are
    relative to those of a reference, which such runs are not compared with.
    """
    if not data:
        return
    for datum in data:
        colour, fill = LOOKS[datum.interface]
        place = (cost_of(datum), axes.get_xaxis_transform()) if math.isfinite(cost_of(datum)) else (1, axes.transAxes)
        mark = axes.plot(place[0], 1, MARKERS[Parameter(datum.parameter)], transform=place[1], clip_on=False)[0]
        mark.set(color=colour, markerfacecolor=fill, markersize=5, gid=f"failed {datum.interface}")
    axes.text(1.0, 0.95, "did not end", transform=axes.transAxes, ha="right", va="top", fontsize=8)
    if data[0].problem == Problem.INDENTATION.value:
        axes.set_xscale("log")
        for axis in (axes.xaxis, axes.yaxis):  # both span a decade or two
            axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axis.set_major_formatter("{x:g}")
            axis.set_minor_formatter("")


def _handles(data: Sequence[Datum]) -> list[Line2D]:
    """Interfaces by colour and filling, parameters by mark, of those that the data have."""
    varied = {datum.parameter for datum in data}
    interfaces = [
        Line2D([], [], marker="s", linestyle="", color=colour, markerfacecolor=fill, label=name)
        for name, (colour, fill) in LOOKS.items()
    ]
    parameters = [
        Line2D([], [], marker=marker, linestyle="", color="0.4", markerfacecolor="none", label=parameter.value)
        for parameter, marker in MARKERS.items()
        if parameter not in DISCRETISATION and parameter.value in varied
    ]
    return [*interfaces, *parameters, Line2D([], [], color="k", linestyle=":", linewidth=0.9, label="least of all")]


LEVELS = tuple(10.0**-k for k in range(1, 8))
"""Errors at which the interfaces are compared."""


def comparison(data: Sequence[Datum]) -> str:
    """A Markdown table: the least each interface pays for an error, and the ratio of times to FEBio's better one.

    The predictor, which is off by default, has a column of its own.
    """
    names = list(LOOKS)
    lines = [
        "| problem | error | " + " | ".join(f"`{name}`" for name in names) + " | ratio of times | with `predictor` 1 |",
        "|---|---|" + "---|" * (len(names) + 2),
    ]
    for problem in Problem:
        own = comparable(data, problem)
        plain = [d for d in own if d.parameter != Parameter.PREDICTOR.value]
        predicted = [d for d in own if d.parameter == Parameter.PREDICTOR.value]
        for error in LEVELS:
            best = [fastest([d for d in plain if d.interface == name], error) for name in names]
            if not any(best):
                continue
            others = [cost_of(d) for d in best[1:] if d]
            ratio = f"{cost_of(best[0]) / min(others):.2f}" if best[0] and others else "-"
            cells = (problem.value, f"{error:.0e}", *map(_paid, best), ratio, _paid(fastest(predicted, error)))
            lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def fastest(data: Sequence[Datum], error: float) -> Datum | None:
    """The datum that takes the least time of those whose error is at most `error`."""
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
