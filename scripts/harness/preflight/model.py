"""A model file as `check` sees it: mesh, materials, contacts, steps, conditions."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from harness.arrays import Array, Ids
from harness.errors import ModelError
from harness.preflight import materials, mesh_section, xml_file
from harness.preflight.contact_types import MIXTURE, TIED_TYPES, TYPES, ContactType
from harness.preflight.formats import read_newest
from harness.preflight.materials import Material
from harness.preflight.mesh_section import Mesh, Pair
from harness.preflight.plugin_types import PLUGIN_TYPES
from harness.preflight.xml_file import (
    AS_THEY_ARE,
    Contents,
    Document,
    Element,
    attribute,
    children,
    number,
    optional_number,
    place,
    shortened,
    text,
    unknown_name,
)

METHODS = next(parameter.choices for parameter in PLUGIN_TYPES[MIXTURE] if parameter.name == "laugon")
"""How conditions are enforced; the last one is not in FEBio's sliding interfaces."""


@dataclass(frozen=True)
class Contact:
    """A sliding contact."""

    kind: ContactType
    pair: Pair
    step: int  # number of its analysis step, from 1; 0 where it is there in all
    tag: Element

    def given(self, name: str) -> Element | None:
        """The tag of a parameter, or None where the model does not set it."""
        return self.tag.find(name)

    def value(self, name: str, default: float) -> float:
        """A number among the parameters."""
        found = self.given(name)
        return default if found is None else number(found)

    def on(self, name: str) -> bool:
        """Whether a switch is on."""
        return xml_file.flag(self.tag, name)

    @property
    def drains(self) -> bool:
        """Whether open nodes have the ambient values."""
        return self.given("free_draining") is None or self.on("free_draining")

    def lacks(self, penalty: str) -> bool:
        """Whether a penalty is 0 at all times."""
        found = self.given(penalty)
        return found is not None and found.get("lc") is None and optional_number(self.tag, penalty) == 0.0

    def asks_for(self, *names: str) -> bool:
        """Whether <effects> names one of these, or leaves the choice to the materials."""
        asked = self.given("effects")
        words = {"all"} if asked is None else {word.strip() for word in text(asked).split(",")}
        return "all" in words or not words.isdisjoint(names)

    @property
    def has_friction(self) -> bool:
        """Whether it resists sliding: a friction coefficient other than zero, a formula too, in a type that uses it."""
        if self.kind.name == "sliding-facet-on-facet":  # FEBio 4.11 sets its coefficient to zero
            return False
        if self.kind.is_mixture and not self.asks_for("friction"):
            return False
        needed = ("fric_coeff", "fric_penalty") if self.kind.name == "sliding-node-on-facet" else ("fric_coeff",)
        return all(self.given(name) is not None and optional_number(self.tag, name) != 0.0 for name in needed)

    @property
    def augmented(self) -> bool:
        """Whether it uses the augmented Lagrangian."""
        return self.method == METHODS.index("AUGLAG")

    @property
    def method(self) -> int | None:
        """Place of <laugon> in `METHODS`; None where it is none of them."""
        found = self.given("laugon")
        return 0 if found is None else xml_file.chosen(text(found), METHODS)

    @property
    def name(self) -> str:
        """Name in the file, else that of its pair."""
        return str(self.tag.get("name") or self.pair.name)


@dataclass(frozen=True)
class Condition:
    """A boundary condition, initial condition or load."""

    kind: str  # FEBio's type
    step: int
    tag: Element


