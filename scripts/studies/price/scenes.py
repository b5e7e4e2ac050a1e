"""Two blocks pressed together, with more and more to exchange: the scenes whose price is measured."""

from dataclasses import dataclass, field
from enum import Enum

from harness.models import parts
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, automatic, header
from harness.models.mesh import Layer, Mesh, Section, conforming_column, split_column

HEIGHT = 1.0  # mm, of each block; their section is 1 mm x 1 mm
CLOSING = 0.01  # mm by which the top is moved down over the run
BELOW, ABOVE = 1.0, 2.0  # effective concentrations at the two ends, mM; 1 mM everywhere at the start
STEPS, STEP = 5, 100.0  # number of steps and their size, s: in one, solutes get about (d STEP)^(1/2) = 0.22 mm far
SOLID = parts.Solid(10.0)
PERMEABILITY = 1e-3  # mm^4/(N s)

ABOUT = """\
Two blocks of 1 mm x 1 mm x 1 mm with matching meshes, pressed together by 0.01 mm in 500 s.

What they exchange: {what}. The upper end is without fluid pressure, at 2 mM of each solute; the lower end
is impermeable to the solvent and held at the initial 1 mM."""


class Kind(str, Enum):
    """What both blocks consist of, by FEBio's name."""

    ELASTIC = "elastic"
    BIPHASIC = "biphasic"
    SOLUTE = "biphasic-solute"
    MULTIPHASIC = "multiphasic"

    @property
    def module(self) -> str:
        """FEBio's module for it."""
        return {Kind.ELASTIC: "solid", Kind.SOLUTE: "solute"}.get(self, self.value)

    @property
    def rival(self) -> str:
        """FEBio's own contact for it."""
        return f"sliding-{self.value}"


@dataclass(frozen=True)
class Scene:
    kind: Kind
    contact: str = InterfaceType.MIXTURE.value  # type of the contact; ``conforming`` for one body without a contact
    solutes: int = 0  # number of solutes of both blocks
    fixed: bool = False  # whether the solid is held everywhere
    # Elements along x and y, and through each block.
    section: int = 8
    through: int = 2
    settings: ContactSettings = ContactSettings()
    control: parts.Control = field(default=parts.Control(STEPS, STEP))

    @property
    def name(self) -> str:
        """Stem of the file names."""
        solutes = f"-{self.solutes}" if self.solutes else ""
        fixed = "-fixed" if self.fixed else ""
        return f"{self.kind.value}{solutes}{fixed}-{self.contact}-{self.section}x{self.through}"

    def model(self) -> Model:
        mesh = self._mesh()
        interface = InterfaceType.ours_in([self.contact])
        end = self.control.steps * self.control.step
        return Model(
            name=self.name,
            header=header(self.name, ABOUT.format(what=self._what()), interface),
            module=self.kind.module,
            mesh=mesh,
            materials={"tissue": self._material()},
            conditions=tuple(self._conditions()),
            control=self.control,
            contacts=tuple(parts.Contact(self.contact, pair, self.settings.params()) for pair in mesh.pairs),
            curves=(parts.Curve(((0.0, 0.0), (end, 1.0))),),
        )

    def _mesh(self) -> Mesh:
        layers = [Layer(name, "tissue", HEIGHT, self.through) for name in ("lower", "upper")]
        make = conforming_column if self.contact == InterfaceType.CONFORMING.value else split_column
        return make(layers, bottom=-HEIGHT, section=Section(elements=(self.section, self.section)))

    def _material(self) -> parts.Material:
        if self.kind is Kind.ELASTIC:
            return parts.Elastic(SOLID)
        solutes = tuple(parts.Solute(sol, solubility=1.0 - 0.05 * sol) for sol in range(1, self.solutes + 1))
        return parts.Mixture(SOLID, PERMEABILITY, solutes=solutes)

    def _conditions(self) -> list[parts.Condition]:
        moved = [parts.fix("all", "xyz")] if self.fixed else [parts.fix("bottom", "xyz"), parts.fix("top", "xy")]
        if not self.fixed:
            moved.append(parts.displace("top", "z", -CLOSING, 1))
        wet = [] if self.kind is Kind.ELASTIC else [parts.pressure("top", 0.0)]
        for sol in range(1, self.solutes + 1):
            wet += [parts.concentration("bottom", BELOW, sol=sol), parts.concentration("top", ABOVE, sol=sol)]
            wet.append(parts.initial_concentration("all", BELOW, sol))
        return [*moved, *wet]

    def _what(self) -> str:
        solvent = ", solvent" * (self.kind is not Kind.ELASTIC)
        return f"traction{solvent}" + (f", {self.solutes} solute{'s' * (self.solutes > 1)}" if self.solutes else "")


def penalties(kind: Kind, factor: float) -> ContactSettings:
    """Automatic penalties times a factor, for what blocks of this kind exchange."""
    chosen = automatic(factor)
    dropped = {Kind.ELASTIC: ("pressure_penalty", "concentration_penalty"), Kind.BIPHASIC: ("concentration_penalty",)}
    return ContactSettings(**{**vars(chosen), **dict.fromkeys(dropped.get(kind, ()))})


def effects_added(section: int = 8) -> dict[str, Scene]:
    """From traction alone to four solutes, by what a picture calls them."""
    return {
        "solid": Scene(Kind.ELASTIC, section=section),
        "+ solvent": Scene(Kind.BIPHASIC, section=section),
        "+ 1 solute": Scene(Kind.MULTIPHASIC, solutes=1, section=section),
        "+ 2 solutes": Scene(Kind.MULTIPHASIC, solutes=2, section=section),
        "+ 4 solutes": Scene(Kind.MULTIPHASIC, solutes=4, section=section),
        "1 solute, fixed": Scene(Kind.MULTIPHASIC, solutes=1, fixed=True, section=section),
    }
