"""A composite slab: diffusion from a bath through two layers of different material, solubility included."""

from __future__ import annotations

from dataclasses import dataclass

from harness.closed_forms import composite_slab
from harness.models.document import Model
from harness.models.header import header
from harness.models.interface import ContactSettings, Join, column, contacts
from harness.models.mesh import Layer, Section
from harness.models.parts import (
    GAS_CONSTANT,
    TEMPERATURE,
    Control,
    Mixture,
    Solid,
    Solute,
    concentration,
    displace,
    fix,
    pressure,
)

BATH = 1.0
"""mM."""
CLOSING = 1e-4
"""mm by which the sealed face is moved."""
FIRST = composite_slab.Layer(thickness=1.0, diffusivity=5e-4, porosity=0.8, solubility=1.0)
SECOND = composite_slab.Layer(thickness=0.75, diffusivity=1e-3, porosity=0.6, solubility=0.5)
STIFFNESS = (100.0, 50.0)
"""Young's moduli, MPa."""
PERMEABILITY = (1e-3, 5e-4)
"""mm^4/(N s)."""

ABOUT = """\
Diffusion into a composite slab: two layers of different material in contact at z = 1 mm.

A bath of 1 mM at z = 0, the face z = 1.75 mm sealed and moved by -0.0001 mm, which closes the contact. The upper
layer has another diffusivity, porosity, stiffness, permeability and half the solubility: the effective concentration
is continuous over an ideal interface, the actual one jumps by the ratio of the solubilities."""


def _material(index: int, data: composite_slab.Layer) -> Mixture:
    solute = Solute(1, data.diffusivity, data.diffusivity, data.solubility)
    return Mixture(Solid(STIFFNESS[index]), PERMEABILITY[index], data.porosity, (solute,))


@dataclass(frozen=True)
class Composite:
    """Choices of the composite slab; as in `harness.models.diffusion.Diffusion`."""

    join: Join = Join.MIXTURE
    settings: ContactSettings | None = None
    elements: int = 20
    control: Control = Control(100, 20.0)
    section: Section = Section()
    module: str | None = None
    name: str = "composite-slab"
    plot: bool = False

    def model(self) -> Model:
        """The model of these choices."""
        layers = [Layer("lower", "first", FIRST.thickness, self.elements)]
        layers.append(Layer("upper", "second", SECOND.thickness, self.elements))
        mesh = column(self.join, layers, bottom=0.0, section=self.section)
        conditions = (
            fix("all", "xy"),
            fix("bottom", "z"),
            displace("top", "z", -CLOSING),
            pressure("bottom", -GAS_CONSTANT * TEMPERATURE * BATH),
            concentration("bottom", BATH),
        )
        module = self.module or self.join.module
        materials = {"first": _material(0, FIRST), "second": _material(1, SECOND)}
        return Model(
            name=self.name,
            header=header(self.name, ABOUT, self.join),
            module=module,
            mesh=mesh,
            materials=materials,
            conditions=conditions,
            control=self.control,
            contacts=contacts(self.join, mesh, self.settings),
            element_columns=("c", "jz") if module == "solute" else ("c1", "j1z"),
            plot=self.plot,
        )
