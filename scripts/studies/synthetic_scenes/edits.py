"""What a model file says that the builders have no words for: a change of its XML, one function each.

The last two arguments are those of an `Edit`; what comes before them is bound first.
"""

from collections.abc import Callable, Mapping
from copy import deepcopy
from pathlib import Path

from lxml import etree

from studies.feb import Element, only, put
from studies.models.small import curve, surface_pair
from studies.synthetic_scenes.slab_and_block import BASE, BLOCK, LOADED, LOWER, SLAB, UPPER

Edit = Callable[[Element, Path], None]
"""Changes the root of a model in place; the folder is the one that the model is written into."""


def _xml(text: str) -> Element:
    return etree.fromstring(text)


def solver(values: Mapping[str, str], root: Element, _: Path) -> None:
    """Sets parameters of the solver, such as `lstol`."""
    for tag, value in values.items():
        put(only(root, "Control/solver"), tag, value)


def explicit_dynamics(steps: int, root: Element, _: Path) -> None:
    """FEBio's explicit solver, with this many equal steps over the same time, and some damping."""
    only(root, "Module").set("type", "explicit-solid")
    control = only(root, "Control")
    number, size = only(control, "time_steps"), only(control, "step_size")
    size.text = f"{int(number.text or '') * float(size.text or '') / steps:g}"
    number.text = str(steps)
    only(control, "analysis").text = "DYNAMIC"
    control.remove(only(control, "time_stepper"))
    lumped = '<solver type="explicit-solid"><mass_lumping>2</mass_lumping><dyn_damping>0.99</dyn_damping></solver>'
    control.replace(only(control, "solver"), _xml(lumped))


def updates(method: str, number: int, root: Element, _: Path) -> None:
    """A quasi-Newton method with this many updates between two matrices."""
    found = only(root, "Control/solver/qn_method")
    found.set("type", method)
    only(found, "max_ups").text = str(number)


def in_contact(values: Mapping[str, str], root: Element, _: Path) -> None:
    """Sets parameters of the contact."""
    for contact in root.iterfind("Contact/contact"):
        for tag, value in values.items():
            etree.SubElement(contact, tag).text = value


def two_steps(active: tuple[int, ...], root: Element, _: Path) -> None:
    """Two steps of half the time steps each, with the contact in the steps `active` alone."""
    control, contact = only(root, "Control"), only(root, "Contact")
    half = only(control, "time_steps")
    half.text = str(int(half.text or "") // 2)
    section = etree.Element("Step")
    for number in (1, 2):
        step = etree.SubElement(section, "step", id=str(number), name=f"step{number}")
        step.append(deepcopy(control))
        if number in active:
            step.append(deepcopy(contact))
    root.remove(control)
    only(root, "LoadData").addprevious(section)
    root.remove(contact)


def mesh_from_file(root: Element, folder: Path) -> None:
    """Keeps the mesh in a file of its own, which the model includes."""
    mesh = only(root, "Mesh")
    inner = etree.Element("febio_spec", version="4.0")
    mesh.addprevious(etree.Element("Mesh", {"from": "mesh.feb"}))
    inner.append(mesh)
    etree.ElementTree(inner).write(str(folder / "mesh.feb"), xml_declaration=True, encoding="ISO-8859-1")


def by_part_lists(root: Element, _: Path) -> None:
    """Gives conditions their nodes by part list and surface instead of by node set."""
    mesh = only(root, "Mesh")
    for name in (SLAB, BLOCK):
        etree.SubElement(mesh, "PartList", name=f"parts-of-{name}").text = name
    names = {SLAB: f"@part_list:parts-of-{SLAB}", BLOCK: f"@part_list:parts-of-{BLOCK}"}
    names |= {BASE: f"@surface:{BASE}", LOADED: f"@surface:{LOADED}"}
    for condition in root.iter("bc", "ic"):
        condition.set("node_set", names.get(condition.get("node_set") or "", condition.get("node_set") or ""))


def pressure_on_the_contact(root: Element, _: Path) -> None:
    """Prescribes the fluid pressure on the surface of the slab, also where the block touches it."""
    only(root, "Boundary").append(_xml(f'<bc type="zero fluid pressure" node_set="{UPPER}"/>'))


def body_force(root: Element, _: Path) -> None:
    """A weight on both bodies."""
    load = _xml('<body_load type="body force"><force>0,0,-2</force></body_load>')
    section = root.find("Loads")
    if section is None:
        section = etree.Element("Loads")
        only(root, "Contact").addprevious(section)
    section.append(load)


def penalty_follows_a_curve(root: Element, _: Path) -> None:
    """Lets the penalty rise with the load curve of the displacement."""
    only(root, "Contact/contact/penalty").set("lc", "1")


def both_ways(root: Element, _: Path) -> None:
    """A second contact between the same surfaces, the other way round, in place of two passes."""
    section = only(root, "Contact")
    only(root, "Mesh").append(_xml(surface_pair("back", UPPER, LOWER)))
    second = deepcopy(only(section, "contact"))
    second.set("name", "back")
    second.set("surface_pair", "back")
    section.append(second)


def must_points(root: Element, _: Path) -> None:
    """The largest step follows a curve whose points have to be met."""
    stepper = only(root, "Control/time_stepper/dtmax")
    stepper.set("lc", "3")
    stepper.text = "1"
    only(root, "LoadData").append(_xml(curve(3, (0, 0.05), (0.5, 0.2), (1, 0.2), interpolate="STEP")))
