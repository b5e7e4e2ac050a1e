"""Rules on the parameters of a contact, and on the solver and module around it."""

import difflib
import math
from collections.abc import Iterator

from harness.preflight.contact_types import MIXTURE, MODULES
from harness.preflight.finding import Finding, error, note, short, warning
from harness.preflight.model import METHODS
from harness.preflight.plugin_types import PLUGIN_TYPES
from harness.preflight.sides import Joint
from harness.preflight.xml_file import WITHOUT_CONTENT, Element, as_number, children, chosen, place, text

NOT_NEGATIVE = "zero or a positive number"
COUNT, SWITCH, NUMBER = "zero or a positive whole number", "0 or 1", "a number"
FRACTION, POSITIVE = "a number from 0 to 1", "a number above 0"
_OF_MIXTURE = PLUGIN_TYPES[MIXTURE]
CHOICES = {parameter.name: parameter.choices for parameter in _OF_MIXTURE if parameter.choices}
OWN_CHOICES = METHODS[-1:]  # last of their list, and not in FEBio's sliding interfaces
_OF_KIND = {"switch": SWITCH, "integer": COUNT, "number": NOT_NEGATIVE, "values per solute": NOT_NEGATIVE}
ALLOWED = {
    **{each.name: _OF_KIND[each.kind] for own in PLUGIN_TYPES.values() for each in own if each.kind in _OF_KIND},
    **dict.fromkeys(("ambient_pressure", "offset"), NUMBER),
    **dict.fromkeys(("contact_frac", "reflection"), FRACTION),
    **dict.fromkeys(("max_traction", "max_shear", "fracture_energy", "fracture_energy_shear"), POSITIVE),
    "tangential_penalty": POSITIVE,
    **dict.fromkeys(("knmult", "extrapolation", "mixing", "viscosity"), ""),
}
"""What each parameter may be, in words; the others, and those without words, may be anything."""
UNLIMITED = ("gaptol", "ptol", "ctol")
"""Tolerances of FEBio's types that hold nothing where they are negative, which is a default of its tied ones."""
LEFT_OUT = {
    "penalty": "the whole contact",
    "pressure_penalty": "the exchange of solvent",
    "concentration_penalty": "the exchange of solutes",
}
"""What goes with a penalty."""
RENAMED = {"extrapolation": "predictor"}
FOLLOWED = tuple(parameter.name for parameter in _OF_MIXTURE if parameter.curve)
"""Parameters whose load curves sliding-mixture follows."""
NEVER_NEGATIVE = {
    "ambient_concentration": "a concentration",
    "fric_coeff": "a friction coefficient",
    "hydraulic_conductance": "a conductance",
    "solute_permeance": "a permeance",
    "reflection": "a reflection coefficient",
}
PER_SOLUTE = tuple(parameter.name for parameter in _OF_MIXTURE if parameter.kind == "values per solute")
"""Parameters that are given once for each solute."""
FEW_REFORMATIONS = 15
SYMMETRIC_SOLVERS = ("skyline", "cg", "hypre_pcg_amg")  # FEBio's linear solvers for symmetric matrices alone
ITERATIVE_SOLVERS = ("fgmres", "bicgstab", "hypre_gmres", "boomeramg")  # those that need a diagonal without zeros


def unknown_parameter(joint: Joint) -> Iterator[Finding]:
    """Parameters that the contact's type does not have."""
    known = joint.contact.kind.parameters - RENAMED.keys()
    for tag in children(joint.contact.tag):
        name = str(tag.tag)
        if name in known:
            continue
        near = [RENAMED[name]] if name in RENAMED else difflib.get_close_matches(name, known, 1)
        seen = f"{joint.contact.kind.name} has no parameter <{name}>; FEBio stops"
        cure = f"Write <{near[0]}>, if that is meant." if near else "Delete it. The documentation lists the parameters."
        yield error("unknown-parameter", tag, seen, cure)


def empty_contact(joint: Joint) -> Iterator[Finding]:
    """Contacts without parameters that FEBio cannot read."""
    tag = joint.contact.tag
    if tag.get(WITHOUT_CONTENT):
        seen = "FEBio cannot read a contact that is written with two tags and has no parameter between them"
        yield error("empty-contact", tag, seen, "Write one tag that ends with />, or give a parameter.")


