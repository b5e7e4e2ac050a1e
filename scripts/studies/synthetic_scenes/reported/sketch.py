"""A model of mapped bodies: what a scene says, and its file with FEBio's interface."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

from studies.models import small
from studies.models.small import Document, Scheme
from studies.synthetic_scenes.reported.shapes import Shape

Ramp = tuple[tuple[float, float], ...]
UP: Ramp = ((0, 0), (1, 1))  # rises from 0 to 1 s
LATER: Ramp = ((0, 0), (1, 0), (2, 1))  # rises from 1 to 2 s
BACK: Ramp = ((0, 0), (1, 0), (1.5, 1), (2.5, -1), (3, 0))  # to and fro between 1 and 3 s
AT_ONCE: Ramp = ((0, 0), (0.1, 1), (1, 1))  # rises within the first tenth of a second
CURVES = (UP, LATER, BACK, AT_ONCE)  # load curves of every scene, numbered from 1


USUAL = Scheme()  # ten steps of full Newton iterations


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
    materials: Mapping[str, tuple[str, str]]  # by body: FEBio's type, and what is inside
    contacts: Sequence[Touch]
    conditions: Sequence[str] = ()  # entries of the sections Boundary, Rigid, Loads, Initial and MeshAdaptor
    scheme: Scheme = USUAL
    module: str = "solid"
    globals: str = ""  # solutes

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
            contacts=[
                small.contact(f"c{n}", f"pair{n}", touch.kind, touch.params) for n, touch in enumerate(self.contacts, 1)
            ],
            curves=[small.curve(n, *points) for n, points in enumerate(CURVES, 1)],
            node_data=data,
            globals=self.globals,
            further=sections,
        ).text()

    def _mesh(self) -> str:
        ends = accumulate((len(shape.nodes) for shape in self.bodies.values()), initial=1)
        first = dict(zip(self.bodies, ends, strict=False))
        lines = small.mesh_lines(
            (point for shape in self.bodies.values() for point in shape.nodes),
            (
                (shape.element, body, ([n + first[body] for n in row] for row in shape.elements))
                for body, shape in self.bodies.items()
            ),
        )
        for body, shape in self.bodies.items():
            lines += _sets(body, shape, first[body])
        lines += [small.surface_pair(f"pair{n}", c.primary, c.secondary) for n, c in enumerate(self.contacts, 1)]
        domains = "".join(small.domain(body, body, shape.thickness) for body, shape in self.bodies.items())
        return "\n".join([*lines, "</Mesh>", f"<MeshDomains>{domains}</MeshDomains>"])


SECTION_OF = {
    "bc": "Boundary",
    **dict.fromkeys(("rigid_bc", "rigid_load", "rigid_connector"), "Rigid"),
    **dict.fromkeys(("surface_load", "body_load"), "Loads"),
    "ic": "Initial",
    "mesh_adaptor": "MeshAdaptor",
}
"""By the tag of an entry, the section that it is in."""


def _sets(body: str, shape: Shape, first: int) -> list[str]:
    lines = [small.node_set(body, range(first, first + len(shape.nodes)))]
    for side, facets in shape.sides.items():
        lines.append(small.node_set(f"{body}-{side}", sorted({n + first for facet in facets for n in facet})))
        if shape.thickness and side not in ("face", "back"):
            continue  # an edge of a shell
        lines.append(f'<Surface name="{body}-{side}">')
        for number, facet in enumerate(facets, 1):
            tag = f"{'tri' if len(facet) in (3, 6, 7) else 'quad'}{len(facet)}"
            lines.append(f'<{tag} id="{number}">{small.listed(n + first for n in facet)}</{tag}>')
        lines.append("</Surface>")
    return lines


@dataclass(frozen=True)
class Drawn:
    """A scene that is drawn when it is written."""

    about: str  # what it stands for
    draw: Callable[[], Sketch | Document]  # its model

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` into `folder`, and return its path."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{name}.feb"
        path.write_text(self.draw().text(), encoding="iso-8859-1")
        return path
