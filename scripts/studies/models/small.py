"""Models of a few boxes and plates, written part by part: several steps, any module, shells, surfaces of one's own.

What the builders of the harness have no words for. Numbers are in mm, N, s.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

import numpy as np

from harness.models import blocks
from harness.models.blocks import FACES, Body
from harness.models.parts import FARADAY
from studies.models import assembly

SIDES = ("bottom", "top", "front", "right", "back", "left")
"""Names of a box's sides, in the order of `FACES`: -z, +z, -y, +x, +y, -x."""


def listed(numbers: Iterable[float]) -> str:
    """Numbers with commas between them, in 12 digits."""
    return ",".join(f"{number:.12g}" for number in numbers)


def mesh_lines(
    nodes: Iterable[Iterable[float]], groups: Iterable[tuple[str, str, Iterable[Iterable[int]]]]
) -> list[str]:
    """The first lines of <Mesh>: nodes, and elements by their type, name and node numbers; both are counted from 1."""
    lines = ['<Mesh><Nodes name="all">']
    lines += [f'<node id="{n}">{listed(point)}</node>' for n, point in enumerate(nodes, 1)]
    lines.append("</Nodes>")
    number = count(1)
    for kind, name, elements in groups:
        rows = (f'<elem id="{next(number)}">{listed(ids)}</elem>' for ids in elements)
        lines += [f'<Elements type="{kind}" name="{name}">', *rows, "</Elements>"]
    return lines


def node_set(name: str, nodes: Iterable[int]) -> str:
    """A node set."""
    return f'<NodeSet name="{name}">{listed(nodes)}</NodeSet>'


def surface_pair(name: str, primary: str, secondary: str) -> str:
    """A pair of surfaces."""
    return f'<SurfacePair name="{name}"><primary>{primary}</primary><secondary>{secondary}</secondary></SurfacePair>'


def domain(name: str, material: str, thickness: float = 0.0) -> str:
    """The domain of a group of elements, of shells with their thickness (mm)."""
    if thickness:
        inner = f"<shell_thickness>{thickness:g}</shell_thickness>"
        return f'<ShellDomain name="{name}" mat="{material}">{inner}</ShellDomain>'
    return f'<SolidDomain name="{name}" mat="{material}"/>'


@dataclass
class Part:
    """Elements of one type and material, numbers of nodes from 1."""

    name: str
    material: str
    element: str
    elements: list[tuple[int, ...]]
    thickness: float = 0.0  # of shells; 0 for solids