def bad_value(joint: Joint) -> Iterator[Finding]:
    """Values that are no numbers, or out of range."""
    for tag in children(joint.contact.tag):
        name = str(tag.tag)
        allowed = _allowed(name, joint.contact.kind.is_mixture)
        if allowed and not _fits(tag, name, allowed):
            yield error("bad-value", tag, f"<{name}> is '{text(tag)[:40]}'; it must be {allowed}", f"Give {allowed}.")
        elif allowed == SWITCH and text(tag).lower() == "true":
            yield warning("switch", tag, f"<{name}> is '{text(tag)}', which FEBio reads as 0", "Write 1, or 0.")
    least, most = (joint.contact.given(name) for name in ("minaug", "maxaug"))
    if most is not None and as_number(text(most)) < (0.0 if least is None else as_number(text(least))):
        yield error("bad-value", most, "<maxaug> is less than <minaug>", "Raise <maxaug> or lower <minaug>.")


def _allowed(name: str, strict: bool) -> str:
    """What a parameter may be; empty where anything goes."""
    if name in CHOICES:
        return " or ".join(word for word in CHOICES[name] if strict or word not in OWN_CHOICES)
    if not strict and name in UNLIMITED:
        return NUMBER
    return ALLOWED.get(name, "")


def _fits(tag: Element, name: str, allowed: str) -> bool:
    value = as_number(text(tag))
    if name in CHOICES:
        return chosen(text(tag), allowed.split(" or ")) is not None
    if allowed == SWITCH:
        return value in (0.0, 1.0) or text(tag).lower() in ("true", "false")
    if not math.isfinite(value) or (allowed == COUNT and value != int(value)):
        return False
    return allowed == NUMBER or (value >= 0.0 and _in_bounds(value, allowed))


def _in_bounds(value: float, allowed: str) -> bool:
    """Whether zero or a positive number keeps a further bound, if there is one."""
    return value <= 1.0 if allowed == FRACTION else value > 0.0 if allowed == POSITIVE else True


def left_out(joint: Joint) -> Iterator[Finding]:
    """Effects that a penalty of 0 leaves out."""
    if not joint.contact.kind.is_mixture:
        return
    for name, what in LEFT_OUT.items():
        tag = joint.contact.given(name)
        if tag is not None and joint.contact.lacks(name):
            seen = f"<{name}> is 0, which leaves {what} out"
            yield note("left-out", tag, seen, f"Delete <{name}> for an automatic value.")


def load_curve(joint: Joint) -> Iterator[Finding]:
    """Load controllers that do not exist, or that are not followed."""
    for tag in children(joint.contact.tag):
        found = _without_effect(joint, tag, tag.get("lc") or "")
        if found:
            yield error("load-curve", tag, *found)


def _without_effect(joint: Joint, tag: Element, curve: str) -> tuple[str, str] | None:
    """Why a tag does not follow its load controller, and what to do; None where it does or has none."""
    known, kind = joint.model.curves, joint.contact.kind
    if not curve:
        return None
    if curve not in known:
        there = ", ".join(known) or "none"
        return (
            f"<{tag.tag}> refers to load controller {curve}, which does not exist; there is {there}",
            "Add the controller to <LoadData>, or delete the attribute lc.",
        )
    if kind.name == "sliding-multiphasic" and tag.tag == "ambient_concentration":
        return (
            "sliding-multiphasic takes no load curve on <ambient_concentration>; FEBio stops",
            "Give a value without a load curve, or use sliding-mixture, which accepts the load curve.",
        )
    if kind.is_mixture and tag.tag not in FOLLOWED:
        return (
            f"<{tag.tag}> has a load curve, but cannot change in a run of {kind.name}",
            "Give a value without a load curve. Load curves may change penalties, tolerances, the offset, friction and "
            "ambient values.",
        )
    return None


