"""A whole model, its .feb text, and where its node data go."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from textwrap import indent

from lxml import etree

from harness.errors import ModelError
from harness.models import parts
from harness.models.mesh import Mesh

MODULES = ("solid", "biphasic", "solute", "multiphasic")


@dataclass(frozen=True)
class Model:
    """Everything that a .feb file says."""

    name: str  # stem of the file names
    header: str  # what stands at the head of the file: what it shows, units, how to run it
    module: str  # one of `MODULES`
    mesh: Mesh
    materials: Mapping[str, parts.Material]
    conditions: tuple[parts.Condition, ...]
    control: parts.Control
    contacts: tuple[parts.Contact, ...] = ()
    curves: tuple[parts.Curve, ...] = field(default=())  # load curves, numbered from 1
    element_columns: tuple[str, ...] = ()  # FEBio's names of the element data to log, if any
    plot: bool = False  # whether a plot file is written
    # FEBio's names of node data to log beside positions, displacements, pressure and concentrations.
    further_columns: tuple[str, ...] = ()
    charges: tuple[int, ...] = ()  # charge number of each solute of the model; without it all are neutral
    # FEBio's names of ``surface_data`` and ``face_data`` to log for both surfaces of each contact.
    surface_columns: tuple[str, ...] = ()
    facet_columns: tuple[str, ...] = ()
    # FEBio's names of the element data to log of one part alone, by the part's name; FEBio numbers the solutes of
    # element data as the material lists them.
    part_columns: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    gas_constant: float = parts.GAS_CONSTANT  # R in the units of the model
    springs: tuple[parts.Springs, ...] = ()
    node_log: bool = True  # whether the node data are logged, which takes long for large meshes
    further_plot: tuple[str, ...] = ()  # FEBio's names of plot variables beside those that every model has

    @property
    def n_solutes(self) -> int:
        """Number of solutes of the model."""
        return max((s.sol for m in self.materials.values() for s in m.solutes), default=0)

    def mixture(self, name: str) -> parts.Mixture:
        """The porous material of that name. Raises ModelError where the material is elastic or rigid."""
        material = self.materials[name]
        if not isinstance(material, parts.Mixture):
            raise ModelError(f"model '{self.name}': material '{name}' is not porous and holds no solute")
        return material

    @property
    def node_columns(self) -> tuple[str, ...]:
        """Names of the logged node data, in the order of the columns."""
        solutes = (f"c{k + 1}" for k in range(self.n_solutes))
        pressure = () if self.module == "solid" else ("p",)
        return ("x", "y", "z", "ux", "uy", "uz", *pressure, *solutes, *self.further_columns)

    @property
    def node_file(self) -> str:
        """Name of the file into which febio4 writes the node data."""
        return f"{self.name}-nodes.txt"

    @property
    def element_file(self) -> str:
        """Name of the file into which febio4 writes the element data."""
        return f"{self.name}-elements.txt"

    @property
    def contact_surfaces(self) -> tuple[str, ...]:
        """Names of the surfaces of all contacts, each once."""
        return tuple(dict.fromkeys(name for contact in self.contacts for name in self.mesh.pairs[contact.pair]))

    def surface_file(self, surface: str) -> str:
        """Name of the file into which febio4 writes the data of a contact surface as a whole."""
        return f"{self.name}-{surface}.txt"

    def facet_file(self, surface: str) -> str:
        """Name of the file into which febio4 writes the data of the facets of a contact surface."""
        return f"{self.name}-{surface}-facets.txt"

    def part_file(self, part: str) -> str:
        """Name of the file into which febio4 writes the element data of a part."""
        return f"{self.name}-part-{part}.txt"

    def text(self) -> str:
        """The model as FEBio 4 XML.

        Raises ModelError where a module, set, surface or pair is named that does not exist.
        """
        _check(self)
        root = etree.Element("febio_spec", version="4.0")
        parts.child(root, "Module", type=self.module)
        self.control.write(root, self.module, self.plot)
        _globals(self, root)
        materials = parts.child(root, "Material")
        for number, (name, material) in enumerate(self.materials.items(), 1):
            material.write(materials, number, name, self.module)
        _mesh(self.mesh, self.springs, root)
        domains = parts.child(root, "MeshDomains")
        for part in self.mesh.parts:
            parts.child(domains, "SolidDomain", name=part.name, mat=part.material)
        _sections(self, root)
        body = etree.tostring(root, pretty_print=True, encoding="unicode")
        return f'<?xml version="1.0" encoding="ISO-8859-1"?>\n<!--\n{indent(self.header.strip(), "  ")}\n-->\n{body}'

    def write(self, folder: Path) -> Path:
        """Write ``<name>.feb`` into `folder`, which is made where needed, and return its path."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{self.name}.feb"
        path.write_text(self.text(), encoding="iso-8859-1")
        return path


def _globals(model: Model, root: parts.Element) -> None:
    section = parts.child(root, "Globals")
    faraday = parts.FARADAY if any(model.charges) else 0.0
    parts.fill(parts.child(section, "Constants"), R=model.gas_constant, T=parts.TEMPERATURE, Fc=faraday)
    if model.charges and len(model.charges) != model.n_solutes:
        raise ModelError(f"model '{model.name}': {len(model.charges)} charges for {model.n_solutes} solutes")
    if model.n_solutes:
        solutes = parts.child(section, "Solutes")
        for number in range(1, model.n_solutes + 1):
            made = parts.child(solutes, "solute", id=str(number), name=f"s{number}")
            charge = model.charges[number - 1] if model.charges else 0
            parts.fill(made, charge_number=charge, molar_mass=1.0, density=1.0)