@dataclass
class Parts:
    """Nodes, parts, surfaces and node sets that are added one after the other."""

    nodes: list[tuple[float, float, float]] = field(default_factory=list)
    parts: list[Part] = field(default_factory=list)
    surfaces: dict[str, list[tuple[int, ...]]] = field(default_factory=dict)
    node_sets: dict[str, list[int]] = field(default_factory=dict)

    def box(self, name: str, low: Sequence[float], high: Sequence[float], cells: Sequence[int], material: str) -> None:
        """A box of hex8; its sides are the surfaces and node sets `name`-bottom, ..."""
        body = assembly.box(low, high, cells)
        elements = body.elements + len(self.nodes) + 1
        number = len(self.nodes) + 1 + np.arange(len(body.nodes)).reshape([n + 1 for n in cells])
        self.nodes += [tuple(point) for point in body.nodes]
        self.parts.append(Part(name, material, "hex8", [tuple(map(int, ids)) for ids in elements]))
        ends = (number[:, :, 0], number[:, :, -1], number[:, 0], number[-1], number[:, -1], number[0])
        for side, face, on_side in zip(SIDES, FACES, ends, strict=True):
            here = set(map(int, on_side.ravel()))
            facets = [tuple(int(ids[a]) for a in face) for ids in elements]
            self.surfaces[f"{name}-{side}"] = [facet for facet in facets if here.issuperset(facet)]
            self.node_sets[f"{name}-{side}"] = sorted(here)

    def plate(self, name: str, material: str, level: float, thickness: float, *, faces_up: bool = True) -> None:
        """A plate of nine quad4 shells over the unit square at z = `level`; surface and node set `name`."""
        line = np.linspace(0.0, 1.0, 4)
        number = len(self.nodes) + 1 + np.arange(line.size**2).reshape(line.size, line.size)
        self.nodes += [(x, y, level) for x in line for y in line]
        a, b = slice(None, -1), slice(1, None)
        order = ((a, a), (b, a), (b, b), (a, b)) if faces_up else ((a, a), (a, b), (b, b), (b, a))
        shells = [tuple(map(int, ids)) for ids in np.stack([number[i, j].ravel() for i, j in order], axis=1)]
        self.parts.append(Part(name, material, "quad4", shells, thickness))
        self.surfaces[name] = shells
        self.node_sets[name] = sorted(map(int, number.ravel()))

    def cut_out(self, name: str, low: Sequence[float], high: Sequence[float]) -> None:
        """Takes elements of a part whose middles lie within a box away, and their nodes if nothing else has them."""
        part = next(part for part in self.parts if part.name == name)
        middles = [np.mean([self.nodes[n - 1] for n in ids], axis=0) for ids in part.elements]
        inside = [bool(np.all(m > low) and np.all(m < high)) for m in middles]
        part.elements = [ids for ids, cut in zip(part.elements, inside, strict=True) if not cut]
        used = sorted({n for other in self.parts for ids in other.elements for n in ids})
        number = {old: new for new, old in enumerate(used, 1)}
        self.nodes = [self.nodes[n - 1] for n in used]
        for other in self.parts:
            other.elements = [tuple(number[n] for n in ids) for ids in other.elements]
        self.node_sets = {key: [number[n] for n in ids if n in number] for key, ids in self.node_sets.items()}
        self.surfaces = {
            key: [tuple(number[n] for n in facet) for facet in facets if all(n in number for n in facet)]
            for key, facets in self.surfaces.items()
        }

    def outside(self, name: str) -> list[tuple[int, ...]]:
        """The faces of a part of hex8 that one element alone has."""
        part = next(part for part in self.parts if part.name == name)
        outer = blocks.boundary(Body(np.array(self.nodes), np.array(part.elements)))
        return [tuple(map(int, facet)) for facet in outer]

    def facets_in(self, facets: Sequence[tuple[int, ...]], axis: int, value: float) -> list[tuple[int, ...]]:
        """Those in a plane."""
        return [f for f in facets if all(abs(self.nodes[n - 1][axis] - value) < 1e-9 for n in f)]

    def mesh(self, pairs: dict[str, tuple[str, str]]) -> str:
        """<Mesh> and <MeshDomains>, with these pairs of surfaces."""
        lines = mesh_lines(self.nodes, [(part.element, part.name, part.elements) for part in self.parts])
        lines += [node_set(name, members) for name, members in self.node_sets.items()]
        for name, facets in self.surfaces.items():
            inner = "".join(f'<quad4 id="{n}">{listed(facet)}</quad4>' for n, facet in enumerate(facets, 1))
            lines.append(f'<Surface name="{name}">{inner}</Surface>')
        lines += [surface_pair(name, *sides) for name, sides in pairs.items()]
        domains = [domain(part.name, part.material, part.thickness) for part in self.parts]
        return "\n".join([*lines, "</Mesh><MeshDomains>", *domains, "</MeshDomains>"])