def module(joint: Joint) -> Iterator[Finding]:
    """Types in a module of FEBio's that does not have them."""
    kind, own = joint.contact.kind, joint.model.module
    tag = next(joint.model.document.all("Module"))
    if own not in MODULES:
        seen = f"'{own}' is not a module of FEBio 4.11: FEBio stops without a plugin that provides it"
        yield warning("module", tag, seen, f"Use one of {', '.join(kind.modules)}.")
    elif "solid" not in MODULES[own]:
        seen = f"module '{own}' has no displacements, and contact has no effect"
        yield error("module", tag, seen, f"Use one of {', '.join(kind.modules)}.")
    elif own not in kind.modules:
        yield error(
            "module",
            joint.contact.tag,
            f"{kind.name} does not exist in FEBio's module '{own}', only in {', '.join(kind.modules)}",
            "Use another <Module type=...>, or another contact type: sliding-mixture works in all modules "
            "with displacements.",
        )


def material(joint: Joint) -> Iterator[Finding]:
    """Parts at the contact whose material is not told."""
    for side in joint.sides:
        lost = [k for k, m in enumerate(side.materials) if m is None and side.found[k]]
        if lost:
            seen = f"the elements behind surface '{side.surface.name}' have no material"
            yield error("no-material", side.surface.tag, seen, "Name their part and material in <MeshDomains>.")


def not_exchanged(joint: Joint) -> Iterator[Finding]:
    """Fluid or solutes on both sides that the type does not exchange."""
    kind = joint.contact.kind
    if not kind.solvent and all(side.porous for side in joint.sides):
        what = "fluid and solutes" if joint.primary.solutes & joint.secondary.solutes else "fluid"
        seen = f"both bodies hold {what}, and {kind.name} transmits traction alone: the surfaces are impermeable"
        yield note("impermeable", joint.contact.tag, seen, "Use sliding-mixture if the bodies shall exchange it.")
    elif kind.solvent and not kind.solutes and joint.primary.solutes & joint.secondary.solutes:
        yield note(
            "impermeable",
            joint.contact.tag,
            f"both bodies hold solutes, and {kind.name} exchanges fluid alone: the surfaces are impermeable to solutes",
            "Use sliding-mixture if the bodies shall exchange them.",
        )


def ambient_solute(joint: Joint) -> Iterator[Finding]:
    """Values per solute that do not say which solute they are for."""
    model = joint.model
    for tag in (tag for name in PER_SOLUTE for tag in children(joint.contact.tag, name)):
        named = tag.get("sol")
        there = ", ".join(map(str, model.solute_numbers)) or "none"
        if named is not None and named not in model.solutes:
            seen = f"<{tag.tag}> is for solute {named}, which the model does not have; there is {there}"
            yield error("ambient-solute", tag, seen, "Correct the attribute sol.")
        elif named is None and joint.contact.kind.is_mixture and len(model.solute_numbers) != 1:
            seen = f"<{tag.tag}> does not name its solute; there is {there}"
            yield error("ambient-solute", tag, seen, f'Write one <{tag.tag} sol="..."> for each solute.')


def negative_in_time(joint: Joint) -> Iterator[Finding]:
    """Values that are never negative and that a load curve takes below zero."""
    for tag in (tag for name in NEVER_NEGATIVE for tag in children(joint.contact.tag, name)):
        if tag.get("lc") in joint.model.curves and as_number(text(tag)) >= 0.0:
            least = float(joint.model.history(tag)[:, 1].min(initial=0.0))
            if least < 0.0:
                seen = (
                    f"<{tag.tag}> times its load curve falls to {short(least)}; {NEVER_NEGATIVE[str(tag.tag)]} is "
                    "never negative"
                )
                yield error("bad-value", tag, seen, "Correct the load curve.")


def given_twice(joint: Joint) -> Iterator[Finding]:
    """A parameter, or the value of a solute, that is there twice."""
    first: dict[tuple[str, str], Element] = {}
    for tag in children(joint.contact.tag):
        key = (str(tag.tag), _solute_meant(joint, tag))
        if key in first:
            seen = f"<{tag.tag}>{key[1]} is given twice, first in line {place(first[key]).line}; one has no effect"
            yield error("given-twice", tag, seen, "Delete one of them.")
        first.setdefault(key, tag)


def _solute_meant(joint: Joint, tag: Element) -> str:
    """The solute that a value is of; without `sol` the only one."""
    if tag.tag not in PER_SOLUTE:
        return ""
    known = joint.model.solutes
    only = joint.model.solute_numbers[0] if len(joint.model.solute_numbers) == 1 else 0
    return f" of solute {known.get(str(tag.get('sol')), tag.get('sol', only))}"


