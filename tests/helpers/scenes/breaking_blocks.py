"""Two blocks that are tied until they break: moved on a path that is prescribed, or pressed together and slid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from scenes.tied_columns import MODULES, SOLUTES, held, initial, mixed, reachable, steps
from studies.models.small import Document, Parts, contact, curve, elastic, fixed, moved

Array = NDArray[np.float64]

BONDS = "contact_force.x;contact_force.y;contact_force.z;fracture energy;bond energy;broken area"
"""What the surfaces of a tie that breaks report."""


PRESSED = 0.02
"""mm by which a block is pressed into the one below it."""


def cohesive(
    strength: tuple[float, float], energy: tuple[float, float], mixing: float, penalty: float, more: str = ""
) -> str:
    """Parameters of a cohesive tie with a given penalty; pairs are of tension and shear."""
    return (
        f"<penalty>{penalty!r}</penalty><auto_penalty>0</auto_penalty><max_traction>{strength[0]!r}</max_traction>"
        f"<max_shear>{strength[1]!r}</max_shear><fracture_energy>{energy[0]!r}</fracture_energy>"
        f"<fracture_energy_shear>{energy[1]!r}</fracture_energy_shear><mixing>{mixing!r}</mixing>{more}"
    )


def moved_on_a_path(path: Sequence[Sequence[float]], params: str) -> Document:
    """Two elements whose nodes are all prescribed, the upper one on a path, and a free one that is not touched.

    Parameters
    ----------
    path : sequence of points
        Displacements of the upper element at the times 1, 2, ... mm.
    params : str
        Parameters of the tie.
    """
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (1, 1, 1), "low")
    parts.box("up", (0, 0, 1), (1, 1, 2), (1, 1, 1), "up")
    parts.box("free", (5, 0, 0), (6, 1, 1), (1, 1, 1), "free")
    parts.node_sets |= {
        f"{name}-all": sorted({n for e in parts.parts[k].elements for n in e}) for k, name in enumerate(("low", "up"))
    }
    axes = "xyz"
    points = np.vstack([np.zeros(3), np.asarray(path)])
    curves = [curve(k + 1, *((float(t), float(p[k])) for t, p in enumerate(points))) for k in range(3)]
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        tuple(elastic(part.material, n) for n, part in enumerate(parts.parts, 1)),
        control=steps("solid", len(path), 1.0),
        boundary=[fixed("low-all", *axes), fixed("free-bottom", *axes)]
        + [moved("up-all", axis, 1.0, k + 1) for k, axis in enumerate(axes)],
        contacts=(contact("tie", "pair", "tied-mixture", params),),
        curves=curves,
        surface_data={"up-bottom": BONDS},
    )


def pressed_and_slid(params: str, *, cells: tuple[int, int] = (2, 3), number: int = 40) -> Document:
    """A block that is drawn off a longer one until it breaks, pressed down again, and slid to and fro.

    It slides over more than a facet. The path has the times 0 to 1 for drawing, 2 for pressing, 3 to 5 for sliding.
    """
    parts = Parts()
    parts.box("low", (0, 0, 0), (3, 1, 0.5), (3 * cells[0], cells[0], 2), "low")
    parts.box("up", (0, 0, 0.5), (1, 1, 1), (cells[1], cells[1], 2), "up")
    for part in parts.parts:
        parts.node_sets[f"{part.name}-all"] = sorted({n for e in part.elements for n in e})
    down = ((0, 0), (1, 0.1), (2, -PRESSED), (5, -PRESSED))
    across = ((0, 0), (2, 0), (3, 0.7), (4, 0.1), (5, 0.5))
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (elastic("low", 1, 1.0, 0.3), elastic("up", 2, 2.0, 0.3)),
        control=steps("solid", number, 5 / number),
        boundary=(
            fixed("low-bottom", "x", "y", "z"),
            fixed("up-top", "y"),
            moved("up-top", "z", 1.0, 1),
            moved("up-top", "x", 1.0, 2),
        ),
        contacts=(contact("tie", "pair", "tied-mixture", params),),
        curves=(curve(1, *down), curve(2, *across)),
        surface_data=dict.fromkeys(("up-bottom", "low-top"), BONDS),
    )


CYCLES = ((0, 0), (0.25, 0.012), (0.5, 0), (0.625, -0.005), (1, 0.1), (2, -PRESSED), (4, -PRESSED), (5, -2 * PRESSED))
"""Time and displacement along z of a block that is drawn, let go, pressed, drawn off, and pressed down again, mm."""
FLOWS = "contact solvent flow;contact solute flow 1"
CONTENTS = {"low": 1.0, "up": 0.5}
"""Effective concentration of the blocks at first, mM."""


def soaked_blocks(params: str, *, number: int = 40) -> Document:
    """The blocks of `pressed_and_slid` with fluid and a solute, in cycles of load. Both ends are drained."""
    dry = pressed_and_slid(params, number=number)
    return replace(
        dry,
        materials=[mixed(name, n) for n, name in enumerate(CONTENTS, 1)],
        module="solute",
        control=reachable(steps("solute", number, 5 / number, "TRANSIENT")),
        boundary=[*dry.boundary, *(held("fluid pressure", where, 0.0) for where in ("up-top", "low-bottom"))],
        curves=(curve(1, *CYCLES), dry.curves[1]),
        node_data=MODULES["solute"],
        surface_data=dict.fromkeys(dry.surface_data, f"{BONDS};{FLOWS}"),
        globals=SOLUTES,
        further={"Initial": [initial(f"{name}-all", value) for name, value in CONTENTS.items()]},
    )
