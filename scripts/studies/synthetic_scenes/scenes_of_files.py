"""Scenes of what model files hold beside bodies and loads: solvers, steps, sets, included files, loads, friction."""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from lxml import etree

from studies import feb
from studies.feb import Element, only, put
from studies.models.small import curve, surface_pair
from studies.synthetic_scenes.collection_of_scenes import SCENES as BODIES
from studies.synthetic_scenes.collection_of_scenes import Scene
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


@dataclass(frozen=True)
class Edited:
    """A scene whose file is changed after it is written."""

    about: str  # what it stands for
    scene: Scene
    edit: Edit

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` into `folder`, and return its path."""
        made = feb.read(self.scene.write(name, folder))
        self.edit(made.root, folder)
        return made.write(folder)


def _edited(about: str, scene: str, edit: Callable[..., None], *given: object) -> Edited:
    return Edited(about, BODIES[scene], partial(edit, *given))


_RUBS = {
    "elements-hex8": 0.2,
    "elements-hex20": 0.2,
    "elements-tet4": 0.2,
    "elements-tet10": 0.2,
    "material-Mooney-Rivlin": 0.1,
    "sphere": 0.3,
    "flat": 0.2,
    "sliding": 0.2,
    "sliding-tet10": 0.1,
    "rigid-block-slides": 0.3,
    "rigid-free": 0.2,
    "stiff-on-soft": 0.2,
    "pressure-load": 0.2,
    "augmented": 0.2,
    "dynamic": 0.2,
    "biphasic": 0.2,
    "biphasic-sliding": 0.1,
    "biphasic-tet4": 0.2,
    "multiphasic": 0.2,
}
"""Friction coefficient of each scene."""
SCENES: Mapping[str, Edited] = {
    "quasi-newton": _edited("10 updates of BFGS between matrices", "elements-hex8", updates, "BFGS", 10),
    "quasi-newton-tet4": _edited("10 updates of BFGS, tetrahedra", "elements-tet4", updates, "BFGS", 10),
    "quasi-newton-biphasic": _edited("10 updates of BFGS, biphasic", "biphasic", updates, "BFGS", 10),
    "broyden": _edited("10 updates of Broyden", "elements-hex8", updates, "Broyden", 10),
    "broyden-biphasic": _edited("10 updates of Broyden, biphasic", "biphasic", updates, "Broyden", 10),
    "symmetric": _edited("symmetric matrix", "elements-hex8", solver, {"symmetric_stiffness": "symmetric"}),
    "explicit": _edited("explicit dynamics", "elements-hex8", explicit_dynamics, 500),
    "explicit-finer": _edited("explicit dynamics, twice as fine", "finer", explicit_dynamics, 1000),
    "explicit-tet4": _edited("explicit dynamics, tetrahedra", "elements-tet4", explicit_dynamics, 2000),
    "no-line-search": _edited("without a line search", "elements-hex8", solver, {"lstol": "0"}),
    "begins-with-a-step": _edited("contact from the second analysis step on", "flat", two_steps, (2,)),
    "ends-with-a-step": _edited("contact in the first analysis step alone", "elements-hex8", two_steps, (1,)),
    "two-steps": _edited("contact in both of two analysis steps", "biphasic", two_steps, (1, 2)),
    "mesh-from-a-file": _edited("the mesh in an included file", "elements-hex8", mesh_from_file),
    "part-lists": _edited("conditions on part lists and surfaces", "multiphasic", by_part_lists),
    "pressure-on-the-contact": _edited(
        "pressure prescribed on the slab's contact surface", "biphasic", pressure_on_the_contact
    ),
    "body-force": _edited("bodies under their weight", "elements-hex8", body_force),
    "penalty-with-a-curve": _edited("a penalty that rises", "elements-hex8", penalty_follows_a_curve),
    "both-ways": _edited("two contacts with exchanged surfaces", "elements-hex8", both_ways),
    "must-points": _edited("steps that follow a load curve", "elements-hex8", must_points),
    "search-radius": _edited("a small search radius", "elements-hex8", in_contact, {"search_radius": "0.2"}),
    "segment-updates": _edited("pairs of facets kept after two updates", "sliding", in_contact, {"seg_up": "2"}),
    "node-reloc": _edited(
        "nodes moved onto the other surface at the start",
        "type-sliding-node-on-facet",
        in_contact,
        {"node_reloc": "1"},
    ),
    "update-penalty": _edited(
        "a penalty that follows the deformation", "rigid-free", in_contact, {"update_penalty": "1"}
    ),
}
RUBBING: Mapping[str, Edited] = {
    f"friction-{name}": _edited(f"{BODIES[name].about}, friction {mu:g}", name, in_contact, {"fric_coeff": f"{mu:g}"})
    for name, mu in _RUBS.items()
}