def _mesh(mesh: Mesh, springs: Iterable[parts.Springs], root: parts.Element) -> None:
    section = parts.child(root, "Mesh")
    nodes = parts.child(section, "Nodes")
    for number, position in enumerate(mesh.nodes, 1):
        parts.child(nodes, "node", tuple(map(float, position)), id=str(number))
    number = 0
    for part in mesh.parts:
        elements = parts.child(section, "Elements", type=_element_type(part.elements.shape[1]), name=part.name)
        for ids in part.elements:
            number += 1
            parts.child(elements, "elem", tuple(map(int, ids)), id=str(number))
    for name, ids in mesh.node_sets.items():
        parts.child(section, "NodeSet", tuple(map(int, ids)), name=name)
    for name, facets in mesh.surfaces.items():
        surface = parts.child(section, "Surface", name=name)
        for face, ids in enumerate(facets, 1):
            parts.child(
                surface, f"{'tri' if len(ids) in (3, 6) else 'quad'}{len(ids)}", tuple(map(int, ids)), id=str(face)
            )
    for name, (primary, secondary) in mesh.pairs.items():
        parts.fill(parts.child(section, "SurfacePair", name=name), primary=primary, secondary=secondary)
    for group in springs:
        group.write_mesh(section)


def _element_type(nodes: int) -> str:
    shape = {4: "tet", 10: "tet", 6: "penta", 15: "penta"}.get(nodes, "hex")
    return f"{shape}{nodes}"


_CONDITIONS = {"Boundary": ("bc",), "Rigid": ("rigid_bc", "rigid_load"), "Initial": ("ic",), "Loads": ("surface_load",)}
"""Tags of the conditions in each section of a file."""


def _sections(model: Model, root: parts.Element) -> None:
    for title, tags in _CONDITIONS.items():
        chosen = [condition for condition in model.conditions if condition.tag in tags]
        section = parts.child(root, title) if chosen or title == "Boundary" else root
        for condition in chosen:
            condition.write(section)
    section = parts.child(root, "Contact") if model.contacts else root
    for contact in model.contacts:
        contact.write(section)
    section = parts.child(root, "Discrete") if model.springs else root
    for number, group in enumerate(model.springs, 1):
        group.write_material(section, number)
    for number, group in enumerate(model.springs, 1):
        group.write_set(section, number)
    section = parts.child(root, "LoadData") if model.curves else root
    for number, curve in enumerate(model.curves, 1):
        curve.write(section, number)
    _output(model, root)


def _output(model: Model, root: parts.Element) -> None:
    output = parts.child(root, "Output")
    log = parts.child(output, "logfile")
    if model.node_log:
        parts.child(log, "node_data", data=";".join(model.node_columns), file=model.node_file, delim=" ")
    if model.element_columns:
        parts.child(log, "element_data", data=";".join(model.element_columns), file=model.element_file, delim=" ")
    _log_surfaces(model, log)
    _log_parts(model, log)
    if model.plot:
        plot = parts.child(output, "plotfile", type="febio")
        for variable in _plot_variables(model):
            parts.child(plot, "var", type=variable)


def _log_surfaces(model: Model, log: parts.Element) -> None:
    for surface in model.contact_surfaces:
        logged = (
            ("surface_data", model.surface_columns, model.surface_file(surface)),
            ("face_data", model.facet_columns, model.facet_file(surface)),
        )
        for tag, columns, file in logged:
            if columns:
                parts.child(log, tag, surface=surface, data=";".join(columns), file=file, delim=" ")


def _log_parts(model: Model, log: parts.Element) -> None:
    first = 1
    for part in model.mesh.parts:
        columns = model.part_columns.get(part.name)
        if columns:
            ids = tuple(range(first, first + len(part.elements)))
            data, file = ";".join(columns), model.part_file(part.name)
            parts.child(log, "element_data", ids, data=data, file=file, delim=" ")
        first += len(part.elements)


def _plot_variables(model: Model) -> tuple[str, ...]:
    fluid = () if model.module == "solid" else ("effective fluid pressure", "fluid flux")
    solutes = ("effective solute concentration", "solute concentration", "solute flux") if model.n_solutes else ()
    return ("displacement", "stress", *fluid, "contact gap", "contact pressure", *solutes, *model.further_plot)


def _check(model: Model) -> None:
    """Raise ModelError for names that lead nowhere, saying which ones exist."""
    if model.module not in MODULES:
        raise ModelError(f"model '{model.name}': module '{model.module}' is not one of {', '.join(MODULES)}")
    for condition in model.conditions:
        _known(model, condition.kind, condition.where, _places(model, condition))
    for contact in model.contacts:
        _known(model, f"contact {contact.kind}", contact.pair, model.mesh.pairs)
    for part in model.mesh.parts:
        _known(model, f"part {part.name}", part.material, model.materials)
    given = [condition.params for condition in model.conditions] + [contact.params for contact in model.contacts]
    for param in (param for params in given for param in params):
        if param.curve is not None and not 1 <= param.curve <= len(model.curves):
            raise ModelError(
                f"model '{model.name}': <{param.tag}> = {parts.text_of(param.value)} refers to load curve "
                f"{param.curve}, but there are {len(model.curves)}"
            )


def _places(model: Model, condition: parts.Condition) -> Iterable[str]:
    """What a condition of this kind may name."""
    if condition.of_rigid_body:
        return [name for name, material in model.materials.items() if isinstance(material, parts.Rigid)]
    return model.mesh.node_sets if condition.on_nodes else model.mesh.surfaces


def _known(model: Model, who: str, name: str, known: Iterable[str]) -> None:
    names = list(known)
    if name not in names:
        raise ModelError(f"model '{model.name}': {who} refers to '{name}'; there is {', '.join(names) or 'nothing'}")
