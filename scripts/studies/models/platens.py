"""Gallery: confined compression between a permeable and an impermeable platen."""

from dataclasses import dataclass

from harness.models import parts
from harness.models.document import Model
from harness.models.interface import InterfaceType, contacts, header
from harness.models.mesh import Layer, split_column

SAMPLE, PLATEN = 1.0, 0.5  # heights of the sample and of each platen, mm
COMPRESSION = 0.1  # mm by which the upper platen is driven down
RAMP = 100.0  # s in which it is driven, and in which the ambient concentration rises
AMBIENT = 1.0  # mM
OVERLAP = 1e-10
"""mm by which neighbours overlap at first: the sample is held by its contacts alone, so they must be closed."""
TISSUE = parts.Mixture(
    parts.Solid(1.0), permeability=1e-3, solutes=(parts.Solute(1, diffusivity=5e-4, free_diffusivity=1e-3),)
)
POROUS = parts.Mixture(
    parts.Solid(1000.0), permeability=1.0, porosity=0.4, solutes=(parts.Solute(1, 1e-3, free_diffusivity=1e-3),)
)
STEEL = parts.Elastic(parts.Solid(1e5, 0.3))

ABOUT = """\
Confined compression of cartilage between a permeable and an impermeable platen.

A cartilage sample 1 mm high is confined at its sides. It lies on an impermeable platen of steel, below a permeable
platen of sintered metal (porosity 0.4). Each platen is 0.5 mm high. The upper platen moves down by 0.1 mm within 100 s
and then stops. The fluid pressure at its upper face is zero, and the concentration there rises to 1 mM within 100 s.
The effective fluid pressure there is -R T c and falls to -0.0024776 MPa. Solvent leaves and solute enters through the
permeable platen alone. Both contacts have the same type. The upper contact transmits traction, solvent and solute, and
the lower contact transmits traction alone."""


@dataclass(frozen=True)
class Platens:
    elements: int = 20  # through the sample; a platen has a fifth of it
    control: parts.Control = parts.Control(120, 25.0)
    plot: bool = False

    def model(self) -> Model:
        few = max(1, self.elements // 5)
        layers = [
            Layer("impermeable", "steel", PLATEN, few),
            Layer("sample", "tissue", SAMPLE, self.elements),
            Layer("permeable", "porous", PLATEN, few),
        ]
        mesh = split_column(layers, bottom=-PLATEN, gap=-OVERLAP)
        conditions = (
            parts.fix("all", "xy"),
            parts.fix("bottom", "z"),
            parts.displace("top", "z", -COMPRESSION, 1),
            parts.pressure("top", parts.effective_pressure(AMBIENT), 1),
            parts.concentration("top", AMBIENT, 1),
        )
        return Model(
            "platens",
            header("platens", ABOUT, InterfaceType.MIXTURE),
            InterfaceType.MIXTURE.module,
            mesh,
            {"steel": STEEL, "tissue": TISSUE, "porous": POROUS},
            conditions,
            self.control,
            contacts(InterfaceType.MIXTURE, mesh, None),
            (parts.Curve(((0.0, 0.0), (RAMP, 1.0))),),
            plot=self.plot,
            further_columns=("Rz",),
        )
