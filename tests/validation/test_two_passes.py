"""Two passes, and augmentations with friction: bodies that slide, roll and press, beside FEBio's own interfaces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import febio_runs
import numpy as np
import pytest

from harness.run import engine
from studies.models.small import Document, Parts, biphasic, contact, control, curve, elastic, fixed, moved, rigid

Map = Callable[[float, float, float], tuple[float, float, float]]
LATER, FIRST = curve(2, (0, 0), (0.2, 0), (1, 1)), curve(1, (0, 0), (0.2, 1), (1, 1))
"""What moves sideways begins once what presses is there."""


@dataclass(frozen=True)
class Scene:
    """Two bodies `low` and `up`, the lower one held, and the parameters of the contact between them."""

    parts: Parts
    materials: tuple[str, ...]
    conditions: tuple[str, ...]
    params: str
    module: str = "solid"
    steps: int = 20
    rigid: tuple[str, ...] = ()
    updates: str = '"BFGS"><max_ups>0'
    retries: int = 5

    def document(self, kind: str) -> str:
        """The model with an interface of this type."""
        analysis = "TRANSIENT" if self.module == "biphasic" else "STATIC"
        scheme = control(self.module, self.steps, 1 / self.steps, retries=self.retries, analysis=analysis)
        return Document(
            self.parts.mesh({"pair": ("up-bottom", "low-top")}),
            self.materials,
            module=self.module,
            control=scheme.replace('"BFGS"><max_ups>0', self.updates),
            boundary=self.conditions,
            rigid=self.rigid,
            contacts=(contact("c", "pair", kind, self.params),),
            curves=(FIRST, LATER),
        ).text()

    @property
    def counterpart(self) -> str:
        """FEBio's interface."""
        return "sliding-biphasic" if self.module == "biphasic" else "sliding-elastic"


def params(laugon: str, factor: float, friction: float = 0.0, *, two_pass: int = 1, automatic: int = 1) -> str:
    """Parameters of a contact: `factor` is of the penalties."""
    numbers = {
        "laugon": laugon,
        "tolerance": 0.1,
        "auto_penalty": automatic,
        "penalty": factor,
        "pressure_penalty": factor,
        "search_radius": 0.5,
        "two_pass": two_pass,
        "symmetric_stiffness": 0,
    }
    rubs = {"fric_coeff": friction, "contact_frac": 0.2} if friction else {}
    return "".join(f"<{tag}>{value}</{tag}>" for tag, value in (numbers | rubs).items())


def add(parts: Parts, name: str, cells: tuple[int, int, int], material: str, place: Map) -> None:
    """A unit cube that is mapped to its place; all of its nodes are a set, too."""
    first = len(parts.nodes)
    parts.box(name, (0, 0, 0), (1, 1, 1), cells, material)
    parts.nodes[first:] = [place(*point) for point in parts.nodes[first:]]
    parts.node_sets[name] = list(range(first + 1, len(parts.nodes) + 1))


def held(body: str, dofs: str) -> str:
    """A rigid body that cannot move in these ways."""
    inner = "".join(f"<R{dof}_dof>1</R{dof}_dof>" for dof in dofs)
    return f'<rigid_bc type="rigid_fixed"><rb>{body}</rb>{inner}</rigid_bc>'


def both(material=elastic) -> tuple[str, ...]:
    """Materials of the two bodies."""
    return material("one", 1), material("two", 2)


def strip(*, lift: float = 0.0) -> Parts:
    """A half cylinder on a slab, in a plane."""
    parts = Parts()
    add(parts, "low", (24, 1, 3), "one", lambda u, v, w: (4 * u - 2, 0.2 * v, 0.6 * (w - 1)))

    def arc(u: float, v: float, w: float) -> tuple[float, float, float]:
        angle, radius = 0.6 * np.pi * (u - 0.5), 1 - 0.35 * w
        return radius * np.sin(angle) - 0.7, 0.2 * v, 1 - radius * np.cos(angle) + lift

    add(parts, "up", (9, 1, 2), "two", arc)
    return parts


IN_PLANE = (fixed("low-bottom", "x", "y", "z"), fixed("low", "y"), fixed("up", "y"))


def sliding(friction: float, laugon: str, factor: float) -> Scene:
    """The half cylinder slides along the slab."""
    conditions = (*IN_PLANE, moved("up-top", "z", -0.12), moved("up-top", "x", 1.2, 2))
    return Scene(strip(), both(), conditions, params(laugon, factor, friction))


def riding() -> Scene:
    """The same of biphasic bodies, under a force."""
    bone = (
        held("bone", "yuvw"),
        '<rigid_bc type="rigid_displacement"><rb>bone</rb><dof>x</dof><value lc="2">1.2</value></rigid_bc>',
        '<rigid_load type="rigid_force"><rb>bone</rb><dof>Rz</dof><value lc="1">-0.03</value></rigid_load>',
    )
    on_bone = '<bc type="rigid" node_set="up-top"><rb>bone</rb></bc>'
    materials = (*both(biphasic), rigid("bone", 3))
    scene = Scene(
        strip(lift=-0.02), materials, (*IN_PLANE, on_bone), params("AUGLAG", 0.2, 0.2), "biphasic", rigid=bone
    )
    return replace(scene, params=scene.params.replace("<tolerance>0.1<", "<tolerance>0.2<"), steps=10)


