"""Two layers with a membrane between them, which solvent and solute cross."""

from dataclasses import dataclass
from typing import ClassVar

from harness.models.interface import ContactSettings
from harness.models.layered import Layered
from harness.models.parts import (
    GAS_CONSTANT,
    TEMPERATURE,
    Condition,
    Control,
    Mixture,
    Param,
    Solid,
    Solute,
    concentration,
    fix,
    pressure,
)
from studies.closed_forms.film import Faces, Film, Steady, layer, steady

THICKNESSES = (1.0, 0.5)  # mm
DIFFUSIVITIES = (5e-4, 8e-4)  # mm^2/s, in the mixture and in free solution
POROSITIES = (0.8, 0.7)
PERMEABILITIES = (1e-3, 5e-4)  # mm^4/(N s)
FILM = Film(conductance=2e-3, permeance=2e-5, reflection=0.6)
FACES = Faces((0.06, 0.0), (1.0, 0.2), GAS_CONSTANT * TEMPERATURE)

ABOUT = """\
Solvent and solute cross a membrane between two layers with a solid that does not move.

The lower layer (1 mm) and the upper layer (0.5 mm) touch at z = 1 mm. The membrane there has a hydraulic conductance
of 0.002 mm^3/(N s). Its permeance for the solute is 2e-5 mm/s, and its reflection coefficient is 0.6. The effective
pressure and the concentration are 0.06 MPa and 1 mM at the lower face, and 0 and 0.2 mM at the upper face. After
1.2e6 s the state is steady and follows the closed form of three films in series (Kedem and Katchalsky 1958, Spiegler
and Kedem 1966)."""


def film_params(film: Film, **sol: str) -> tuple[Param, ...]:
    """The parameters of a membrane for one solute, with the attributes of its tags."""
    return (
        Param("hydraulic_conductance", film.conductance),
        Param("solute_permeance", film.permeance, None, sol),
        Param("reflection", film.reflection, None, sol),
    )


@dataclass(frozen=True)
class Membrane(Layered):
    elements: int = 40
    control: Control = Control(60, 2e4)
    name: str = "membrane"
    film: Film = FILM
    faces: Faces = FACES
    enforcement: tuple[Param, ...] = ()  # further parameters of the contact

    ABOUT = ABOUT
    MATERIALS: ClassVar = {
        name: Mixture(Solid(10.0), k, phi, (Solute(1, d, d),))
        for name, k, phi, d in zip(("first", "second"), PERMEABILITIES, POROSITIES, DIFFUSIVITIES, strict=True)
    }
    COLUMN = (("lower", "first", THICKNESSES[0]), ("upper", "second", THICKNESSES[1]))
    LOGGED = ("wz", "jz")

    def __post_init__(self) -> None:
        if self.settings is None:
            extra = (*film_params(self.film, sol="1"), *self.enforcement)
            object.__setattr__(self, "settings", ContactSettings(extra=extra))

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """Both outer faces prescribed."""
        return (
            fix("all", "xyz"),
            *(pressure(face, value) for face, value in zip(("bottom", "top"), self.faces.pressures, strict=True)),
            *(
                concentration(face, value)
                for face, value in zip(("bottom", "top"), self.faces.concentrations, strict=True)
            ),
        )

    def closed_form(self) -> Steady:
        """The steady state."""
        parts = [layer(*values) for values in zip(THICKNESSES, PERMEABILITIES, DIFFUSIVITIES, POROSITIES, strict=True)]
        return steady(parts[0], self.film, parts[1], self.faces)
