"""Confined creep of a biphasic layer that is cut in two across the direction of flow."""

from __future__ import annotations

from dataclasses import dataclass

from harness.models.document import Model
from harness.models.header import header
from harness.models.interface import ContactSettings, Join, column, contacts
from harness.models.mesh import Layer, Section
from harness.models.parts import Control, Mixture, Solid, fix, normal_load, pressure

HEIGHT = 2.0
"""mm."""
MODULUS = 1.0
"""Aggregate modulus H (MPa): Young's modulus, since Poisson's ratio is 0."""
PERMEABILITY = 1e-3
"""mm^4/(N s)."""
LOAD = 1e-4
"""Step load P0, MPa; small, so that strains are."""
OVERLAP = 1e-10
"""mm by which the two halves overlap at first, so that they are in contact when the load comes."""

ABOUT = """\
Confined creep of a biphasic layer that is cut in two at half its height.

The layer fills 0 < z < 2 mm. Its lower face is sealed and fixed, the sides are confined, and a step load of
0.0001 MPa presses on the upper face, through which the solvent leaves. With an ideal interface at z = 1 mm the layer
creeps as if it were whole: Mow, Kuei, Lai, Armstrong (1980), J Biomech Eng 102(1):73-84. The halves overlap by
1e-10 mm at first: a body under a load alone must be in contact from the start."""


@dataclass(frozen=True)
class Confined:
    """Choices of the confined creep problem; as in `harness.models.diffusion.Diffusion`."""

    join: Join = Join.MIXTURE
    settings: ContactSettings | None = None
    elements: int = 20
    control: Control = Control(100, 20.0)
    section: Section = Section()
    name: str = "confined-creep"
    plot: bool = False

    def model(self) -> Model:
        """The model of these choices."""
        layers = [Layer("lower", "gel", HEIGHT / 2, self.elements), Layer("upper", "gel", HEIGHT / 2, self.elements)]
        mesh = column(self.join, layers, bottom=0.0, section=self.section, gap=-OVERLAP)
        conditions = (fix("all", "xy"), fix("bottom", "z"), pressure("top", 0.0), normal_load("top", LOAD))
        return Model(
            name=self.name,
            header=header(self.name, ABOUT, self.join),
            module="biphasic",
            mesh=mesh,
            materials={"gel": Mixture(Solid(MODULUS), PERMEABILITY)},
            conditions=conditions,
            control=self.control,
            contacts=contacts(self.join, mesh, self.settings),
            plot=self.plot,
        )
