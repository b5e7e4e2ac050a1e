"""Strips that come apart: a double cantilever beam, an end-notched flexure, a strip that is peeled off.

Plane strain with a Poisson's ratio of 0, one element wide. Strips lie along x and part along z = 0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scenes.breaking_blocks import BONDS, CONTENTS, FLOWS
from scenes.tied_columns import EXACTLY, MODULES, SOLUTES, held, initial, mixed, reachable
from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed, moved

Array = NDArray[np.float64]
ALL = "all-nodes"
MOST_MATRICES = 150
"""In a step: a crack that jumps over several nodes takes some iterations for each."""


@dataclass(frozen=True)
class Strips:
    """Two strips that are tied beyond a crack, and what they are made of.

    Attributes
    ----------
    cells : int
        Elements across the thickness of a strip.
    finer : int
        Elements along a strip over a length in which as many as one would be cubes.
    length, crack, thickness : float
        Of each strip, mm; the crack begins at x = 0.
    modulus, strength, energy : float
        Young's modulus and strength of bonds, MPa, and the energy that breaks them, N/mm; the same in both modes.
    opening : float
        Largest distance that the ends move apart, or that a flexure is pressed down; length at last of the free part
        of a strip that is peeled; mm.
    steps : int
        Equal time steps.
    more : str
        Further parameters of the tie.
    """

    cells: int = 4
    finer: int = 1
    length: float = 14.0
    crack: float = 6.0
    thickness: float = 1.0
    modulus: float = 1000.0
    strength: float = 0.2
    energy: float = 1e-3
    opening: float = 0.24
    steps: int = 40
    more: str = ""

    @property
    def width(self) -> float:
        """Of the strips, mm: one element."""
        return self.thickness / self.cells

    @property
    def along(self) -> int:
        """Elements along a strip."""
        return round(self.length * self.cells * self.finer / self.thickness)

    @property
    def element(self) -> float:
        """Volume of an element, mm^3."""
        return self.length / self.along * self.width * self.thickness / self.cells

    @property
    def tie(self) -> str:
        """Parameters of the tie."""
        energy = f"<fracture_energy>{self.energy!r}</fracture_energy>"
        return f"<max_traction>{self.strength!r}</max_traction>{energy}{self.more}"


def two_strips(strips: Strips) -> Parts:
    """The strips, with the surfaces `up-tied` and `low-tied` beyond the crack."""
    parts = Parts()
    h, b = strips.thickness, strips.width
    parts.box("low", (0, 0, -h), (strips.length, b, 0), (strips.along, 1, strips.cells), "low")
    parts.box("up", (0, 0, 0), (strips.length, b, h), (strips.along, 1, strips.cells), "up")
    for name, side in (("up", "bottom"), ("low", "top")):
        middle = {f: np.mean([parts.nodes[n - 1][0] for n in f]) for f in parts.surfaces[f"{name}-{side}"]}
        parts.surfaces[f"{name}-tied"] = [f for f, x in middle.items() if x > strips.crack]
        parts.surfaces[f"{name}-crack"] = [f for f, x in middle.items() if x < strips.crack]
    parts.node_sets[ALL] = list(range(1, len(parts.nodes) + 1))
    return parts


def document(strips: Strips, parts: Parts, boundary: list[str], *contacts: str) -> Document:
    """A model of strips whose ends follow the first load curve, from 0 to 1."""
    inner = control("solid", strips.steps, 1 / strips.steps, retries=8)
    tolerances = EXACTLY.split("<ptol>", maxsplit=1)[0].replace("1e-12", "1e-8").replace("1e-9", "1e-6")
    return Document(
        parts.mesh({"tie": ("up-tied", "low-tied"), "crack": ("up-crack", "low-crack")}),
        tuple(elastic(name, n, strips.modulus) for n, name in enumerate(("low", "up"), 1)),
        control=inner.replace("<max_refs>25<", f"{tolerances}<lstol>0</lstol><max_refs>{MOST_MATRICES}<"),
        boundary=[fixed(ALL, "y"), *boundary],
        contacts=(contact("tie", "tie", "tied-mixture", strips.tie), *contacts),
        curves=(curve(1, (0, 0), (1, 1)),),
        node_data="Rx;Rz",
        surface_data={"up-tied": f"{BONDS};viscous energy"},
    )


def double_cantilever_beam(strips: Strips) -> Document:
    """Two strips whose ends at x = 0 are drawn apart."""
    parts = two_strips(strips)
    ends = [moved("up-left", "z", 0.5 * strips.opening), moved("low-left", "z", -0.5 * strips.opening)]
    return document(strips, parts, [fixed("low-right", "x"), *ends])


def soaked_beam(strips: Strips) -> Document:
    """The beam with fluid and a solute."""
    return soaked(double_cantilever_beam(strips), strips)


def soaked(dry: Document, strips: Strips) -> Document:
    """Strips with fluid and a solute, more in the lower one. Their outer faces are drained, and keep the solute."""
    of_parts = {part.name: sorted({n for e in part.elements for n in e}) for part in two_strips(strips).parts}
    sets = "".join(
        f'<NodeSet name="{name}-all">{",".join(map(str, nodes))}</NodeSet>' for name, nodes in of_parts.items()
    )
    further = EXACTLY.split("<etol>", maxsplit=1)[1].split("</etol>", maxsplit=1)[1]
    transient = dry.control.replace("STATIC", "TRANSIENT").replace('type="solid"', 'type="solute"')
    return replace(
        dry,
        mesh=dry.mesh.replace("<NodeSet", f"{sets}<NodeSet", 1),
        materials=[mixed(n, k).replace("<E>1.0<", f"<E>{strips.modulus}<") for k, n in enumerate(("low", "up"), 1)],
        module="solute",
        control=transient.replace("<lstol>", f"{reachable(further)}<lstol>"),
        boundary=[*dry.boundary, *(held("fluid pressure", where, 0.0) for where in ("up-top", "low-bottom"))],
        node_data=f"{MODULES['solute']};Rx;Rz",
        surface_data=dict.fromkeys(("up-tied", "low-tied"), f"{BONDS};viscous energy;{FLOWS}"),
        globals=SOLUTES,
        further={"Initial": [initial(f"{name}-all", value) for name, value in CONTENTS.items()]},
    )


WHOLE = (0.2, 0.85)
"""The part of the time, and of the way, in which a flexure bends before its crack runs."""


def end_notched_flexure(strips: Strips) -> Document:
    """Strips on supports at both ends that are pressed down in the middle: the crack slides, and is pressed."""
    parts = two_strips(strips)
    place = np.array(parts.nodes)
    h = strips.thickness
    for name, x, z in (("left", 0.0, -h), ("right", strips.length, -h), ("middle", 0.5 * strips.length, h)):
        here = np.abs(place[:, [0, 2]] - (x, z)).max(axis=1) < 1e-9
        parts.node_sets[name] = [int(n) + 1 for n in np.flatnonzero(here)]
    held = [fixed("left", "z"), fixed("right", "x", "z"), moved("middle", "z", -strips.opening)]
    pressed = document(strips, parts, held, contact("crack", "crack", "sliding-mixture"))
    return replace(pressed, curves=(curve(1, (0, 0), WHOLE, (1, 1)),))


TURNED = 0.4
"""The part of the time in which the free part of a strip that is peeled is turned up."""


def path_of_peeling(strips: Strips, angle: float) -> Array:
    """Time and displacements along x and z of the end of a strip, whose crack runs until the free part is `opening`.

    The free part is turned up about the tip of the crack. Its end then goes along the straight line that keeps the
    angle between it and the bonds.
    """
    turn = np.linspace(0, angle, 13)
    arc = strips.crack * np.array([1 - np.cos(turn), np.sin(turn)]).T
    line = strips.opening * np.array([[1 - np.cos(angle), np.sin(angle)]])
    times = np.append(TURNED * np.linspace(0, 1, len(turn)), 1.0)
    return np.column_stack([times, np.vstack([arc, line])])


def peeled(strips: Strips, angle: float) -> Document:
    """A strip that is peeled off another one, which is held, at an angle."""
    parts = two_strips(strips)
    place = np.array(parts.nodes)
    here = np.abs(place[:, [0, 2]] - (0.0, 0.5 * strips.thickness)).max(axis=1) < 1e-9
    parts.node_sets["end"] = [int(n) + 1 for n in np.flatnonzero(here)]
    parts.node_sets["held"] = sorted({n for ids in parts.parts[0].elements for n in ids})
    path = path_of_peeling(strips, angle)
    ends = [moved("end", "x", 1.0, 1), moved("end", "z", 1.0, 2)]
    curves = tuple(curve(n, *path[:, [0, n]].tolist()) for n in (1, 2))
    return replace(document(strips, parts, [fixed("held", "x", "z"), *ends]), curves=curves)


def drawn_along(strips: Strips) -> Document:
    """A strip whose end is drawn along another one, which is held."""
    parts = two_strips(strips)
    parts.node_sets["held"] = sorted({n for ids in parts.parts[0].elements for n in ids})
    return document(strips, parts, [fixed("held", "x", "z"), moved("up-left", "x", -strips.opening)])


def with_energy(text: str) -> str:
    """A model that logs the strain energy density of its elements in sed.txt."""
    return text.replace("</logfile>", '<element_data data="sed" file="sed.txt" delim=" "/></logfile>')
