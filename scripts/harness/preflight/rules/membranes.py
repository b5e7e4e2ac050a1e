"""Rules on membranes: films between the surfaces that resist the solvent and solutes."""

from collections.abc import Iterator

from harness.preflight.finding import Finding, error, warning
from harness.preflight.sides import Joint
from harness.preflight.xml_file import Element, as_number, children, text

CONDUCTANCE, PERMEANCE, REFLECTION = "hydraulic_conductance", "solute_permeance", "reflection"
PENALTIES = {CONDUCTANCE: "pressure_penalty", PERMEANCE: "concentration_penalty"}  # what a membrane takes the place of


def by_solute(joint: Joint, name: str) -> dict[int, Element]:
    """The tags that give each solute a value, by its number; a tag without `sol` is for the only solute."""
    model = joint.model
    only = str(model.solute_numbers[0]) if len(model.solute_numbers) == 1 else ""
    named = ((model.solutes.get(str(tag.get("sol", only))), tag) for tag in children(joint.contact.tag, name))
    return {number: tag for number, tag in named if number is not None}


def half_a_membrane(joint: Joint) -> Iterator[Finding]:
    """A solute that has a permeance without a reflection, or a reflection without a permeance."""
    for one, other in ((PERMEANCE, REFLECTION), (REFLECTION, PERMEANCE)):
        for number in by_solute(joint, one).keys() - by_solute(joint, other).keys():
            seen = f"<{one}> is given for solute {number}, and <{other}> is not; a membrane needs both parameters"
            yield error("membrane", by_solute(joint, one)[number], seen, f'Give <{other} sol="{number}">, too.')


def carried_by_nothing(joint: Joint) -> Iterator[Finding]:
    """Reflections below 1 where the solvent crosses without a membrane."""
    if joint.contact.given(CONDUCTANCE) is not None or joint.contact.lacks("pressure_penalty"):
        return
    for number, tag in by_solute(joint, REFLECTION).items():
        if as_number(text(tag)) < 1.0:
            seen = (
                f"<{REFLECTION}> of solute {number} is below 1, and <{CONDUCTANCE}> is not given: solvent that "
                "carries the solute crosses the membrane too"
            )
            yield error("membrane", tag, seen, f"Give <{CONDUCTANCE}>, or a reflection of 1.")


def penalty_beside_membrane(joint: Joint) -> Iterator[Finding]:
    """Penalties of a flux that a membrane decides."""
    for name, penalty in PENALTIES.items():
        given = joint.contact.given(penalty)
        films = by_solute(joint, name) if name == PERMEANCE else joint.contact.given(name)
        every = name == CONDUCTANCE or (films and len(films) == len(joint.model.solute_numbers))
        if given is not None and films is not None and every:
            seen = f"<{penalty}> has no effect: <{name}> decides the flux"
            yield warning("membrane", given, seen, f"Delete <{penalty}>.")


RULES = (half_a_membrane, carried_by_nothing, penalty_beside_membrane)
