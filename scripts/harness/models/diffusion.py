"""Problem 3.1: a solute diffuses through two cubes in contact, from a bath on one face, the other face sealed."""

from __future__ import annotations

from dataclasses import dataclass

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

HEIGHT = 2.0
"""mm, both cubes together."""
BATH = 1.0
"""Bath concentration c*, mM."""
DIFFUSIVITY = 5e-4
"""mm^2/s."""
CLOSING = 1e-3
"""mm by which the sealed face is moved, so that the cubes are in contact."""

MATERIAL = Mixture(Solid(10.0), permeability=1e-4, solutes=(Solute(1, DIFFUSIVITY, DIFFUSIVITY),))
ABOUT = """\
Transient diffusion across a contact interface: problem 3.1 of Ateshian, Maas and Weiss (2012),
J Biomech 45(6):1023-1027, doi:10.1016/j.jbiomech.2012.01.003.

Two cubes of 1 mm, in contact at z = 0. A bath of 1 mM at z = -1 mm; the face z = +1 mm is sealed and moved
by -0.001 mm, which closes the contact. The solute diffuses from the bath into both cubes. With an ideal
interface its concentration follows the closed form of one slab of 2 mm, bath on one face, sealed on the other."""


@dataclass(frozen=True)
class Diffusion:
    """Choices of problem 3.1.

    Attributes
    ----------
    join : Join
    settings : ContactSettings, optional
        Default settings without it.
    elements : int
        Hex8 through the thickness of each cube.
    control : Control
    section : Section
    module : str, optional
        The module that `join` asks for without it.
    name : str
    plot : bool
    lower, upper : Mixture
        Materials of the two cubes.
    bath : tuple of float
        Concentration of each solute in the bath, mM.
    upper_divided : tuple of int, optional
        Elements of the upper cube along x and y, where they differ from those of the section.
    """

    join: Join = Join.MIXTURE
    settings: ContactSettings | None = None
    elements: int = 20
    control: Control = Control(400, 20.0)
    section: Section = Section()
    module: str | None = None
    name: str = "diffusion"
    plot: bool = False
    lower: Mixture = MATERIAL
    upper: Mixture = MATERIAL
    bath: tuple[float, ...] = (BATH,)
    upper_divided: tuple[int, int] | None = None

    def model(self) -> Model:
        """The model of these choices."""
        same = self.lower == self.upper
        materials = {"gel": self.lower} if same else {"lower-gel": self.lower, "upper-gel": self.upper}
        names = tuple(materials)
        layers = [
            Layer("lower", names[0], HEIGHT / 2, self.elements),
            Layer("upper", names[-1], HEIGHT / 2, self.elements, self.upper_divided),
        ]
        mesh = column(self.join, layers, bottom=-HEIGHT / 2, section=self.section)
        conditions = (
            fix("all", "xy"),
            fix("bottom", "z"),
            displace("top", "z", -CLOSING),
            pressure("bottom", -GAS_CONSTANT * TEMPERATURE * sum(self.bath)),
            *(concentration("bottom", value, sol=number) for number, value in enumerate(self.bath, 1)),
        )
        module = self.module or self.join.module
        joined = contacts(self.join, mesh, self.settings)
        return Model(
            self.name,
            header(self.name, ABOUT, self.join),
            module,
            mesh,
            materials,
            conditions,
            self.control,
            joined,
            plot=self.plot,
        )
