"""The contact as a class of pyfebio, which writes model files: https://pypi.org/project/pyfebio.

>>> from harness.ecosystem.pyfebio_contact import MixtureModel, SlidingMixture
>>> model = MixtureModel()
>>> model.contact_.add_contact(SlidingMixture(surface_pair="joint", fric_coeff=0.02))
"""

from typing import Annotated, Literal, TypeAlias

from pydantic import BeforeValidator
from pydantic_xml import BaseXmlModel, attr, element
from pyfebio import contact
from pyfebio.model import Model


class Varying(BaseXmlModel, validate_assignment=True):
    """A number, which may follow a load curve."""

    text: float
    lc: int | None = attr(default=None)  # number of the load curve that multiplies it


class AmbientConcentration(Varying):
    """Effective concentration of one solute in the fluid around the bodies, mM; `sol` is its number in the model."""

    sol: int = attr()


class OfSolute(Varying):
    """A property of the membrane for one solute; `sol` is its number in the model, none where there is one solute."""

    sol: int | None = attr(default=None)


def _varying(given: object) -> object:
    """A bare number as one that follows no load curve."""
    return Varying(text=float(given)) if isinstance(given, int | float) else given


Switch: TypeAlias = Literal[0, 1] | None
Number: TypeAlias = Annotated[Varying, BeforeValidator(_varying)] | None


class SlidingMixture(BaseXmlModel, validate_assignment=True, extra="forbid"):
    """A contact of type `sliding-mixture`.

    Parameters are those of the page "Parameters", with the same names; what is None is not written, so that the contact
    chooses it. Parameters that are accepted for the sake of old models alone are left out.
    """

    type: Literal["sliding-mixture"] = attr(default="sliding-mixture", frozen=True)
    name: str | None = attr(default=None)
    surface_pair: str = attr()
    effects: str | None = element(default=None)
    laugon: Literal["PENALTY", "AUGLAG", "LAGMULT"] | None = element(default=None)
    penalty: Number = element(default=None)
    pressure_penalty: Number = element(default=None)
    concentration_penalty: Number = element(default=None)
    auto_penalty: Switch = element(default=None)
    update_penalty: Switch = element(default=None)
    tolerance: Number = element(default=None)
    traction_tolerance: Number = element(default=None)
    solvent_tolerance: Number = element(default=None)
    solute_tolerance: Number = element(default=None)
    gaptol: Number = element(default=None)
    ptol: Number = element(default=None)
    ctol: Number = element(default=None)
    minaug: int | None = element(default=None)
    maxaug: int | None = element(default=None)
    free_draining: Switch = element(default=None)
    ambient_pressure: Number = element(default=None)
    ambient_concentration: list[AmbientConcentration] = element(default=[])
    hydraulic_conductance: Number = element(default=None)
    solute_permeance: list[OfSolute] = element(default=[])
    reflection: list[OfSolute] = element(default=[])
    two_pass: Switch = element(default=None)
    integration: Literal["gauss", "segments"] | None = element(default=None)
    integration_order: int | None = element(default=None)
    search_radius: Number = element(default=None)
    offset: Number = element(default=None)
    tension: Switch = element(default=None)
    search_tol: Number = element(default=None)
    seg_up: int | None = element(default=None)
    node_reloc: Switch = element(default=None)
    flip_primary: Switch = element(default=None)
    flip_secondary: Switch = element(default=None)
    shell_bottom_primary: Switch = element(default=None)
    shell_bottom_secondary: Switch = element(default=None)
    symmetric_stiffness: Switch = element(default=None)
    predictor: Switch = element(default=None)
    non_negative_concentrations: Switch = element(default=None)
    line_search_guard: Switch = element(default=None)
    solver_devices: str | None = element(default=None)
    fric_coeff: Number = element(default=None)
    contact_frac: Number = element(default=None)
    tangential_penalty: Number = element(default=None)


class MixtureContact(contact.Contact):
    """The section of contacts, with those of pyfebio and with this one."""

    all_contact_interfaces: list[SlidingMixture | contact.ContactType] = element(default=[], tag="contact")

    def add_contact(self, new_contact: SlidingMixture | contact.ContactType) -> None:
        """Append a contact; one without a name gets one."""
        if new_contact.name is None:
            new_contact.name = f"{new_contact.type}_{len(self.all_contact_interfaces) + 1}"
        self.all_contact_interfaces.append(new_contact)


class MixtureModel(Model):
    """A model of pyfebio whose contacts may be `SlidingMixture`."""

    contact_: MixtureContact = element(default=MixtureContact(), tag="Contact")
