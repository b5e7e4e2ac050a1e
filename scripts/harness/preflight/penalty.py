"""The penalty that a contact will have for a field, and what it lets through."""

import math
from dataclasses import dataclass

from harness.arrays import Array
from harness.closed_forms.penalty_leak import relative_jump
from harness.preflight.sides import TRACTION, Field, Joint
from harness.preflight.xml_file import Element

TRACTION_FACTOR, FLUX_FACTOR = 1e3, 1e5
"""`default_traction_factor` and `default_flux_factor` of plugin/contact/base/settings.h."""


@dataclass(frozen=True)
class Penalty:
    """A penalty in effect; NaN where a property of a material is no number."""

    value: float  # eps, in the unit of the field: MPa/mm, mm^3/(N s) or mm/s
    local: float  # stiffness or conductance of the adjoining elements that it is measured against, same unit
    # Whether the model has it, and whether that is a factor on `local`.
    given: bool
    factor: bool
    tag: Element  # where to change it


def penalty(joint: Joint, field: Field) -> Penalty:
    """The penalty of a field, by the rules of the contact's type.

    This plugin: value; times the local conductance with `auto_penalty`; automatic where not given. FEBio's: the same,
    but 1 where not given, and the conductance is that of the primary side alone.
    """
    contact = joint.contact
    tag = contact.given(field.penalty)
    mixture = contact.kind.is_mixture
    own = joint.primary.conductances(field)
    primary = float(own.mean()) if len(own) else math.nan
    local = in_series(primary, harmonic_mean(joint.secondary.conductances(field))) if mixture else primary
    default = (TRACTION_FACTOR if field == TRACTION else FLUX_FACTOR) if mixture else 1.0
    factor = default if tag is None else largest(joint, tag)
    automatic = contact.on("auto_penalty") or (mixture and tag is None)
    return Penalty(
        factor * local if automatic else factor, local, tag is not None, automatic, contact.tag if tag is None else tag
    )


def largest(joint: Joint, tag: Element) -> float:
    """A parameter where its load curve is highest."""
    return float(joint.model.history(tag)[:, 1].max(initial=-math.inf))


def in_series(one: float, two: float) -> float:
    """2 k1 k2/(k1 + k2) of two sides, as in plugin/contact/conditions/penalty.cpp."""
    if math.isinf(one) or math.isinf(two):
        return 2.0 * min(one, two)
    return 2.0 * one * two / (one + two) if one + two > 0.0 else math.nan


def leak(joint: Joint, field: Field, value: float) -> float:
    """Part of a difference across both bodies that stands as a jump over the contact: (1/eps)/(sum L/G + 1/eps).

    NaN where a property is no number or both bodies are rigid.
    """
    resistance = joint.primary.resistance(field) + joint.secondary.resistance(field)
    if not (resistance > 0.0 and value >= 0.0 and math.isfinite(resistance)):
        return math.nan
    return 1.0 if value == 0.0 else relative_jump((resistance,), value)


def harmonic_mean(values: Array) -> float:
    """Of the positive values; infinite ones are no resistance. NaN without any."""
    positive = values[values > 0.0]
    if not len(positive):
        return math.nan
    resistance = float((1.0 / positive).mean())
    return 1.0 / resistance if resistance > 0.0 else math.inf
