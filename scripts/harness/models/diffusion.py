"""Problem 3.1: a solute diffuses through two cubes in contact, from one face to an impermeable other one."""

from dataclasses import dataclass

from harness.models import parts
from harness.models.layered import Layered
from harness.models.mesh import Layer

HEIGHT = 2.0  # mm, both cubes together
AMBIENT = 1.0  # ambient concentration c*, mM
DIFFUSIVITY = 5e-4  # mm^2/s
CLOSING = 1e-3  # mm by which the impermeable face is moved, so that the cubes are in contact

MATERIAL = parts.Mixture(parts.Solid(10.0), permeability=1e-4, solutes=(parts.Solute(1, DIFFUSIVITY, DIFFUSIVITY),))
ABOUT = """\
Transient diffusion across a contact interface: problem 3.1 of Ateshian, Maas and Weiss (2012),
J Biomech 45(6):1023-1027, doi:10.1016/j.jbiomech.2012.01.003.

Two cubes with edges of 1 mm meet at z = 0. The concentration at the face z = -1 mm is 1 mM. The face z = +1 mm is
impermeable and moves by -0.001 mm, which closes the contact. The solute diffuses from the lower face into both cubes.
With an ideal interface, the concentration follows the closed form of a single slab of 2 mm thickness. This slab has
the concentration c* on one face and no flux through the other."""


@dataclass(frozen=True)
class Diffusion(Layered):
    """Choices of problem 3.1."""

    control: parts.Control = parts.Control(400, 20.0)
    name: str = "diffusion"
    # Materials of the two cubes.
    lower: parts.Mixture = MATERIAL
    upper: parts.Mixture = MATERIAL
    ambient: tuple[float, ...] = (AMBIENT,)  # ambient concentration of each solute, mM

    ABOUT = ABOUT
    CLOSING = CLOSING
    BOTTOM = -HEIGHT / 2

    @property
    def materials(self) -> dict[str, parts.Material]:
        """One of both cubes, if they are of the same."""
        if self.lower == self.upper:
            return {"gel": self.lower}
        return {"lower-gel": self.lower, "upper-gel": self.upper}

    @property
    def layers(self) -> list[Layer]:
        """The two cubes."""
        names = tuple(self.materials)
        return [
            Layer("lower", names[0], HEIGHT / 2, self.elements),
            Layer("upper", names[-1], HEIGHT / 2, self.elements),
        ]

    @property
    def prescribed(self) -> tuple[parts.Condition, ...]:
        """Ambient below, impermeable above."""
        return (
            parts.pressure("bottom", parts.effective_pressure(sum(self.ambient))),
            *(parts.concentration("bottom", value, sol=number) for number, value in enumerate(self.ambient, 1)),
        )
