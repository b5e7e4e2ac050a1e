"""Two bodies apart, or partly in contact, so that contact nodes are at ambient values."""

from __future__ import annotations

from dataclasses import dataclass, replace

from harness.models.diffusion import MATERIAL
from harness.models.document import Model
from harness.models.interface import InterfaceType, default_settings, header
from harness.models.mesh import Box, assemble
from harness.models.parts import Condition, Contact, Control, Curve, Param, concentration, displace, fix, pressure
from studies.hard_cases.together import two_patches

PRESSURE = -1e-3
"""Ambient effective pressure at the end of its load curve, MPa."""
CONCENTRATION = 0.4
"""Ambient effective concentration at the end of its load curve, mM."""
CURVES = (Curve(((0.0, 0.0), (1000.0, 1.0))), Curve(((0.0, 0.0), (600.0, 0.5), (1000.0, 1.0))))
"""Load curves of the ambient pressure and of the ambient concentration."""


def ambient(module: str) -> tuple[Param, ...]:
    """Ambient values that follow `CURVES`, in the spelling of the module."""
    if module == "multiphasic":
        dissolved = Param("ambient_concentration", CONCENTRATION, 2, {"sol": "1"})
    else:
        dissolved = Param("ambient_concentration", CONCENTRATION, 2)
    return (Param("ambient_pressure", PRESSURE, 1), dissolved)


@dataclass(frozen=True)
class Apart:
    """Two cubes with a gap between them.

    Attributes
    ----------
    interface : InterfaceType
    gap : float
        mm.
    held : tuple of Condition
        Conditions on nodes of the contact surfaces (``lower-top``, ``upper-bottom``), which ambient values leave alone.
    control : Control
    name : str
    module : str, optional
        The module that `interface` asks for without it.
    """

    interface: InterfaceType = InterfaceType.MIXTURE
    gap: float = 0.5
    held: tuple[Condition, ...] = ()
    control: Control = Control(10, 100.0)
    name: str = "apart"
    module: str | None = None

    def model(self) -> Model:
        """The model of these choices."""
        boxes = [Box("lower", "gel", (0.0, 0.0, -1.0), (1.0, 1.0, 1.0), (1, 1, 5))]
        boxes.append(Box("upper", "gel", (0.0, 0.0, self.gap), (1.0, 1.0, 1.0), (1, 1, 5)))
        mesh = replace(assemble(boxes), pairs={"lower/upper": ("lower-top", "upper-bottom")})
        module = self.module or self.interface.module
        conditions = (fix("all", "xy"), fix("lower-bottom", "z"), fix("upper-top", "z"), *self.held)
        about = "Two cubes apart; ambient pressure and concentration follow load curves."
        contact = Contact(self.interface.value, "lower/upper", (*_settings(self.interface), *ambient(module)))
        text = header(self.name, about, self.interface)
        materials = {"gel": MATERIAL}
        return Model(self.name, text, module, mesh, materials, conditions, self.control, (contact,), CURVES)


@dataclass(frozen=True)
class HalfWet:
    """A slab with two interfaces that share the nodes of its middle: the left one closed, the right one open."""

    interface: InterfaceType = InterfaceType.MIXTURE
    control: Control = Control(10, 100.0)
    name: str = "half-wet"

    def model(self) -> Model:
        """The model of these choices."""
        boxes = [Box("slab", "gel", (0.0, 0.0, -1.0), (2.0, 1.0, 1.0), (2, 1, 5))]
        boxes.append(Box("left", "gel", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1, 1, 5)))
        boxes.append(Box("right", "gel", (1.0, 0.0, 0.5), (1.0, 1.0, 1.0), (1, 1, 5)))
        mesh = two_patches(assemble(boxes), "slab-top", ("left-bottom", "right-bottom"))
        conditions = (
            fix("all", "xy"),
            fix("slab-bottom", "z"),
            fix("right-top", "z"),
            displace("left-top", "z", -1e-3),
            concentration("slab-bottom", 1.0),
            pressure("slab-bottom", 0.0),
        )
        settings = (*_settings(self.interface), *ambient(self.interface.module))
        joined = tuple(Contact(self.interface.value, pair, settings) for pair in mesh.pairs)
        about = "A slab in contact on its left half and at ambient values on its right half."
        text = header(self.name, about, self.interface)
        materials = {"gel": MATERIAL}
        return Model(self.name, text, self.interface.module, mesh, materials, conditions, self.control, joined, CURVES)


def _settings(interface: InterfaceType) -> tuple[Param, ...]:
    """The default settings; a search radius keeps FEBio's own types from joining what is apart."""
    given = default_settings(interface)
    return given.params() if interface is InterfaceType.MIXTURE else replace(given, search_radius=0.1).params()