def slotted_block(material: str) -> Parts:
    """A block, 3 x 1 x 2.2, with a slot at 1 < z < 1.2 that is open at x = 3.

    Surfaces are all of its outside, the two sides of the slot, and both of them; node sets its bottom and the tip of
    the arm above the slot.
    """
    parts = Parts()
    parts.box("block", (0, 0, 0), (3, 1, 2.2), (6, 2, 11), material)
    parts.cut_out("block", (1, -1, 1), (9, 9, 1.2))
    outer = parts.outside("block")
    lower, upper = parts.facets_in(outer, 2, 1.0), parts.facets_in(outer, 2, 1.2)
    parts.surfaces = {"outer": outer, "lower": lower, "upper": upper, "slot": lower + upper}
    place = dict(enumerate(parts.nodes, 1))
    parts.node_sets = {
        "bottom": [n for n, x in place.items() if x[2] < 1e-9],
        "tip": [n for n, x in place.items() if x[2] > 2.2 - 1e-9 and x[0] > 2.9],
    }
    return parts


def elastic(name: str, number: int, modulus: float = 1.0, ratio: float = 0.0) -> str:
    """A neo-Hookean material."""
    inner = f"<density>1</density><E>{modulus}</E><v>{ratio}</v>"
    return f'<material id="{number}" name="{name}" type="neo-Hookean">{inner}</material>'


def rigid(name: str, number: int, extra: str = "") -> str:
    """A rigid body with its centre of mass at the origin."""
    inner = f"<density>1</density><center_of_mass>0,0,0</center_of_mass>{extra}"
    return f'<material id="{number}" name="{name}" type="rigid body">{inner}</material>'


def biphasic(name: str, number: int, modulus: float = 1.0) -> str:
    """A biphasic material with a neo-Hookean solid."""
    solid = f'<solid type="neo-Hookean"><density>1</density><E>{modulus}</E><v>0</v></solid>'
    flow = '<permeability type="perm-const-iso"><perm>0.001</perm></permeability>'
    inner = f"<phi0>0.2</phi0><fluid_density>1e-9</fluid_density>{solid}{flow}"
    return f'<material id="{number}" name="{name}" type="biphasic">{inner}</material>'


def fixed(nodes: str, *dofs: str) -> str:
    """Displacements that are zero, of x, y, z; all three where none is named."""
    inner = "".join(f"<{dof}_dof>1</{dof}_dof>" for dof in dofs or "xyz")
    return f'<bc type="zero displacement" node_set="{nodes}">{inner}</bc>'


def moved(nodes: str, dof: str, value: float, curve: int = 1) -> str:
    """A displacement that follows a load curve."""
    inner = f'<dof>{dof}</dof><value lc="{curve}">{value}</value><relative>0</relative>'
    return f'<bc type="prescribed displacement" node_set="{nodes}">{inner}</bc>'


def contact(name: str, pair: str, kind: str = "sliding-mixture", params: str = "") -> str:
    """A contact of a pair of surfaces."""
    inner = f">{params}</contact>" if params else "/>"
    return f'<contact name="{name}" type="{kind}" surface_pair="{pair}"{inner}'


@dataclass(frozen=True)
class Scheme:
    """Steps and solver, as users give them."""

    # Number of steps and the size of one, s.
    steps: int = 10
    size: float = 0.1
    analysis: str = ""
    retries: int = 5  # how often a failed step is tried again; 0 for steps of fixed size
    method: str = "BFGS"
    updates: int = 0  # of quasi-Newton updates between two matrices; FEBio's default is 10 of BFGS
    symmetric: bool | None = False
    """FEBio's default in the module `solid`, which other modules do not have; None keeps it."""
    reformations: int = 25

    def text(self, module: str) -> str:
        """<Control>."""
        analysis = self.analysis or ("STATIC" if module == "solid" else "TRANSIENT")
        matrix = {None: "", True: "symmetric", False: "non-symmetric"}[self.symmetric]
        stepper = (
            f'<time_stepper type="default"><max_retries>{self.retries}</max_retries><opt_iter>15</opt_iter>'
            f"<dtmin>0</dtmin><dtmax>{self.size:g}</dtmax></time_stepper>"
        )
        return (
            f"<Control><analysis>{analysis}</analysis><time_steps>{self.steps}</time_steps>"
            f"<step_size>{self.size:g}</step_size><plot_level>PLOT_NEVER</plot_level>{stepper if self.retries else ''}"
            f'<solver type="{module}">'
            + (f"<symmetric_stiffness>{matrix}</symmetric_stiffness>" if matrix else "")
            + f"<max_refs>{self.reformations}</max_refs>"
            f'<qn_method type="{self.method}"><max_ups>{self.updates}</max_ups></qn_method></solver></Control>'
        )


