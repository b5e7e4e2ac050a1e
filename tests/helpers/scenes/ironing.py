"""A round indenter pressed into a slab and slid over it: how much the reaction ripples as facets pass facets.

The pore pressure is held at zero everywhere, so the bodies are elastic.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.models import blocks
from harness.models.blocks import Body
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh, Part
from harness.models.parts import Control, Curve, Mixture, Solid, displace, fix, pressure

Array = NDArray[np.float64]

PASSED = 10
"""Facets over which the indenter slides."""
DEPTH = 0.2
"""mm by which it is pressed down."""
RADIUS = 3.0
"""mm."""
HALF_WIDTH = 1.25
"""Of the indenter, mm."""
LENGTH, HEIGHT, THICKNESS = 10.0, 2.0, 0.5
"""Of the slab, mm."""
PRESSING, STEPS_A_FACET = 5, 12
"""Steps of pressing, and of sliding over one facet."""
NEAR = 1e-9
"""Tolerance for positions, mm."""
SOFT, STIFF = Mixture(Solid(1.0, 0.3), permeability=1e-3), Mixture(Solid(10.0, 0.3), permeability=1e-3)
CONTROL = Control(
    PRESSING + PASSED * STEPS_A_FACET,
    1.0,
    displacement_tolerance=1e-5,
    energy_tolerance=1e-6,
    reformations=30,
)
ABOUT = """\
Ironing: a round indenter is pressed 0.2 mm into a soft slab and slid over ten of its facets. Its reaction should not
change while it slides; what it ripples is the error of the contact, of mesh and integration."""


@dataclass(frozen=True)
class Ironing:
    """Choices of this problem.

    Attributes
    ----------
    settings : ContactSettings, optional
    facet : float
        Width of the slab's facets, mm.
    across : int
        Elements of the indenter along x.
    indenter_is_primary : bool
    name : str
    """

    settings: ContactSettings | None = None
    facet: float = 0.2
    across: int = 12
    indenter_is_primary: bool = True
    interface: InterfaceType = InterfaceType.MIXTURE
    name: str = "ironing"

    def model(self) -> Model:
        """The model of these choices."""
        mesh = self._mesh()
        end = float(CONTROL.steps)
        press = Curve(((0.0, 0.0), (float(PRESSING), 1.0)))
        slide = Curve(((0.0, 0.0), (float(PRESSING), 0.0), (end, 1.0)))
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "biphasic",
            mesh,
            {"soft": SOFT, "stiff": STIFF},
            (
                fix("all", "z"),
                fix("bottom", "xy"),
                displace("top", "y", -DEPTH, 1),
                displace("top", "x", PASSED * self.facet, 2),
                pressure("all", 0.0),
            ),
            CONTROL,
            contacts(self.interface, mesh, self.settings),
            (press, slide),
            further_columns=("Rx", "Ry"),
        )

    def _mesh(self) -> Mesh:
        start = (LENGTH - PASSED * self.facet) / 2.0
        slab, indenter = _slab(self.facet), _indenter(self.across, start)
        offset = len(slab.nodes)
        nodes = np.concatenate([slab.nodes, indenter.nodes])
        number = np.arange(1, len(nodes) + 1, dtype=np.int64)
        low = float(indenter.nodes[:, 1].min())
        sets = {
            "all": number,
            "bottom": number[:offset][slab.nodes[:, 1] < NEAR],
            "top": number[offset:][indenter.nodes[:, 1] > low + 1.0 - NEAR],
        }
        surfaces = {
            "slab": blocks.facets_where(slab, lambda x: x[..., 1] > HEIGHT - NEAR) + 1,
            "indenter": blocks.facets_where(indenter, lambda x: x[..., 1] < _round(x[..., 0] - start) + NEAR)
            + offset
            + 1,
        }
        pair = ("indenter", "slab") if self.indenter_is_primary else ("slab", "indenter")
        parts = (Part("slab", "soft", slab.elements + 1), Part("indenter", "stiff", indenter.elements + offset + 1))
        return Mesh(nodes, parts, sets, surfaces, {"contact": pair})


def _round(x: Array) -> Array:
    """Height of the indenter's round face at a distance from its middle."""
    return np.asarray(HEIGHT + RADIUS - np.sqrt(RADIUS**2 - x**2))


def _slab(facet: float) -> Body:
    lines = (np.linspace(0.0, LENGTH, round(LENGTH / facet) + 1), np.linspace(0.0, HEIGHT, 5), np.array([0, THICKNESS]))
    return blocks.structured(np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1))


def _indenter(across: int, start: float) -> Body:
    """Between its round face, lowest at x = `start`, and a flat top 1 mm above."""
    along = np.linspace(-HALF_WIDTH, HALF_WIDTH, across + 1)
    points = np.stack(np.meshgrid(along, np.linspace(0.0, 1.0, 4), np.array([0, THICKNESS]), indexing="ij"), axis=-1)
    face = _round(points[..., 0])
    points[..., 0] += start
    points[..., 1] = face + points[..., 1] * (HEIGHT + 1.0 - face)
    return blocks.structured(points)
