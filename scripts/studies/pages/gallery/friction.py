"""The pictures of friction: mu_eff of a plate on a layer over time, and a joint with its stick and slip zones."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from harness.arrays import Array
from harness.post.section_figures import Section, draw_bodies
from harness.run.runner import Runner, RunResult
from studies.closed_forms import sliding_plate
from studies.models import plate_on_layer, sliding_joint
from studies.models.plate_on_layer import PlateOnLayer
from studies.models.sliding_joint import DRAINED, END, SlidingJoint

FRACTIONS = (0.0, 0.1, 0.5)
COLOURS = ("#0b5fa5", "#d1495b", "#2a7f62")
MARKERS = ("o", "s", "^")
DPI = 110
SLIP = 0.99  # a facet counts as slipping where its friction reaches this part of the largest one
PICTURES = {
    "friction-plate.png": "Effective friction coefficient over time: closed form (lines) and runs (marks)",
    "friction-joint.png": "Fluid pressure over the joint, and friction along the contact with its bound and stick zone",
}
"""File names and what they show."""
MODELS = (PlateOnLayer().model(), SlidingJoint().model())
"""What each of them is of; the first with other values of phi as well."""


def draw(runner: Runner, folder: Path) -> list[Path]:
    """Run the models and draw both pictures into `folder`, which is made where needed."""
    folder.mkdir(parents=True, exist_ok=True)
    plate, joint = (folder / name for name in PICTURES)
    runs = {phi: runner(PlateOnLayer(phi, name=f"plate-on-layer-phi-{phi:g}").model()) for phi in FRACTIONS}
    return [draw_plate(runs, plate), draw_joint(runner(SlidingJoint().model()), joint)]


def plate_curve(run: RunResult, solid_fraction: float) -> tuple[Array, Array, Array]:
    """Over time: H k t/h^2, mu_eff/mu_eq of a run of `plate_on_layer`, and that of the closed form."""
    nodes, layer = run.nodes, run.model.mesh.node_sets["layer"] - 1
    tau = nodes.times[1:] / plate_on_layer.DIFFUSION_TIME
    found = np.abs(nodes["Rx"][1:, layer].sum(axis=1)) / (plate_on_layer.FRICTION * plate_on_layer.LOAD)
    return tau, found, sliding_plate.relative_friction(tau, solid_fraction)


def draw_plate(runs: dict[float, RunResult], path: Path) -> Path:
    """mu_eff/mu_eq over time for each phi, beside the closed form."""
    figure = Figure(figsize=(6.0, 3.6), layout="constrained")
    axes = figure.subplots()
    for (phi, run), colour, marker in zip(runs.items(), COLOURS, MARKERS, strict=True):
        tau, found, exact = plate_curve(run, phi)
        axes.semilogx(tau, exact, "-", color=colour, linewidth=1.4)
        look = {"color": colour, "markersize": 4, "markerfacecolor": "white", "label": rf"$\varphi$ = {phi:g}"}
        axes.semilogx(tau[::8], found[::8], marker, **look)
    axes.set(xlabel=r"$H\,k\,t/h^2$", ylabel=r"$\mu_\mathrm{eff}/\mu_\mathrm{eq}$", ylim=(0.0, 1.05))
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False)
    figure.savefig(path, dpi=DPI)
    return path


def draw_joint(run: RunResult, path: Path) -> Path:
    """Three states while the joint slides: fluid pressure, and below it friction along the contact."""
    way = END - DRAINED
    states = [run.nodes.at(DRAINED + part * way) for part in (0.125, 0.375, 1.0)]
    figure = Figure(figsize=(7.6, 4.8), layout="constrained")
    places = figure.subplots(2, 3, sharex=True, height_ratios=(1.0, 2.2), sharey="row")
    largest = max(float(run.nodes["p"][state].max()) for state in states)
    drawn = None
    for column, state in enumerate(states):
        positions = np.stack([run.nodes[axis][state] for axis in "xyz"], axis=1)
        section = Section(across=0, up=1)
        drawn = draw_bodies(places[0, column], run.model.mesh, section, positions, run.nodes["p"][state] / largest)
        slid = sliding_joint.WAY * (run.nodes.times[state] - DRAINED) / way
        places[0, column].set_title(f"slid by {1000.0 * slid:.1f} µm", fontsize=10)
        _tractions(places[1, column], run, state)
    if drawn is not None:
        figure.colorbar(drawn, ax=places[0].tolist(), label=f"p / {1000.0 * largest:.0f} kPa", shrink=0.9)
    places[1, 0].set_ylabel("friction [kPa]")
    handles, labels = places[1, 0].get_legend_handles_labels()
    figure.legend(handles, labels, frameon=False, fontsize=11, ncols=3, loc="outside lower center")
    figure.savefig(path, dpi=DPI)
    return path


def _tractions(axes: Axes, run: RunResult, state: int) -> None:
    """Friction and its bound along the contact; where it is below, the surfaces stick."""
    x, friction, bound = tractions(run, state)
    axes.plot(x, 1000.0 * bound, "--", color="0.3", linewidth=1.2, label=r"$T_\mathrm{max}$")
    axes.plot(x, 1000.0 * friction, "-", color=COLOURS[1], linewidth=1.4, label=r"$|t_T|$")
    sticks = (bound > 0.0) & (friction < SLIP * bound)
    top = 1050.0 * float(bound.max())
    axes.fill_between(x, 0.0, top, where=sticks.tolist(), color=COLOURS[0], alpha=0.12, linewidth=0, label="stick")
    axes.set(xlabel="x [mm]", ylim=(0.0, top))
    axes.spines[["top", "right"]].set_visible(False)


def tractions(run: RunResult, state: int) -> tuple[Array, Array, Array]:
    """Along the contact, facet by facet: position (mm), friction traction and its bound (MPa)."""
    facets, quads = run.facets("upper-cartilage"), run.model.mesh.surfaces["upper-cartilage"] - 1
    row = state - len(run.nodes.times)
    x = run.nodes["x"][state][quads].mean(axis=1)
    friction = np.hypot(*(facets[f"contact friction.{axis}"][row] for axis in "xy"))
    bound = facets["contact friction coefficient"][row] * facets["contact pressure"][row]
    order = np.argsort(x)
    return x[order], friction[order], bound[order]