def control(module: str, steps: int, size: float, *, retries: int = 0, analysis: str = "STATIC") -> str:
    """Equal steps of full Newton iterations."""
    return Scheme(steps, size, analysis, retries).text(module)


def curve(number: int, *points: tuple[float, float], interpolate: str = "LINEAR") -> str:
    """A load curve, of straight lines unless `interpolate` says otherwise."""
    inner = "".join(f"<pt>{t:g},{value:g}</pt>" for t, value in points)
    return (
        f'<load_controller id="{number}" type="loadcurve"><interpolate>{interpolate}</interpolate>'
        f"<extend>CONSTANT</extend><points>{inner}</points></load_controller>"
    )


@dataclass
class Document:
    """A whole model: each entry is the content of the section of that name."""

    mesh: str
    materials: Sequence[str]
    module: str = "solid"
    control: str = ""
    boundary: Sequence[str] = ()
    rigid: Sequence[str] = ()
    loads: Sequence[str] = ()
    contacts: Sequence[str] = ()
    adaptors: Sequence[str] = ()
    steps: Sequence[str] = ()
    curves: Sequence[str] = ()
    node_data: str = "ux;uy;uz"
    surface_data: dict[str, str] = field(default_factory=dict)
    rigid_data: dict[int, str] = field(default_factory=dict)
    globals: str = ""
    further: Mapping[str, Sequence[str]] = field(default_factory=dict)  # entries of sections that have no name here

    def text(self) -> str:
        """The model as FEBio 4 XML; logged data go to the files nodes.txt, surface-NAME.txt, rigid-N.txt."""
        sections = {
            "Boundary": self.boundary,
            "Rigid": self.rigid,
            "Loads": self.loads,
            "Contact": self.contacts,
            "MeshAdaptor": self.adaptors,
            "Step": self.steps,
            "LoadData": self.curves,
            **self.further,
        }
        constants = f"<Constants><T>298</T><R>8.314e-06</R><Fc>{FARADAY}</Fc></Constants>"
        output = [f'<node_data data="{self.node_data}" file="nodes.txt" delim=" "/>']
        for name, data in self.surface_data.items():
            output.append(f'<surface_data surface="{name}" data="{data}" file="surface-{name}.txt" delim=" "/>')
        for number, data in self.rigid_data.items():
            output.append(
                f'<rigid_body_data data="{data}" file="rigid-{number}.txt" delim=" ">{number}</rigid_body_data>'
            )
        return "\n".join(
            [
                '<?xml version="1.0" encoding="ISO-8859-1"?>',
                '<febio_spec version="4.0">',
                f'<Module type="{self.module}"/>',
                self.control,
                f"<Globals>{constants}{self.globals}</Globals>",
                "<Material>",
                *self.materials,
                "</Material>",
                self.mesh,
                *(f"<{name}>{''.join(lines)}</{name}>" for name, lines in sections.items() if lines),
                f"<Output><logfile>{''.join(output)}</logfile></Output></febio_spec>",
            ]
        )


def step(number: int, inner: str) -> str:
    """A step of the analysis with the sections that it has."""
    return f'<step id="{number}" name="step{number}">{inner}</step>'


def table(path: Path) -> np.ndarray:
    """Logged data, shape (times, items, columns)."""
    blocks: list[list[list[float]]] = []
    for line in path.read_text().splitlines():
        if line.startswith("*Step"):
            blocks.append([])
        elif line and not line.startswith("*"):
            blocks[-1].append([float(entry) for entry in line.split()[1:]])
    return np.array([block for block in blocks if block])
