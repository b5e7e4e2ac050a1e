"""Rules on transport: convection against the mesh, and time steps against it."""

import math
from collections.abc import Iterator

import numpy as np

from harness.preflight import levels
from harness.preflight.finding import Finding, note, short, warning
from harness.preflight.sides import SOLVENT, Joint, Side
from harness.preflight.xml_file import Element, children, optional_number, text

LARGEST_PECLET = 2.0  # element Peclet number from which linear elements oscillate
SMALLEST_STEP = 1.0 / 6.0
"""d dt/h^2 below which a sudden front undershoots with linear elements and the consistent capacity of FEBio."""


def peclet(joint: Joint) -> Iterator[Finding]:
    """Elements too large for the convection that pressures and fluxes of the model will cause."""
    velocity = _velocity(joint)
    for side in joint.sides:
        for material in side.kinds:
            for number, own in material.solutes.items():
                h = float(np.nanmedian(side.thickness))
                diffusive = own.free_diffusivity * material.porosity
                element = velocity * h / diffusive if diffusive > 0.0 else math.nan
                if element > LARGEST_PECLET:
                    yield warning(
                        "peclet",
                        material.tag,
                        f"convection at about {short(velocity)} through elements {short(h)} thick gives solute "
                        f"{number} in material '{material.name}' an element Peclet number of {short(element)}; "
                        f"above {LARGEST_PECLET:g} concentrations oscillate from node to node",
                        f"Use elements of at most {short(LARGEST_PECLET * h / element)} along the flow.",
                    )


def _velocity(joint: Joint) -> float:
    """Largest solvent flux: prescribed, or driven by prescribed pressures across both bodies by Darcy's law."""
    model = joint.model
    fluxes = [0.0]
    for load in model.loads:
        flux = load.tag.find("flux")
        if load.kind == "fluidflux" and flux is not None:
            fluxes.append(float(np.abs(model.history(flux)[:, 1]).max(initial=0.0)))
    every = levels.fluid_pressures(joint)
    resistance = sum(side.resistance(SOLVENT) for side in joint.sides if side.porous)
    driven = float(np.ptp(every)) / resistance if len(every) and resistance > 0.0 else 0.0
    return max(*fluxes, driven if math.isfinite(driven) else 0.0)


def time_step(joint: Joint) -> Iterator[Finding]:
    """First time step too short for the mesh where a front starts from zero: concentrations undershoot."""
    control = joint.model.controls[0] if joint.model.controls else None
    step = None if control is None else control.find("step_size")
    if control is None or step is None:
        return
    size = optional_number(control, "step_size")
    if not size > 0.0:
        return
    for number in sorted(joint.primary.solutes | joint.secondary.solutes):
        start = levels.start_concentrations(joint, number)
        if not start or min(start) > 0.0 or max(start) <= 0.0:
            continue
        worst = min(((_fourier(side, number, size), side) for side in joint.sides), key=lambda pair: pair[0])
        if worst[0] < SMALLEST_STEP:
            yield _undershoot(joint, control, step, number, worst)


def _fourier(side: Side, solute: int, size: float) -> float:
    """Smallest d dt/h^2 of a solute in the elements of a side; infinite where none is known and positive."""
    known = [m.solutes[solute].diffusivity for m in side.kinds if solute in m.solutes]
    thickness = float(np.nanmedian(side.thickness)) if side.found.any() else math.nan
    values = [d * size / thickness**2 for d in known if math.isfinite(d) and d > 0.0 and thickness > 0.0]
    return min(values, default=math.inf)


def _undershoot(joint: Joint, control: Element, step: Element, solute: int, worst: tuple[float, Side]) -> Finding:
    fourier, side = worst
    size = optional_number(control, "step_size")
    h = float(np.nanmedian(side.thickness))
    seen = (
        f"the first time step {short(size)} is short for elements {short(h)} thick: d dt/h^2 is {short(fourier)} for "
        f"solute {solute}, and a sudden front undershoots zero if this number is below 1/6"
    )
    cure = (
        f"Begin with steps of at least {short(size * SMALLEST_STEP / fourier)}, or use elements of at most "
        f"{short(h * math.sqrt(fourier / SMALLEST_STEP))} at the front, or give the value a load curve over some steps."
    )
    if joint.contact.kind.is_mixture:
        after = ". sliding-mixture solves the clamp of concentrations as an inequality, and Newton's method converges"
        return note("time-step", step, seen + after, cure)
    if not clamps(joint.model.module, control):
        return note("time-step", step, f"{seen}. The clamp is off, and small negative values remain", cure)
    after = ". FEBio sets negative concentrations to zero, and Newton's method often stalls"
    if joint.model.module == "multiphasic":
        cure += " Or set <force_positive_concentrations> to 0 in the solver."
    return warning("time-step", step, seen + after, cure)


def clamps(module: str, control: Element) -> bool:
    """Whether FEBio's solver sets negative concentrations to zero: always in `solute`, by default in `multiphasic`."""
    if module != "multiphasic":
        return True
    found = [tag for solver in children(control, "solver") for tag in children(solver, "force_positive_concentrations")]
    return not found or text(found[0]) not in ("0", "false")


RULES = (peclet, time_step)
