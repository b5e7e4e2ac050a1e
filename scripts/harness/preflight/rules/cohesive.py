"""Rules on ties that soften as they open: the penalty of their bonds, and the zone in which these soften."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from harness.preflight.contact_types import TIED
from harness.preflight.finding import Finding, error, short, warning
from harness.preflight.penalty import harmonic_mean, in_series, largest
from harness.preflight.sides import TRACTION, Joint, Side

FACTOR = 50.0  # `default_cohesive_factor` of plugin/contact/tie/tie.h
LEAST_FACETS = 3.0  # `facets_in_cohesive_zone` of plugin/host/cohesive_zone.h


@dataclass(frozen=True)
class Bond:
    """The law of a bond in one mode."""

    strength: float  # MPa
    energy: float  # N/mm


def bonds(joint: Joint) -> tuple[Bond, ...]:
    """Those of a tie in tension and in shear; none if it does not soften."""
    contact = joint.contact
    if contact.kind.name != TIED or contact.given("fracture_energy") is None or contact.given("max_traction") is None:
        return ()
    strength, energy = contact.value("max_traction", math.nan), contact.value("fracture_energy", math.nan)
    shear = Bond(contact.value("max_shear", strength), contact.value("fracture_energy_shear", energy))
    return tuple(bond for bond in (Bond(strength, energy), shear) if bond.strength > 0.0 and bond.energy > 0.0)


def _penalty(joint: Joint) -> float:
    """The smallest penalty of a bond, MPa/mm; NaN where no modulus is a number."""
    contact = joint.contact
    given = contact.given("penalty")
    factor = FACTOR if given is None else largest(joint, given)
    if given is not None and not contact.on("auto_penalty"):
        return factor
    softest = float(joint.primary.conductances(TRACTION).min(initial=math.inf))
    return factor * in_series(softest, harmonic_mean(joint.secondary.conductances(TRACTION)))


def soft_bonds(joint: Joint) -> Iterator[Finding]:
    """A penalty with which bonds would break before they soften."""
    needed = max((bond.strength**2 / (2.0 * bond.energy) for bond in bonds(joint)), default=math.nan)
    own = _penalty(joint)
    if own <= needed:
        tag = joint.contact.given("penalty")
        seen = f"bonds have a penalty of {short(own)}, and soften only above {short(needed)}, strength^2/(2 energy)"
        cure = f"Set <penalty> to {short(20.0 * needed)} and <auto_penalty> to 0, or a smaller <max_traction>."
        yield error("soft-bonds", joint.contact.tag if tag is None else tag, seen, cure)


def _zone(side: Side, softness: float) -> float:
    """The length over which bonds of a side soften, mm; infinite where it is rigid.

    E G/sigma^2 of a thick body, (E h^3 G/(6 sigma^2))^(1/4) of a layer of thickness h, whichever is shorter.
    """
    resistance = side.resistance(TRACTION)
    if not resistance > 0.0:
        return math.inf
    modulus = side.depth / resistance
    return float(min(modulus * softness, (modulus * side.depth**3 * softness / 6.0) ** 0.25))


def short_zone(joint: Joint) -> Iterator[Finding]:
    """Facets that are too long for the zone in which bonds soften."""
    softness = min((bond.energy / bond.strength**2 for bond in bonds(joint)), default=math.inf)
    corners = joint.primary.corners
    longest = float(np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).max())
    zone = min(_zone(side, softness) for side in joint.sides)
    if zone < LEAST_FACETS * longest:
        weaker = joint.contact.value("max_traction", math.nan) * (zone / (LEAST_FACETS * longest)) ** 2
        yield warning(
            "cohesive-zone",
            joint.contact.tag,
            f"bonds soften over a length of about {short(zone)}, and facets are up to {short(longest)} long: cracks "
            "jump from node to node, loads are too high, and steps fail",
            f"Refine the surface to facets of {short(zone / LEAST_FACETS)}, or set <max_traction> to {short(weaker)}.",
        )


RULES = (soft_bonds, short_zone)
