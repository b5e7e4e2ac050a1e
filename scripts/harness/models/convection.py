"""Problem 3.2: steady convection and diffusion through two cubes in contact."""

from __future__ import annotations

from dataclasses import dataclass

from harness.models.diffusion import CLOSING, DIFFUSIVITY, HEIGHT
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

UPSTREAM = 1.0
"""Concentration at the inlet z = -h/2, mM."""
PERMEABILITY = 1e-3
"""mm^4/(N s)."""
POROSITY = 0.8
PRESSURES = {0: 0.0, 1: 0.4, 10: 4.0}
"""Fluid pressure at the inlet (MPa) for each Peclet number."""

MATERIAL = Mixture(Solid(100.0), PERMEABILITY, POROSITY, (Solute(1, DIFFUSIVITY, DIFFUSIVITY),))
ABOUT = """\
Steady convection and diffusion across a contact interface: problem 3.2 of Ateshian, Maas and Weiss (2012),
J Biomech 45(6):1023-1027, doi:10.1016/j.jbiomech.2012.01.003, at a Peclet number of {peclet}.

Two cubes of 1 mm, in contact at z = 0. Inlet at z = -1 mm: fluid pressure {pressure:g} MPa, 1 mM. Outlet at
z = +1 mm: no pressure, no solute; it is moved by -0.001 mm, which closes the contact. The effective fluid
pressure that FEBio prescribes is p - R T c. After 20000 s the profile is steady and follows the closed form."""


@dataclass(frozen=True)
class Convection:
    """Choices of problem 3.2; `peclet` is 0, 1 or 10, the rest as in `harness.models.diffusion.Diffusion`."""

    peclet: int = 1
    join: Join = Join.MIXTURE
    settings: ContactSettings | None = None
    elements: int = 20
    control: Control = Control(400, 50.0)
    section: Section = Section()
    module: str | None = None
    name: str = "convection"
    plot: bool = False
    upper_divided: tuple[int, int] | None = None

    def model(self) -> Model:
        """The model of these choices."""
        layers = [
            Layer("lower", "gel", HEIGHT / 2, self.elements),
            Layer("upper", "gel", HEIGHT / 2, self.elements, self.upper_divided),
        ]
        mesh = column(self.join, layers, bottom=-HEIGHT / 2, section=self.section)
        inlet = PRESSURES[self.peclet]
        conditions = (
            fix("all", "xy"),
            fix("bottom", "z"),
            displace("top", "z", -CLOSING),
            pressure("bottom", inlet - GAS_CONSTANT * TEMPERATURE * UPSTREAM),
            concentration("bottom", UPSTREAM),
            pressure("top", 0.0),
            concentration("top", 0.0),
        )
        about = ABOUT.format(peclet=self.peclet, pressure=inlet)
        name = f"{self.name}-pe{self.peclet}"
        module = self.module or self.join.module
        joined = contacts(self.join, mesh, self.settings)
        return Model(
            name,
            header(name, about, self.join),
            module,
            mesh,
            {"gel": MATERIAL},
            conditions,
            self.control,
            joined,
            plot=self.plot,
        )
