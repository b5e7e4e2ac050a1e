"""The scenes, one entry each: what it stands for, its bodies, its load, and FEBio's interface between them."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import ClassVar

from lxml import etree

from harness.models import parts
from harness.models.document import Model
from studies.models.pieces import move_rigid
from studies.synthetic_scenes.slab_and_block import BASE, BLOCK, LOADED, LOWER, PAIR, SLAB, Cells, Elements, Shape, mesh

DEPTH = 0.15  # mm by which the block is moved down
GAP = 0.01  # mm between the two bodies at the start, where the block is moved
OVERLAP = 0.02  # mm by which they overlap where it is pushed: it has to rest on something
SLIDE = 0.3  # mm by which it slides afterwards, where it does


@dataclass(frozen=True)
class Xml:
    """A material as FEBio's XML, without the outer tag: its type and what is inside."""

    kind: str
    inner: str
    solutes: ClassVar[tuple[parts.Solute, ...]] = ()

    def write(self, parent: parts.Element, number: int, name: str, module: str) -> None:  # noqa: ARG002 the same in all modules
        """Append the material to the section `parent`."""
        attributes = f'id="{number}" name="{name}" type="{self.kind}"'
        parent.append(etree.fromstring(f"<material {attributes}><density>1e-3</density>{self.inner}</material>"))


def elastic(modulus: float = 1.0, ratio: float = 0.3) -> Xml:
    """Neo-Hookean, MPa."""
    return Xml("neo-Hookean", f"<E>{modulus}</E><v>{ratio}</v>")


_NEO = '<{tag} type="neo-Hookean"><density>1e-3</density><E>1</E><v>0.3</v></{tag}>'
_FIBRE = '<fiber type="vector"><vector>1,0,0</vector></fiber>'
SOLIDS: Mapping[str, Xml] = {
    "isotropic elastic": Xml("isotropic elastic", "<E>1</E><v>0.3</v>"),
    "Mooney-Rivlin": Xml("Mooney-Rivlin", "<c1>0.2</c1><c2>0.05</c2><k>50</k>"),
    "Ogden": Xml("Ogden", "<k>50</k><c1>0.3</c1><m1>4</m1>"),
    "Holmes-Mow": Xml("Holmes-Mow", "<E>1</E><v>0.2</v><beta>0.5</beta>"),
    "orthotropic elastic": Xml(
        "orthotropic elastic",
        "<E1>1</E1><E2>2</E2><E3>1.5</E3><v12>0.1</v12><v23>0.1</v23><v31>0.1</v31>"
        "<G12>0.5</G12><G23>0.7</G23><G31>0.6</G31>",
    ),
    "transversely isotropic, exponential fibres": Xml(
        "trans iso Mooney-Rivlin",
        f"<c1>0.2</c1><c2>0</c2><c3>0.05</c3><c4>30</c4><c5>5</c5><lam_max>1.1</lam_max><k>50</k>{_FIBRE}",
    ),
    "mixture with exponential fibres": Xml(
        "solid mixture",
        _NEO.format(tag="solid")
        + '<solid type="fiber-exp-pow"><alpha>30</alpha><beta>2</beta><ksi>0.2</ksi>'
        + f"{_FIBRE}</solid>",
    ),
    "viscoelastic": Xml("viscoelastic", f"<t1>0.2</t1><g0>1</g0><g1>0.5</g1>{_NEO.format(tag='elastic')}"),
    "reactive viscoelastic": Xml(
        "reactive viscoelastic",
        "<wmin>0.05</wmin><kinetics>1</kinetics><trigger>0</trigger>"
        + _NEO.format(tag="elastic")
        + _NEO.format(tag="bond")
        + '<relaxation type="relaxation-exponential"><tau>0.2</tau></relaxation>',
    ),
    "damage": Xml("damage neo-Hookean", "<E>1</E><v>0.3</v><a>0.1</a><b>0.5</b>"),
    "prestrain": Xml(
        "prestrain elastic",
        _NEO.format(tag="elastic")
        + '<prestrain type="prestrain gradient"><ramp>1</ramp><F0>1.02,0,0,0,1.02,0,0,0,1.02</F0></prestrain>',
    ),
    "Hencky": Xml("isotropic Hencky", "<E>1</E><v>0.3</v>"),
}
"""Elastic and inelastic solids of both bodies, by what they stand for."""


def porous(
    modulus: float = 1.0, solutes: tuple[parts.Solute, ...] = (), kind: str | None = "biphasic"
) -> parts.Mixture:
    """A soft porous body."""
    return parts.Mixture(parts.Solid(modulus, 0.1), 1e-2, 0.8, solutes, 1.0, 0.0, kind)