def incongruent(laugon: str, factor: float, friction: float = 0.0) -> Scene:
    """A cylinder of radius 3 in a trough of radius 3.3."""
    parts = Parts()

    def trough(u: float, v: float, w: float) -> tuple[float, float, float]:
        x = 4 * u - 2
        return x, 0.3 * v, w * (4.3 - np.sqrt(3.3**2 - x**2)) - 1

    def cylinder(u: float, v: float, w: float) -> tuple[float, float, float]:
        x = 3.2 * u - 1.6
        below = 3 - np.sqrt(9 - x**2)
        return x, 0.3 * v, below + w * (1.5 - below)

    add(parts, "low", (14, 1, 3), "one", trough)
    add(parts, "up", (11, 1, 3), "two", cylinder)
    conditions = (*IN_PLANE, fixed("up-top", "x"), moved("up-top", "z", -0.3))
    return Scene(parts, both(), conditions, params(laugon, factor, friction), steps=10)


def tubes() -> Scene:
    """Halves of two crossed tubes, pressed together by their edges; they touch at a point."""
    parts = Parts()

    def low(u: float, v: float, w: float) -> tuple[float, float, float]:
        angle, radius = np.pi * (1 - v), 0.75 + 0.25 * w
        return 4 * u - 2, radius * np.cos(angle), radius * np.sin(angle)

    def up(u: float, v: float, w: float) -> tuple[float, float, float]:
        angle, radius = np.pi * (1 + u), 1 - 0.25 * w
        return radius * np.cos(angle), 4 * v - 2, 2 + radius * np.sin(angle)

    add(parts, "low", (10, 8, 1), "one", low)
    add(parts, "up", (7, 9, 1), "two", up)
    ends = {"base": ("low-front", "low-back"), "head": ("up-left", "up-right")}
    for name, sides in ends.items():
        parts.node_sets[name] = sorted({node for side in sides for node in parts.node_sets[side]})
    conditions = (fixed("base", "x", "y", "z"), fixed("head", "x", "y"), moved("head", "z", -0.3))
    return Scene(parts, both(), conditions, params("AUGLAG", 0.5, 0.02), steps=10)


def blocks(material, laugon: str, factor: float, friction: float) -> Scene:
    """A block that is pressed on a longer one and slides, on meshes that do not match."""
    parts = Parts()
    parts.box("low", (-2, 0, 0), (2, 1, 1), (8, 2, 2), "one")
    parts.box("up", (-1, 0, 1), (1, 1, 2), (5, 3, 2), "two")
    above = (fixed("up-top", "y"), moved("up-top", "z", -0.15), moved("up-top", "x", 0.6, 2))
    module = "biphasic" if material is biphasic else "solid"
    return Scene(
        parts, both(material), (fixed("low-bottom", "x", "y", "z"), *above), params(laugon, factor, friction), module
    )


def dragged() -> Scene:
    """A block on a rigid plate, one pass, by a quasi-Newton method and steps that are never cut back."""
    parts = Parts()
    parts.box("low", (-1, -1, -0.2), (5, 2, 0), (1, 1, 1), "one")
    parts.box("up", (0, 0, 0), (1, 1, 1), (5, 5, 5), "two")
    above = (fixed("up-top", "y"), moved("up-top", "z", -0.4), moved("up-top", "x", 2.5, 2))
    given = params("AUGLAG", 12, 0.015, two_pass=0, automatic=0).replace("<tolerance>0.1<", "<tolerance>0.02<")
    return Scene(
        parts,
        (rigid("one", 1), elastic("two", 2)),
        above,
        given,
        steps=50,
        rigid=(held("one", "xyzuvw"),),
        updates='"Broyden"><max_ups>10',
        retries=0,
    )


SCENES = {
    "cylinder slides, penalty": sliding(0.0, "PENALTY", 1.0),
    "cylinder slides, friction": sliding(0.02, "AUGLAG", 0.3),
    "biphasic cylinder rides under a force": riding(),
    "incongruent cylinders": incongruent("PENALTY", 1.0),
    "incongruent cylinders, augmented, friction": incongruent("AUGLAG", 1.0, 0.3),
    "crossed tubes": tubes(),
    "blocks slide": blocks(elastic, "PENALTY", 0.1, 0.0),
    "blocks slide, augmented, friction": blocks(elastic, "AUGLAG", 1.0, 0.3),
    "biphasic blocks slide, augmented, friction": blocks(biphasic, "AUGLAG", 0.5, 0.3),
    "dragged block": dragged(),
}


@pytest.mark.usefixtures("runner")
@pytest.mark.parametrize("name", SCENES)
def test_a_scene_takes_no_more_than_with_febios_interface(name, tmp_path):
    scene = SCENES[name]
    ours, theirs = tmp_path / "ours.feb", tmp_path / "theirs.feb"
    ours.write_text(scene.document("sliding-mixture"))
    theirs.write_text(scene.document(scene.counterpart))
    febio = febio_runs.run(theirs, check=False).report
    mixture = febio_runs.run(ours, plugin=engine.required_plugin()).report
    assert mixture.normal
    if febio.normal:
        assert mixture.retries <= febio.retries
        assert mixture.iterations <= febio.iterations
