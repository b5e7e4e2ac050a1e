"""The solvers that FEBio has for elastic bodies, and a scene for them: a block pressed onto another one and moved."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from lxml import etree

from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts
from harness.models.mesh import Box, assemble
from harness.models.parts import Control, Curve, Elastic, Solid, displace, fix
from studies import feb as xml
from studies.feb import Element, Feb

Change = Callable[[Element], object]  # of a control section
PRESSED, MOVED = 0.02, 0.1  # mm
SMALL_STEP, SMALL_STEPS = 1e-4, 60  # s and number of explicit steps; sound needs 0.2 s to cross an element of the scene


def elastic() -> Feb:
    """Two elastic blocks whose facets do not match; the upper one, smaller, is pressed down and then moved along."""
    lower = Box("lower", "elastic", (0.0, 0.0, -0.5), (1.0, 1.0, 0.5), (3, 3, 2))
    upper = Box("upper", "elastic", (0.1, 0.2, 0.0), (0.6, 0.6, 0.5), (2, 2, 2))
    mesh = replace(assemble([lower, upper]), pairs={"blocks": ("lower-top", "upper-bottom")})
    conditions = (
        fix("lower-bottom", "xyz"),
        fix("upper-top", "y"),
        displace("upper-top", "z", -PRESSED, 1),
        displace("upper-top", "x", MOVED, 2),
    )
    model = Model(
        "elastic",
        "Two elastic blocks.",
        "solid",
        mesh,
        {"elastic": Elastic(Solid(1.0, 0.3))},
        conditions,
        Control(12, 1.0, displacement_tolerance=1e-6, energy_tolerance=1e-9),
        contacts(InterfaceType.MIXTURE, mesh, ContactSettings()),
        (Curve(((0.0, 0.0), (4.0, 1.0))), Curve(((4.0, 0.0), (12.0, 1.0)))),
    )
    return xml.made(model)


def _newton(control: Element) -> Element:
    """FEBio's solver `solid`, without a method of its own to form matrices."""
    solver = xml.only(control, "solver")
    if solver.get("type") != "solid":
        control.replace(solver, etree.Element("solver", type="solid"))
        solver = xml.only(control, "solver")
        xml.put(solver, "symmetric_stiffness", "non-symmetric")
    for old in solver.findall("qn_method"):
        solver.remove(old)
    return solver


def _quasi_newton(kind: str) -> Change:
    def change(control: Element) -> None:
        solver = _newton(control)
        xml.put(etree.SubElement(solver, "qn_method", type=kind), "max_ups", 10)

    return change


def _matrix_free(control: Element) -> None:
    solver = _newton(control)
    etree.SubElement(solver, "qn_method", type="JFNK")
    etree.SubElement(solver, "linear_solver", type="fgmres")


def _explicit(control: Element) -> None:
    control.replace(xml.only(control, "solver"), etree.Element("solver", type="explicit-solid"))
    xml.put(control, "analysis", "DYNAMIC")
    xml.put(control, "time_steps", SMALL_STEPS)
    xml.put(control, "step_size", SMALL_STEP)
    for old in control.findall("time_stepper"):
        control.remove(old)


SOLVERS: Mapping[str, Change] = {
    "BFGS": _quasi_newton("BFGS"),
    "Broyden": _quasi_newton("Broyden"),
    "JFNK": _matrix_free,
    "arc length": lambda control: xml.put(_newton(control), "arc_length", 1),
    "CG-solid": lambda control: control.replace(xml.only(control, "solver"), etree.Element("solver", type="CG-solid")),
    "explicit-solid": _explicit,
}
"""Beside Newton's method of the solver `solid`, which a model has as it stands."""
SAME_SOLUTION = frozenset({"BFGS", "Broyden", "JFNK", "CG-solid"})
"""Those that solve the same equations under the same loads; the others follow a path of their own."""


def solved_by(model: Feb, name: str) -> Feb:
    """The same model with another solver."""
    return model.changed("Control", SOLVERS[name])
