"""Two cubes in contact over one interface, or over two that share the nodes of the middle."""

from __future__ import annotations

from dataclasses import dataclass, replace

from harness.models.diffusion import CLOSING, MATERIAL
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, column, contacts, header
from harness.models.mesh import Layer, Section
from harness.models.parts import Control, concentration, displace, fix, pressure
from studies.hard_cases.together import two_patches


@dataclass(frozen=True)
class Patches:
    """Ambient values that differ from left to right, so that solute also moves along the interface.

    Attributes
    ----------
    interface : InterfaceType
    settings : ContactSettings, optional
    divided : bool
        Whether each half of the contact is an interface of its own.
    control : Control
    name : str
    """

    interface: InterfaceType = InterfaceType.MIXTURE
    settings: ContactSettings | None = None
    divided: bool = True
    control: Control = Control(4, 2000.0)
    name: str = "patches"

    def model(self) -> Model:
        """The model of these choices."""
        layers = [Layer("lower", "gel", 1.0, 5), Layer("upper", "gel", 1.0, 5)]
        mesh = column(self.interface, layers, bottom=-1.0, section=Section((2.0, 1.0), (2, 1)))
        if self.interface.is_contact and self.divided:
            faces = mesh.surfaces["upper-bottom"]
            halves = {"half-1": faces[:1], "half-2": faces[1:]}
            mesh = two_patches(replace(mesh, surfaces=mesh.surfaces | halves), "lower-top", ("half-1", "half-2"))
        left = mesh.node_sets["bottom"][mesh.nodes[mesh.node_sets["bottom"] - 1, 0] == 0.0]
        mesh = replace(mesh, node_sets=mesh.node_sets | {"left": left})
        conditions = (
            fix("all", "xy"),
            fix("bottom", "z"),
            displace("top", "z", -CLOSING),
            pressure("bottom", 0.0),
            concentration("left", 1.0),
        )
        about = "Two cubes in contact over two interfaces that share the nodes of the middle."
        text = header(self.name, about, self.interface)
        joined = contacts(self.interface, mesh, self.settings)
        return Model(self.name, text, self.interface.module, mesh, {"gel": MATERIAL}, conditions, self.control, joined)
