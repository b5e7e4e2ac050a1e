"""What the data of the sweep say: Pareto fronts, pictures, and which setting reaches a given error."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from studies import files, tables
from studies.cost.point_runs import Datum
from studies.cost.points import Parameter, Problem

Point = TypeVar("Point")
LOOKS = {"sliding-mixture": "#7a1f1f", "sliding-biphasic-solute": "#2f5d9e", "sliding-multiphasic": "#2a8f7c"}
"""Colours of the interfaces."""
SMALLEST = 1e-12  # errors below are drawn there
FEW = (1, 1.2, 1.5, 2, 3, 5, 7)  # ticks of an axis that spans less than a decade
DISCRETISATION = (Parameter.MESH, Parameter.STEP)


def error_of(datum: Datum) -> float:
    """The error that the parameters of the contact change: that of the contact for 3.1 and 3.2, the whole for 3.3."""
    return datum.error if datum.problem == Problem.INDENTATION.value else datum.contact_error


def cost_of(datum: Datum) -> float:
    """Processor time: relative to the conforming reference for 3.1 and 3.2, in s for 3.3."""
    return datum.cpu if datum.problem == Problem.INDENTATION.value else datum.ratio


def comparable(data: Sequence[Datum], problem: Problem, *, ended: bool = True) -> list[Datum]:
    """Runs of a problem that ended, or did not, on the mesh and in the steps of the defaults."""
    parameters = {parameter.value for parameter in Parameter if parameter not in DISCRETISATION}
    return [d for d in data if d.problem == problem.value and d.ended == ended and d.parameter in parameters]


def front(data: Sequence[Point], place: Callable[[Point], tuple[float, float]]) -> list[Point]:
    """Data than which no other one is both cheaper and more accurate, from the cheapest on; `place`: cost and error."""
    found: list[Point] = []
    for datum in sorted(data, key=place):
        if not found or place(datum)[1] < place(found[-1])[1]:
            found.append(datum)
    return found


def pareto(data: Sequence[Datum]) -> list[Datum]:
    """The front of the sweep."""
    return front(data, lambda datum: (cost_of(datum), error_of(datum)))


def cheapest(data: Sequence[Datum], error: float) -> Datum | None:
    """The cheapest datum whose error is at most `error`; iterations decide, as they are exact, then time."""
    good = [d for d in data if error_of(d) <= error]
    return min(good, key=lambda d: (d.iterations, d.residuals, cost_of(d)), default=None)


def draw(data: Sequence[Datum], path: Path) -> Path:
    """Error against time: a panel for each problem that has data, a line for each interface, one below the other."""
    problems = [problem for problem in Problem if any(d.problem == problem.value for d in data)]
    figure = Figure(figsize=(5.4, 0.5 + 2.9 * len(problems)), layout="constrained", facecolor="white")
    for axes, problem in zip(np.atleast_1d(figure.subplots(len(problems), 1)), problems, strict=True):
        _panel(axes, comparable(data, problem))
        _mark_failed(axes, comparable(data, problem, ended=False))
        _ticks(axes)
        whole = problem is Problem.INDENTATION
        axes.set_xlabel("processor time [s]" if whole else "processor time over that of the conforming reference [-]")
        axes.set_ylabel("error against the finest run [-]" if whole else "error of the contact [-]")
        axes.set_title(f"problem {problem.value}", fontsize=11, loc="left")
    handles = [Line2D([], [], color=colour, marker="o", markersize=4, label=name) for name, colour in LOOKS.items()]
    figure.legend(handles=handles, fontsize=9, ncols=3, loc="outside upper center", frameon=False, columnspacing=1.0)
    return files.save_figure(figure, path)


def _panel(axes: Axes, data: Sequence[Datum]) -> None:
    """Settings as dots, and for each interface a line through those that no other of its settings beats.

    The predictor, which is off by default, is not on the line.
    """
    axes.set(xscale="log", yscale="log")
    axes.spines[["top", "right"]].set_visible(False)
    axes.grid(alpha=0.25)
    for name, colour in LOOKS.items():
        own = [d for d in data if d.interface == name]
        axes.plot(list(map(cost_of, own)), list(map(_shown, own)), "o", color=colour, markersize=3.5, alpha=0.35, mew=0)
        best = pareto([d for d in own if d.parameter != Parameter.PREDICTOR.value])
        line = {"color": colour, "marker": "o", "markersize": 4.5, "linewidth": 1.8}
        axes.step(list(map(cost_of, best)), list(map(_shown, best)), where="post", **line)


def _ticks(axes: Axes) -> None:
    """Plain numbers on an axis that spans a few decades at most."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        axis.set_minor_formatter("")
        if high < 1000.0 * low:
            axis.set_major_locator(LogLocator(subs=FEW if high < 10.0 * low else (1, 2, 5)))
            axis.set_major_formatter("{x:g}")


def _shown(datum: Datum) -> float:
    return max(error_of(datum), SMALLEST)


def _mark_failed(axes: Axes, data: Sequence[Datum]) -> None:
    """Runs that did not end, at the upper edge of the panel: over the time that they reached, or right where times are
    relative to those of a reference, which such runs are not compared with.
    """
    for datum in data:
        known = math.isfinite(cost_of(datum))
        place = (cost_of(datum), axes.get_xaxis_transform()) if known else (1, axes.transAxes)
        mark = axes.plot(place[0], 1, "x", transform=place[1], clip_on=False, color=LOOKS[datum.interface])[0]
        mark.set(markersize=5, gid=f"failed {datum.interface}")
    if data:
        axes.text(1.0, 0.95, "x: did not complete", transform=axes.transAxes, ha="right", va="top", fontsize=8)


LEVELS = tuple(10.0**-k for k in range(1, 8))  # errors at which the interfaces are compared


def comparison(data: Sequence[Datum]) -> str:
    """A Markdown table: the least each interface pays for an error, and the ratio of times to FEBio's better one.

    The predictor, which is off by default, has a column of its own.
    """
    names = list(LOOKS)
    heads = ("problem", "error", *(f"`{name}`" for name in names), "ratio of times", "with `predictor` 1")
    rows = []
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
            rows.append((problem.value, f"{error:.0e}", *map(_paid, best), ratio, _paid(fastest(predicted, error))))
    return tables.markdown(heads, rows)


def fastest(data: Sequence[Datum], error: float) -> Datum | None:
    """The datum that takes the least time of those whose error is at most `error`."""
    return min((d for d in data if error_of(d) <= error), key=cost_of, default=None)


def _paid(datum: Datum | None) -> str:
    if datum is None:
        return "not reached"
    return f"{_setting(datum)}: {datum.iterations} it., {cost_of(datum):.3g}"


def _setting(datum: Datum) -> str:
    points = ", segments" if datum.value else ", Gauss points"
    words = {Parameter.DEFAULT.value: "default", Parameter.LAGMULT.value: f"LAGMULT{points}"}
    return words.get(datum.parameter, f"{datum.parameter} {datum.value:g}")
