"""Contact over time: force, area, pressure, the load that the fluid bears, and what crosses."""

from dataclasses import dataclass

import numpy as np

from harness.arrays import Array
from harness.report.plot_file import PlotFile, State
from harness.report.surface import Surface

PRESSURE = "contact pressure"
FORCE = "contact force"
FLUID = ("fluid pressure", "effective fluid pressure")
SOLVENT_FLOW, SOLUTE_FLOW = "contact solvent flow", "contact solute flow"


@dataclass(frozen=True)
class Contact:
    """One surface of a contact over the states of a run; arrays have one entry per state."""

    surface: Surface
    place: int  # which of the plot file's surfaces it is
    time: Array  # s
    force: Array  # magnitude of the contact force on the surface, N
    area: Array  # area of the facets under pressure, mm^2
    # Contact pressure: the largest of a facet, and its mean over the area, MPa.
    peak: Array
    mean: Array
    # Part of the normal force that the fluid pressure bears in the contact; NaN where that is unknown.
    fluid_share: Array
    # Per solvent or solute what has left the body through the surface since the first state, mm^3 or nmol.
    flows: dict[str, Array]


def contacts(plot: PlotFile) -> list[Contact]:
    """Surfaces that bear a contact pressure at some time, with their histories.

    FEBio's contacts of one pass leave that of the secondary surface at zero.
    """
    last = plot.states[-1].on_surfaces.get(PRESSURE, [])
    written = [_contact(plot, place) for place, values in enumerate(last) if values is not None]
    return [contact for contact in written if contact.peak.any()]


def _contact(plot: PlotFile, place: int) -> Contact:
    surface = plot.surfaces[place]
    instants = [_instant(plot, state, place) for state in plot.states]
    time = np.array([state.time for state in plot.states])
    force, area, peak, mean, share = np.array(instants).T
    return Contact(surface, place, time, force, area, peak, mean, share, _flows(plot, place, time))


def pressures(state: State, surface: Surface, place: int) -> Array:
    """Contact pressure per facet [MPa]; zero where FEBio wrote none."""
    values = state.on_surfaces.get(PRESSURE, [None] * (place + 1))[place]
    return np.zeros(len(surface.facets)) if values is None else surface.at_facets(values)[:, 0]


def _instant(plot: PlotFile, state: State, place: int) -> tuple[float, float, float, float, float]:
    """Force, area, largest and mean pressure, and the share of the fluid, as in `Contact`."""
    surface = plot.surfaces[place]
    vectors = surface.area_vectors(plot.positions(state))
    areas = np.linalg.norm(vectors, axis=1)
    pressure = pressures(state, surface, place)
    loaded = pressure > 0
    normal_force = float(pressure @ areas)
    area = float(areas[loaded].sum())
    share = _fluid_share(state, surface, areas * loaded, normal_force)
    mean = normal_force / area if area > 0 else 0.0
    return _force(state, place, pressure, vectors), area, float(pressure.max(initial=0.0)), mean, share


def _force(state: State, place: int, pressure: Array, vectors: Array) -> float:
    """Contact force that FEBio wrote, or the integral of the pressure."""
    written = state.on_surfaces.get(FORCE, [])
    values = written[place] if place < len(written) else None
    return float(np.linalg.norm(-pressure @ vectors if values is None else values[0]))


def _fluid_share(state: State, surface: Surface, loaded_areas: Array, normal_force: float) -> float:
    for name in FLUID:
        values = state.in_domains.get(name)
        if values is None or normal_force <= 0:
            continue
        at_facets = np.array([values[facet].mean(axis=0) for facet in surface.facets])[:, 0]
        if np.isfinite(at_facets).all():
            return float(at_facets @ loaded_areas / normal_force)
    return float("nan")


def _flows(plot: PlotFile, place: int, time: Array) -> dict[str, Array]:
    """Flows through the surface, summed over time by the trapezoidal rule; none where the file has none."""
    found: dict[str, Array] = {}
    for name in (SOLVENT_FLOW, SOLUTE_FLOW):
        rates = [state.on_surfaces.get(name, [None] * (place + 1))[place] for state in plot.states]
        known = [rate[0] for rate in rates if rate is not None]
        if len(known) != len(rates) or not known:
            continue
        table = np.array(known)
        steps = np.diff(time)[:, None] * 0.5 * (table[1:] + table[:-1])
        through = np.vstack([np.zeros((1, table.shape[1])), np.cumsum(steps, axis=0)])
        for column in range(table.shape[1]):
            label = name.split()[1] if table.shape[1] == 1 else f"{name.split()[1]} {column + 1}"
            found[label] = through[:, column]
    return found
