"""How two bodies are joined: by one of the contact types, or by being one body."""

from __future__ import annotations

from collections.abc import Container, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from harness.models.mesh import Layer, Mesh, Section, conforming_column, split_column
from harness.models.parts import Contact, Param


class InterfaceType(str, Enum):
    """What stands between two neighbouring bodies."""

    MIXTURE = "sliding-mixture"  # the plugin's sliding interface
    TIED = "tied-mixture"  # the plugin's tie
    SOLUTE = "sliding-biphasic-solute"  # FEBio's interface for one solute
    MULTIPHASIC = "sliding-multiphasic"
    """FEBio's interface for any number of solutes; it belongs to the module 'multiphasic'."""
    BIPHASIC = "sliding-biphasic"  # FEBio's interface for solid and solvent
    ELASTIC = "sliding-elastic"  # FEBio's interface for traction alone, with tension and friction at need
    CONFORMING = "conforming"  # no interface: the nodes are merged, and what is left is one body

    @classmethod
    def ours_in(cls, contacts: Container[str]) -> InterfaceType:
        """The plugin's where contacts of these types have one of it, else none."""
        return next((ours for ours in (cls.MIXTURE, cls.TIED) if ours.value in contacts), cls.CONFORMING)

    @property
    def needs_plugin(self) -> bool:
        """Whether FEBio knows it by the plugin alone."""
        return self in (InterfaceType.MIXTURE, InterfaceType.TIED)

    @property
    def is_contact(self) -> bool:
        """Whether there is an interface at all."""
        return self is not InterfaceType.CONFORMING

    @property
    def module(self) -> str:
        """The FEBio module in which a model with solutes can use it."""
        return "multiphasic" if self is InterfaceType.MULTIPHASIC else "solute"

    @property
    def slug(self) -> str:
        """The name as part of a file name."""
        return self.value.replace("sliding-", "")


@dataclass(frozen=True)
class ContactSettings:
    """Parameters of an interface under FEBio's own names; what is None is not written and keeps its default."""

    laugon: str | None = None  # ``PENALTY``, ``AUGLAG`` or ``LAGMULT``
    # eps_n in MPa/mm, eps_p in mm^3/(N s), eps_c in mm/s; dimensionless factors where `auto_penalty` is set.
    penalty: float | None = None
    pressure_penalty: float | None = None
    concentration_penalty: float | None = None
    auto_penalty: bool | None = None
    update_penalty: bool | None = None
    two_pass: bool | None = None
    integration: str | None = None  # ``gauss`` or ``segments``; `sliding-mixture` alone knows it
    # Augmentation tolerances: of the traction (relative), of the gap (mm), of pressure and concentration.
    tolerance: float | None = None
    gaptol: float | None = None
    ptol: float | None = None
    ctol: float | None = None
    minaug: int | None = None
    maxaug: int | None = None
    search_tol: float | None = None
    search_radius: float | None = None
    extra: tuple[Param, ...] = ()  # anything else

    def params(self) -> tuple[Param, ...]:
        """The parameters that are set, in a fixed order."""
        named = [(name, value) for name, value in vars(self).items() if name != "extra" and value is not None]
        return (*(Param(name, value) for name, value in named), *self.extra)


def automatic(scale: float) -> ContactSettings:
    """FEBio's automatic penalties times one common factor, by the penalty method."""
    return ContactSettings(
        laugon="PENALTY", auto_penalty=True, penalty=scale, pressure_penalty=scale, concentration_penalty=scale
    )


PAPER = ContactSettings(
    laugon="PENALTY", auto_penalty=False, penalty=1400.0, pressure_penalty=1e-3, concentration_penalty=4e-4
)
"""The penalties of section 3.1 of Ateshian, Maas and Weiss (2012)."""


def augmented(settings: ContactSettings, ctol: float) -> ContactSettings:
    """The same penalties with the augmented Lagrangian, until the concentration jump is within `ctol`."""
    return replace(settings, laugon="AUGLAG", ctol=ctol)


def default_settings(interface: InterfaceType) -> ContactSettings:
    """What a user gets without setting a penalty; FEBio's own types need `auto_penalty` and a factor to be accurate."""
    if interface.needs_plugin:
        return ContactSettings()
    settings = automatic(1000.0)
    if interface is InterfaceType.ELASTIC:
        return replace(settings, pressure_penalty=None, concentration_penalty=None)
    return replace(settings, concentration_penalty=None) if interface is InterfaceType.BIPHASIC else settings


def column(
    interface: InterfaceType,
    layers: Sequence[Layer],
    *,
    bottom: float,
    section: Section | None = None,
    gap: float = 0.0,
) -> Mesh:
    """The column of layers, split where `interface` is a contact, conforming where it is not."""
    if interface.is_contact:
        return split_column(layers, bottom=bottom, section=section, gap=gap)
    return conforming_column(layers, bottom=bottom, section=section)


def contacts(interface: InterfaceType, mesh: Mesh, settings: ContactSettings | None) -> tuple[Contact, ...]:
    """One interface for each pair of `mesh`; none where the bodies are one."""
    if not interface.is_contact:
        return ()
    chosen = settings if settings is not None else default_settings(interface)
    return tuple(Contact(interface.value, pair, chosen.params()) for pair in mesh.pairs)


UNITS = """\
The units are mm, N, s, nmol and K. Stress and pressure are therefore in MPa, concentration in mM = nmol/mm^3,
permeability in mm^4/(N s) and diffusivity in mm^2/s. The gas constant is R = 8.314e-6 mJ/(nmol K)."""


def header(name: str, about: str, interface: InterfaceType) -> str:
    """What the model shows, its units, and the command that runs it, with the plugin where the interface needs it."""
    load = " -import build/lib/libFEBioMixtureContact.so" if interface.needs_plugin else ""
    run = f"Commands: scripts/mixcontact run models/{name}.feb\nor        febio4 -i models/{name}.feb{load}"
    return f"{about}\n\n{UNITS}\n\n{run}"