@dataclass(frozen=True)
class Scene:
    """A scene."""

    about: str  # what it stands for
    contact: str = "sliding-elastic"  # FEBio's type of contact
    params: tuple[parts.Param, ...] = ()  # its parameters
    slab: parts.Material | Xml = field(default_factory=elastic)
    block: parts.Material | Xml = field(default_factory=lambda: elastic(2.0))
    elements: Elements = Elements.HEX8
    shape: Shape = Shape.CYLINDER  # see `slab_and_block`
    module: str = "solid"
    force: float | None = None  # N, on a free rigid block, or MPa on the top of a deformable one, where it is not moved
    slides: bool = False  # whether the block slides after it has been pressed
    dynamic: bool = False
    primary: str = LOWER  # its surface is the primary one
    stepper: bool = True  # whether steps adapt themselves
    fineness: int = 1  # of the mesh; see `slab_and_block`

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` with FEBio's interface into `folder`, and return its path."""
        return self.model(name).write(folder)

    def model(self, name: str) -> Model:
        """The model with FEBio's interface."""
        solutes = sorted({solute.sol for body in (self.slab, self.block) for solute in body.solutes})
        ambient = tuple(_ambient(self.contact, sol) for sol in solutes)
        stepper = parts.TimeStepper(0.1, retries=8, optimal_iterations=15) if self.stepper else None
        gap, steps = GAP if self.force is None else -OVERLAP, 20 if self.slides else 10
        analysis = "DYNAMIC" if self.dynamic else None
        # One material may stand for any of the types: a model writes what it is given.
        materials: dict[str, parts.Material] = {SLAB: self.slab, BLOCK: self.block}  # type: ignore[dict-item]
        return Model(
            name=name,
            header=self.about,
            module=self.module,
            mesh=mesh(self.elements, self.shape, self.primary, gap, Cells().times(self.fineness)),
            materials=materials,
            conditions=tuple(self._conditions(solutes)),
            control=parts.Control(steps, 0.1, reformations=25, stepper=stepper, analysis=analysis),
            contacts=(parts.Contact(self.contact, PAIR, (*self.params, *ambient)),),
            curves=(parts.Curve(((0.0, 0.0), (1.0, 1.0))), parts.Curve(((0.0, 0.0), (1.0, 0.0), (2.0, 1.0)))),
        )

    def _conditions(self, solutes: list[int]) -> list[parts.Condition]:
        found = [parts.hold_rigid(SLAB, "xyzuvw")] if isinstance(self.slab, parts.Rigid) else [parts.fix(BASE, "xyz")]
        found += self._load()
        for body, material, outside in ((SLAB, self.slab, BASE), (BLOCK, self.block, LOADED)):
            if isinstance(material, parts.Mixture):
                found.append(parts.pressure(outside, 0.0))
                held = 1.0 if body == SLAB else 0.5
                found += [parts.concentration(outside, held, sol=sol) for sol in solutes]
                found += [parts.initial_concentration(body, held, sol) for sol in solutes]
        return found

    def _load(self) -> list[parts.Condition]:
        rigid = isinstance(self.block, parts.Rigid)
        if self.force is not None:
            if rigid:
                return [parts.hold_rigid(BLOCK, "xyuvw"), parts.push_rigid(BLOCK, "z", -self.force, 1)]
            return [parts.fix(LOADED, "xy"), parts.normal_load(LOADED, self.force, 1)]
        held = "y" if self.slides else "xy"
        move, where = (move_rigid, BLOCK) if rigid else (parts.displace, LOADED)
        slide = [move(where, "x", SLIDE, 2)] if self.slides else []
        return [
            parts.hold_rigid(BLOCK, f"{held}uvw") if rigid else parts.fix(LOADED, held),
            move(where, "z", -DEPTH, 1),
            *slide,
        ]


def _ambient(contact: str, sol: int) -> parts.Param:
    attributes = {} if contact == "sliding-biphasic-solute" else {"sol": str(sol)}
    return parts.Param("ambient_concentration", 0.5, attributes=attributes)


def _penalty(value: float, *extra: parts.Param) -> tuple[parts.Param, ...]:
    """Automatic penalties with factors, as users set them."""
    found = [parts.Param("laugon", "PENALTY"), parts.Param("auto_penalty", True), parts.Param("penalty", value)]
    replaced = {param.tag for param in extra}
    return (*(param for param in found if param.tag not in replaced), *extra)


AUGMENTED = (parts.Param("laugon", "AUGLAG"), parts.Param("tolerance", 0.05))
TWO_PASS = parts.Param("two_pass", True)
SOLUTE = (parts.Solute(1, 5e-3, 1e-2),)
SALT = (parts.Solute(1, 5e-3, 1e-2), parts.Solute(2, 4e-3, 1e-2))


def _solids() -> dict[str, Scene]:
    basic = Scene("cylindrical block on a slab", params=_penalty(10.0))
    scenes = {
        f"material-{name.replace(' ', '-').replace(',', '')}": replace(
            basic, about=f"{name}, both bodies", slab=material, block=material
        )
        for name, material in SOLIDS.items()
    }
    scenes |= {
        f"elements-{kind.value}": replace(basic, about=f"bodies of {kind.value}", elements=kind) for kind in Elements
    }
    scenes |= {
        f"type-{kind}": replace(
            basic, about=kind, contact=kind, params=_penalty(10.0, parts.Param("laugon", "PENALTY"))
        )
        for kind in ("sliding-facet-on-facet", "sliding-node-on-facet")
    }
    return scenes


def _loads() -> dict[str, Scene]:
    basic = Scene("", params=_penalty(10.0))
    return {
        "sphere": replace(basic, about="spherical block", shape=Shape.SPHERE),
        "flat": replace(basic, about="flat block with sharp edges", shape=Shape.FLAT),
        "sphere-tet4": replace(
            basic, about="spherical block of tetrahedra", shape=Shape.SPHERE, elements=Elements.TET4
        ),
        "finer": replace(basic, about="bodies of hex8, twice as fine", fineness=2),
        "slab-primary": replace(basic, about="the slab as primary surface", primary="slab"),
        "sliding": replace(basic, about="the block slides after it is pressed", slides=True),
        "sliding-tet10": replace(basic, about="sliding, tet10", slides=True, elements=Elements.TET10),
        "two-pass": replace(basic, about="two passes", params=_penalty(5.0, TWO_PASS)),
        "augmented": replace(basic, about="augmented Lagrangian", params=_penalty(5.0, *AUGMENTED)),
        "two-pass-augmented": replace(basic, about="two passes, augmented", params=_penalty(5.0, TWO_PASS, *AUGMENTED)),
        "explicit-penalty": replace(
            basic, about="numerical penalty", params=_penalty(20.0, parts.Param("auto_penalty", False))
        ),
        "tension": replace(
            basic, about="surfaces that bear tension", params=_penalty(10.0, parts.Param("tension", True))
        ),
        "pressure-load": replace(basic, about="a pressure presses the block", force=0.05),
        "rigid-block": replace(basic, about="a rigid block is moved", block=parts.Rigid()),
        "rigid-block-slides": replace(basic, about="a rigid block slides", block=parts.Rigid(), slides=True),
        "rigid-slab": replace(basic, about="a rigid slab", slab=parts.Rigid(), primary=LOWER),
        "rigid-free": replace(basic, about="a free rigid block, pressed by a force", block=parts.Rigid(), force=0.1),
        "stiff-on-soft": replace(basic, about="a block 1000 times as stiff as the slab", block=elastic(1000.0)),
        "dynamic": replace(basic, about="dynamic analysis", dynamic=True),
        "fixed-steps": replace(basic, about="steps of fixed length", stepper=False),
    }


def _mixtures() -> dict[str, Scene]:
    wet = Scene(
        "biphasic bodies",
        contact="sliding-biphasic",
        params=_penalty(10.0, parts.Param("pressure_penalty", 10.0), parts.Param("symmetric_stiffness", False)),
        module="biphasic",
        slab=porous(),
        block=porous(2.0),
    )
    solute = replace(
        wet,
        contact="sliding-biphasic-solute",
        module="solute",
        params=_penalty(
            10.0,
            *(parts.Param(f"{field}_penalty", 10.0) for field in ("pressure", "concentration")),
            parts.Param("symmetric_stiffness", False),
        ),
        slab=porous(1.0, SOLUTE, "biphasic-solute"),
        block=porous(2.0, SOLUTE, "biphasic-solute"),
    )
    multi = replace(
        solute,
        contact="sliding-multiphasic",
        module="multiphasic",
        slab=porous(1.0, SALT, "multiphasic"),
        block=porous(2.0, SALT, "multiphasic"),
    )
    return {
        "biphasic": wet,
        "biphasic-finer": replace(wet, about="biphasic bodies, twice as fine", fineness=2),
        "biphasic-sliding": replace(wet, about="biphasic bodies, sliding", slides=True),
        "biphasic-two-pass": replace(wet, about="biphasic, two passes", params=(*wet.params, TWO_PASS)),
        "biphasic-tet4": replace(wet, about="biphasic tetrahedra", elements=Elements.TET4),
        "biphasic-hex20": replace(wet, about="biphasic hex20", elements=Elements.HEX20),
        "biphasic-under-rigid": replace(
            wet, about="a rigid block on a biphasic slab", block=parts.Rigid(), primary="slab"
        ),
        "biphasic-creep": replace(wet, about="a free rigid block on a biphasic slab", block=parts.Rigid(), force=0.05),
        "biphasic-impermeable": replace(
            wet, about="porous bodies with sliding-elastic", contact="sliding-elastic", params=_penalty(10.0)
        ),
        "solute": replace(solute, about="a solute crosses"),
        "solute-sliding": replace(solute, about="a solute crosses while sliding", slides=True),
        "solute-tet4": replace(solute, about="a solute crosses between tetrahedra", elements=Elements.TET4),
        "multiphasic": replace(multi, about="two solutes cross"),
        "multiphasic-sphere": replace(multi, about="two solutes, spherical block", shape=Shape.SPHERE),
    }


SCENES: Mapping[str, Scene] = {**_solids(), **_loads(), **_mixtures()}