@dataclass(frozen=True)
class Model:
    """Everything that rules may ask of a model."""

    document: Document
    module: str
    mesh: Mesh
    materials: Mapping[str, Material]
    solutes: Mapping[str, int]
    contacts: tuple[Contact, ...]
    ties: tuple[Contact, ...] = ()

    @property
    def path(self) -> Path:
        """The model file."""
        return self.document.path

    @cached_property
    def solute_numbers(self) -> tuple[int, ...]:
        """Numbers of the solutes of the model."""
        return tuple(sorted(set(self.solutes.values())))

    @cached_property
    def block_materials(self) -> tuple[Material | None, ...]:
        """Material of each block of elements; None where <MeshDomains> does not say."""
        named = {}
        for section in self.document.all("MeshDomains"):
            for domain in children(section):
                material = attribute(domain, "mat")
                if material not in self.materials:
                    raise unknown_name(domain, "material", material, self.materials)
                named[str(domain.get("name"))] = self.materials[material]
        return tuple(named.get(block.name) for block in self.mesh.blocks)

    @cached_property
    def gas_constant_and_temperature(self) -> float:
        """R T; NaN where <Globals> does not have both."""
        constants = next(self.document.all("Globals", "Constants"), None)
        if constants is None:
            return math.nan
        return optional_number(constants, "R") * optional_number(constants, "T")

    @cached_property
    def controls(self) -> tuple[Element, ...]:
        """Control sections, in order of the steps."""
        return self.document.each("Control")

    def of_solvers(self, name: str) -> Iterator[Element]:
        """Tags of a name in the solvers of all steps."""
        return (tag for each in self.controls for solver in children(each, "solver") for tag in children(solver, name))

    @cached_property
    def contact_pairs(self) -> tuple[Pair, ...]:
        """Surface pairs of all contacts, tied and other ones too."""
        names = {str(tag.get("surface_pair")) for _, tag in self.document.everywhere("Contact", "contact")}
        return tuple(pair for name, pair in self.mesh.pairs.items() if name in names)

    @cached_property
    def boundary(self) -> tuple[Condition, ...]:
        """Boundary conditions."""
        return self._conditions("Boundary", "bc")

    @cached_property
    def initial(self) -> tuple[Condition, ...]:
        """Initial conditions."""
        return self._conditions("Initial", "ic")

    @cached_property
    def loads(self) -> tuple[Condition, ...]:
        """Loads of all kinds."""
        return self._conditions("Loads", None)

    def _conditions(self, section: str, tag: str | None) -> tuple[Condition, ...]:
        found = self.document.everywhere(section, tag)
        return tuple(Condition(str(each.get("type")), step, each) for step, each in found)

    @cached_property
    def curves(self) -> Mapping[str, Array]:
        """Points (time, value) of the load curves, by their ids; other controllers have no points."""
        found = {}
        for tag in self.document.all("LoadData", "load_controller"):
            points = [xml_file.floats(point, 2) for part in children(tag, "points") for point in children(part)]
            found[attribute(tag, "id")] = np.array(points).reshape(-1, 2)
        return found

    def history(self, tag: Element) -> Array:
        """Points (time, value) of a parameter; one point without a load curve, none where the value is a formula."""
        try:
            value = float(text(tag))
        except ValueError:
            return np.empty((0, 2))
        curve = tag.get("lc")
        if not curve:
            return np.array([[0.0, value]])
        points = self.curves.get(curve)
        if points is None:
            known = ", ".join(self.curves) or "none"
            raise ModelError(f"{place(tag)}: refers to load controller {shortened(curve)}; there is {known}")
        return points * (1.0, value)

    def nodes(self, condition: Condition) -> Ids:
        """Places of the nodes of a condition. Raises ModelError where the set does not exist."""
        name = attribute(condition.tag, "node_set")
        found = self.mesh.node_sets.get(name)
        if found is None:
            known = (there for there in self.mesh.node_sets if there[0] != "@")
            raise unknown_name(condition.tag, "node set", name, known)
        return found


def read(path: Path, instead: Contents = AS_THEY_ARE) -> Model:
    """Read a model file and what it includes; what `instead` has is read in place of files.

    Raises ModelError: names the file, line and tag, and what is allowed.
    """
    if path.suffix != ".feb":
        raise ModelError(f"{path}: a model file ends in .feb")
    document = read_newest(path, instead)
    module = next(document.all("Module"), None)
    if module is None:
        raise ModelError(f'{path}: <febio_spec> has no <Module type="...">, which FEBio needs first')
    numbers = _solutes(document)
    made_mesh = mesh_section.read(document)
    interfaces = list(_interfaces(document, made_mesh))
    made = Model(
        document=document,
        module=attribute(module, "type"),
        mesh=made_mesh,
        materials=materials.read(document, numbers),
        solutes=numbers,
        contacts=tuple(each for each in interfaces if not each.kind.is_tie),
        ties=tuple(each for each in interfaces if each.kind.is_tie),
    )
    if not made.contacts and not made.ties:
        others = sorted({str(tag.get("type")) for _, tag in document.everywhere("Contact", "contact")})
        found = f"it has {', '.join(others)}" if others else "it has no <contact>"
        known = ", ".join((*TYPES, *TIED_TYPES))
        raise ModelError(f"{path}: has no sliding contact and no tie; {found}. Known types: {known}")
    return made


def _solutes(document: Document) -> dict[str, int]:
    """Numbers of the solutes by what a file may call them: number or name."""
    found: dict[str, int] = {}
    for tag in document.all("Globals", "Solutes", "solute"):
        identifier = attribute(tag, "id")
        if not identifier.isdigit():
            raise ModelError(f"{place(tag)}: its id is not a number")
        found[identifier] = int(identifier)
        if tag.get("name"):
            found[str(tag.get("name"))] = int(identifier)
    return found


def _interfaces(document: Document, known: Mesh) -> Iterator[Contact]:
    """Sliding contacts and ties; those of other types are left out."""
    types = {**TYPES, **TIED_TYPES}
    for step, tag in document.everywhere("Contact", "contact"):
        kind = attribute(tag, "type")
        if kind in types:
            yield Contact(types[kind], _pair(tag, known), step, tag)
        elif kind.startswith("sliding"):
            raise ModelError(
                f"{place(tag)}: is of type '{shortened(kind)}', which is unknown; there is {', '.join(TYPES)}"
            )


def _pair(tag: Element, known: Mesh) -> Pair:
    name = attribute(tag, "surface_pair")
    if name not in known.pairs:
        there = ", ".join(map(shortened, known.pairs)) or "none: add a <SurfacePair> to <Mesh>"
        raise ModelError(f"{place(tag)}: has surface_pair='{shortened(name)}', which does not exist; there is {there}")
    return known.pairs[name]
