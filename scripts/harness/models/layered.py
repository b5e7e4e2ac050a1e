"""What the models of two layers in contact, one above the other, have in common."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, column, contacts, header
from harness.models.mesh import Layer, Section
from harness.models.parts import Condition, Control, Material, displace, fix


@dataclass(frozen=True)
class Layered:
    """Choices of a model of two layers; a subclass says what they are made of and what is prescribed.

    All sides are held, and so is the lowest face; the highest one is moved down by `CLOSING`, unless that is 0.
    """

    interface: InterfaceType = InterfaceType.MIXTURE
    settings: ContactSettings | None = None  # default settings without it
    elements: int = 20  # Hex8 through the thickness of each layer
    control: Control = Control(100, 20.0)
    section: Section = Section()
    module: str | None = None  # the module that `interface` asks for without it
    name: str = "layered"
    plot: bool = False

    ABOUT: ClassVar[str]  # what the model shows
    CLOSING: ClassVar[float] = 0.0  # mm by which the highest face is moved, so that the layers are in contact
    BOTTOM: ClassVar[float] = 0.0  # z of the lowest face, mm
    GAP: ClassVar[float] = 0.0  # distance of the layers at first, mm; negative for an overlap
    MATERIALS: ClassVar[Mapping[str, Material]]
    COLUMN: ClassVar[tuple[tuple[str, str, float], ...]]
    """Name, material and thickness (mm) of each layer, from the lowest on."""
    PRESCRIBED: ClassVar[tuple[Condition, ...]]
    """Pressures, concentrations and loads, on the node sets ``bottom`` and ``top``."""
    LOGGED: ClassVar[tuple[str, ...]] = ()  # element data to write, by their names in the module `solute`

    @property
    def title(self) -> str:
        """Name of the model."""
        return self.name

    @property
    def about(self) -> str:
        """What the model shows."""
        return self.ABOUT

    @property
    def layers(self) -> list[Layer]:
        """From the lowest on."""
        return [Layer(*each, self.elements) for each in self.COLUMN]

    @property
    def materials(self) -> Mapping[str, Material]:
        """By the names that the layers give."""
        return self.MATERIALS

    @property
    def prescribed(self) -> tuple[Condition, ...]:
        """What is prescribed at both ends."""
        return self.PRESCRIBED

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """What holds and closes the layers, and what is prescribed."""
        closing = (displace("top", "z", -self.CLOSING),) if self.CLOSING else ()
        return (fix("all", "xy"), fix("bottom", "z"), *closing, *self.prescribed)

    @property
    def element_columns(self) -> tuple[str, ...]:
        """Element data to write, by the names of the module."""
        others = {"c": "c1", "jz": "j1z"} if self.module_used != "solute" else {}
        return tuple(others.get(name, name) for name in self.LOGGED)

    @property
    def module_used(self) -> str:
        """The chosen module, or the one of the interface."""
        return self.module or self.interface.module

    def model(self) -> Model:
        """The model of these choices."""
        mesh = column(self.interface, self.layers, bottom=self.BOTTOM, section=self.section, gap=self.GAP)
        return Model(
            name=self.title,
            header=header(self.title, self.about, self.interface),
            module=self.module_used,
            mesh=mesh,
            materials=self.materials,
            conditions=self.conditions,
            control=self.control,
            contacts=contacts(self.interface, mesh, self.settings),
            element_columns=self.element_columns,
            plot=self.plot,
        )
