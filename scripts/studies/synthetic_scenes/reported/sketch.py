"""A model of mapped bodies: what a scene says, and its file with FEBio's interface."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from studies.models import small
from studies.models.small import Document
from studies.synthetic_scenes.reported.shapes import Shape

Ramp = tuple[tuple[float, float], ...]
UP: Ramp = ((0, 0), (1, 1))
"""Rises from 0 to 1 s."""
LATER: Ramp = ((0, 0), (1, 0), (2, 1))
"""Rises from 1 to 2 s."""
BACK: Ramp = ((0, 0), (1, 0), (1.5, 1), (2.5, -1), (3, 0))
"""To and fro between 1 and 3 s."""
AT_ONCE: Ramp = ((0, 0), (0.1, 1), (1, 1))
"""Rises within the first tenth of a second."""
CURVES = (UP, LATER, BACK, AT_ONCE)
"""Load curves of every scene, numbered from 1."""


@dataclass(frozen=True)
class Scheme:
    """Steps and solver, as users give them."""

    steps: int = 10
    size: float = 0.1
    """Number of steps and the size of one, s."""
    analysis: str = ""
    retries: int = 5
    """How often a failed step is tried again; 0 for steps of fixed size."""
    method: str = "BFGS"
    updates: int = 0
    """Of quasi-Newton updates between two matrices; FEBio's default is 10 of BFGS."""
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


USUAL = Scheme()
"""Ten steps of full Newton iterations."""


@dataclass(frozen=True)
class Touch:
    """A contact: the primary and the secondary side, FEBio's type and its parameters as XML."""

    primary: str
    secondary: str
    kind: str = "sliding-elastic"
    params: str = ""


@dataclass(frozen=True)
class Sketch:
    """A model."""

    bodies: Mapping[str, Shape]
    """Its sides are the surfaces and node sets ``<body>-<side>``; the node set ``<body>`` has all of its nodes."""
    materials: Mapping[str, tuple[str, str]]
    """By body: FEBio's type, and what is inside."""
    contacts: Sequence[Touch]
    conditions: Sequence[str] = ()
    """Entries of the sections Boundary, Rigid, Loads, Initial and MeshAdaptor."""
    scheme: Scheme = USUAL
    module: str = "solid"
    globals: str = ""
    """Solutes."""

    def text(self) -> str:
        """The model as FEBio 4 XML."""
        materials = [
            f'<material id="{n}" name="{body}" type="{kind}">{inner}</material>'
            for n, (body, (kind, inner)) in enumerate(self.materials.items(), 1)
        ]
        data = "ux;uy;uz" if self.module == "solid" else "ux;uy;uz;p"
        sections: dict[str, list[str]] = {}
        for entry in self.conditions:
            sections.setdefault(SECTION_OF[entry[1:].split(" ", 1)[0]], []).append(entry)
        return Document(
            self._mesh(),
            materials,
            module=self.module,
            control=self.scheme.text(self.module),
            boundary=sections.pop("Boundary", ()),
            rigid=sections.pop("Rigid", ()),
            loads=sections.pop("Loads", ()),
            contacts=[
                small.contact(f"c{n}", f"pair{n}", touch.kind, touch.params) for n, touch in enumerate(self.contacts, 1)
            ],
            curves=[small.curve(n, *points) for n, points in enumerate(CURVES, 1)],
            node_data=data,
            globals=self.globals,
            further=sections,
        ).text()

    def _mesh(self) -> str:
        lines = ['<Mesh><Nodes name="all">']
        first = dict(zip(self.bodies, _offsets(self.bodies), strict=True))
        nodes = [point for shape in self.bodies.values() for point in shape.nodes]
        lines += [f'<node id="{n}">{_list(point)}</node>' for n, point in enumerate(nodes, 1)]
        lines.append("</Nodes>")
        number = 0
        for body, shape in self.bodies.items():
            lines.append(f'<Elements type="{shape.element}" name="{body}">')
            for row in shape.elements:
                number += 1
                lines.append(f'<elem id="{number}">{_list(n + first[body] for n in row)}</elem>')
            lines.append("</Elements>")
        for body, shape in self.bodies.items():
            lines += _sets(body, shape, first[body])
        for n, touch in enumerate(self.contacts, 1):
            sides = f"<primary>{touch.primary}</primary><secondary>{touch.secondary}</secondary>"
            lines.append(f'<SurfacePair name="pair{n}">{sides}</SurfacePair>')
        domains = "".join(_domain(body, shape) for body, shape in self.bodies.items())
        return "\n".join([*lines, "</Mesh>", f"<MeshDomains>{domains}</MeshDomains>"])


SECTION_OF = {
    "bc": "Boundary",
    **dict.fromkeys(("rigid_bc", "rigid_load", "rigid_connector"), "Rigid"),
    **dict.fromkeys(("surface_load", "body_load"), "Loads"),
    "ic": "Initial",
    "mesh_adaptor": "MeshAdaptor",
}
"""By the tag of an entry, the section that it is in."""


def _offsets(bodies: Mapping[str, Shape]) -> list[int]:
    """What is added to a body's node numbers, which start from 0."""
    found = [1]
    for shape in bodies.values():
        found.append(found[-1] + len(shape.nodes))
    return found[:-1]


def _sets(body: str, shape: Shape, first: int) -> list[str]:
    lines = [f'<NodeSet name="{body}">{_list(range(first, first + len(shape.nodes)))}</NodeSet>']
    for side, facets in shape.sides.items():
        members = sorted({n + first for facet in facets for n in facet})
        lines.append(f'<NodeSet name="{body}-{side}">{_list(members)}</NodeSet>')
        if not _is_an_edge(shape, side):
            lines.append(f'<Surface name="{body}-{side}">')
            for number, facet in enumerate(facets, 1):
                kind = "tri" if len(facet) in (3, 6, 7) else "quad"
                tag = f"{kind}{len(facet)}"
                lines.append(f'<{tag} id="{number}">{_list(n + first for n in facet)}</{tag}>')
            lines.append("</Surface>")
    return lines


def _is_an_edge(shape: Shape, side: str) -> bool:
    return shape.thickness > 0.0 and side not in ("face", "back")


def _domain(body: str, shape: Shape) -> str:
    if shape.thickness > 0.0:
        thickness = f"<shell_thickness>{shape.thickness:g}</shell_thickness>"
        return f'<ShellDomain name="{body}" mat="{body}">{thickness}</ShellDomain>'
    return f'<SolidDomain name="{body}" mat="{body}"/>'


def _list(numbers: object) -> str:
    return ",".join(f"{number:.12g}" for number in numbers)  # type: ignore[attr-defined]


@dataclass(frozen=True)
class Drawn:
    """A scene that is drawn when it is written."""

    about: str
    """What it stands for."""
    draw: Callable[[], Sketch | Document]
    """Its model."""

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` into `folder`, and return its path."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{name}.feb"
        path.write_text(self.draw().text(), encoding="iso-8859-1")
        return path
