"""Scenes of shells, of two rigid bodies and of modules with a fluid: what slab and block have no words for."""

from collections.abc import Mapping
from functools import partial

from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed, moved, rigid, slotted_block
from studies.synthetic_scenes.reported.sketch import Drawn

PENALTY = "<laugon>PENALTY</laugon><auto_penalty>1</auto_penalty><penalty>10</penalty>"
RAMP = curve(1, (0, 0), (1, 1))
HELD = "".join(f"<R{dof}_dof>1</R{dof}_dof>" for dof in "xyzuvw")  # every degree of freedom of a rigid body


def _control(module: str = "solid", analysis: str = "STATIC") -> str:
    return control(module, 10, 0.1, retries=8, analysis=analysis)


def _sphere_like(parts: Parts, name: str, material: str) -> None:
    """A block whose lower face is a shallow bowl, 0.01 mm over z = 1 in its middle."""
    first = len(parts.nodes)
    parts.box(name, (-0.8, -0.8, 1.01), (0.8, 0.8, 1.81), (6, 6, 2), material)
    moved_nodes = [(x, y, z + (x * x + y * y) / 6.0 * (1.81 - z) / 0.8) for x, y, z in parts.nodes[first:]]
    parts.nodes[first:] = moved_nodes


def _on_shells(*, faces_up: bool, is_rigid: bool = False) -> Document:
    """A block on a plate of shells of 0.2 mm on its edges."""
    parts = Parts()
    _sphere_like(parts, "block", "soft")
    parts.plate("plate", "skin", 1.0 if faces_up else 0.8, 0.2, faces_up=faces_up)
    edges = [n for n in parts.node_sets["plate"] if {0.0, 1.0} & set(parts.nodes[n - 1][:2])]
    parts.node_sets["edges"] = edges
    held = fixed("edges")
    body = f'<rigid_bc type="rigid_fixed"><rb>skin</rb>{HELD}</rigid_bc>'
    if not faces_up:
        parts.surfaces["plate"] = [facet[::-1] for facet in parts.surfaces["plate"]]
    side = "" if faces_up else "<shell_bottom_secondary>1</shell_bottom_secondary>"
    return Document(
        parts.mesh({"pair": ("block-bottom", "plate")}),
        (elastic("soft", 1, 1.0, 0.3), rigid("skin", 2) if is_rigid else elastic("skin", 2, 10.0, 0.3)),
        control=_control(),
        boundary=(fixed("block-top", "x", "y"), moved("block-top", "z", -0.1), *(() if is_rigid else (held,))),
        rigid=(body,) if is_rigid else (),
        contacts=(contact("c", "pair", "sliding-elastic", PENALTY + side),),
        curves=(RAMP,),
    )


def _pressed(module: str, analysis: str) -> Document:
    """A block on a slab, without inertia, in a module that knows more."""
    parts = Parts()
    parts.box("slab", (-1, -1, 0), (1, 1, 1), (4, 4, 2), "one")
    _sphere_like(parts, "block", "two")
    light = [
        elastic(name, n, 1.0, 0.3).replace("<density>1<", "<density>1e-12<") for n, name in ((1, "one"), (2, "two"))
    ]
    return Document(
        parts.mesh({"pair": ("block-bottom", "slab-top")}),
        light,
        module=module,
        control=_control(module, analysis),
        boundary=(fixed("slab-bottom"), fixed("block-top", "x", "y"), moved("block-top", "z", -0.1)),
        contacts=(contact("c", "pair", "sliding-elastic", PENALTY),),
        curves=(RAMP,),
    )


def _stacked() -> Document:
    """Three bodies on one another: a body in the middle with a contact on either side."""
    parts = Parts()
    parts.box("slab", (-1, -1, 0), (1, 1, 1), (4, 4, 2), "one")
    parts.box("disc", (-0.9, -0.9, 0.995), (0.9, 0.9, 1.5), (5, 5, 2), "two")
    parts.box("cap", (-0.7, -0.7, 1.51), (0.7, 0.7, 2), (3, 3, 2), "one")
    return Document(
        parts.mesh({"low": ("disc-bottom", "slab-top"), "high": ("cap-bottom", "disc-top")}),
        (elastic("one", 1, 2.0, 0.3), elastic("two", 2, 1.0, 0.45)),
        control=_control(),
        boundary=(
            fixed("slab-bottom"),
            fixed("cap-top", "x", "y"),
            fixed("disc-left", "x"),
            fixed("disc-front", "y"),
            moved("cap-top", "z", -0.1),
        ),
        contacts=tuple(contact(pair, pair, "sliding-elastic", PENALTY) for pair in ("low", "high")),
        curves=(RAMP,),
    )


def _slotted() -> Document:
    """A block with a slot that closes: both of its sides are one surface, in contact with itself."""
    parts = slotted_block("soft")
    return Document(
        parts.mesh({"pair": ("slot", "slot")}),
        (elastic("soft", 1, 1, 0.3),),
        control=_control(),
        boundary=(fixed("bottom"), moved("tip", "z", -0.35)),
        contacts=(contact("c", "pair", "sliding-elastic", PENALTY),),
        curves=(RAMP,),
    )


SCENES: Mapping[str, Drawn] = {
    "shells-front": Drawn("a block on the front face of shells", partial(_on_shells, faces_up=True)),
    "shells-back": Drawn("a block on the back face of shells", partial(_on_shells, faces_up=False)),
    "shells-rigid": Drawn("a block on rigid shells", partial(_on_shells, faces_up=True, is_rigid=True)),
    "fluid-FSI": Drawn("module fluid-FSI", partial(_pressed, "fluid-FSI", "DYNAMIC")),
    "stacked": Drawn("three bodies, two contacts", _stacked),
    "slot-closes": Drawn("a surface in contact with itself", _slotted),
}