def no_duration(joint: Joint) -> Iterator[Finding]:
    """Analysis steps that end as they begin."""
    for control in joint.model.controls:
        found = control.find("step_size")
        if found is not None and not as_number(text(found)) > 0.0:
            seen = f"<step_size> is '{text(found)[:40]}': the analysis step has no duration without a positive number"
            yield error("time-step", found, seen, "Give a positive number.")


def symmetric_tangent(joint: Joint) -> Iterator[Finding]:
    """A tangent that is made symmetric."""
    tag = joint.contact.given("symmetric_stiffness")
    if tag is not None and joint.contact.kind.is_mixture and joint.contact.on("symmetric_stiffness"):
        yield warning(
            "symmetric-tangent",
            tag,
            "the tangent of this contact is not symmetric. Newton's method takes many more iterations with its "
            "symmetric part, and may not converge on steep surfaces or with large penalties",
            "Delete <symmetric_stiffness>. The contact then makes the solver's matrix non-symmetric.",
        )


def symmetric_friction(joint: Joint) -> Iterator[Finding]:
    """Friction of FEBio's types with their symmetric tangent, which is their default; see also `symmetric_tangent`."""
    contact = joint.contact
    tag, rubbing = contact.given("symmetric_stiffness"), contact.given("fric_coeff")
    symmetric = (
        contact.on("symmetric_stiffness") if tag is not None else "symmetric_stiffness" in contact.kind.parameters
    )
    if rubbing is not None and contact.has_friction and symmetric and not contact.kind.is_mixture:
        yield warning(
            "symmetric-friction",
            rubbing if tag is None else tag,
            "friction makes the tangent non-symmetric. Newton's method takes many more iterations with the symmetric "
            "part, the default of this type, or fails",
            "Write <symmetric_stiffness>0</symmetric_stiffness> in the contact, and 'non-symmetric' in the solver.",
        )


def without_friction(joint: Joint) -> Iterator[Finding]:
    """Parameters of friction where there is none."""
    for name in ("contact_frac", "smooth_fls", "fric_penalty", "tangential_penalty"):
        tag = joint.contact.given(name)
        if tag is not None and name in joint.contact.kind.parameters and not joint.contact.has_friction:
            seen = f"<{name}> has no effect: this contact has no friction"
            yield note("no-friction", tag, seen, "Give <fric_coeff>, or delete it.")


def linear_solver(joint: Joint) -> Iterator[Finding]:
    """Linear solvers that cannot solve the matrix of a contact."""
    if not joint.contact.kind.is_mixture:
        return
    has_multipliers = joint.contact.method == METHODS.index("LAGMULT")
    for tag in joint.model.of_solvers("linear_solver"):
        kind = str(tag.get("type"))
        if kind in SYMMETRIC_SOLVERS and not joint.contact.on("symmetric_stiffness"):
            why = "solves symmetric matrices only, and the matrix of this contact is not symmetric"
        elif kind in (*SYMMETRIC_SOLVERS, *ITERATIVE_SOLVERS) and has_multipliers:
            why = "may find no solution: <laugon>LAGMULT</laugon> puts zeros on the diagonal of the matrix"
        else:
            continue
        yield warning("linear-solver", tag, f"the linear solver '{kind}' {why}", "Use pardiso, mkl_dss or superlu_mt.")


def reformations(joint: Joint) -> Iterator[Finding]:
    """Few reformations for a contact that moves."""
    for control in joint.model.controls:
        for solver in children(control, "solver"):
            found = solver.find("max_refs")
            if found is not None and 0.0 < as_number(text(found)) < FEW_REFORMATIONS:
                seen = f"<max_refs> is {text(found)}: a moving edge of contact may need more"
                yield note("max-refs", found, seen, "Set it to 25.")


RULES = (
    empty_contact,
    unknown_parameter,
    bad_value,
    left_out,
    load_curve,
    module,
    material,
    not_exchanged,
    ambient_solute,
    negative_in_time,
    given_twice,
    no_duration,
    symmetric_tangent,
    symmetric_friction,
    without_friction,
    linear_solver,
    reformations,
)
