"""A cam that turns under a flat follower, both rigid; a soft block above the follower presses it down.

Facets come into contact and leave it one after the other, and those of the last step do not tell which are next.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from harness.models.blocks import FACES
from studies.models import small
from studies.models.small import Document, Part, Parts

RADIUS, LIFT, HOLE, WIDTH = 1.0, 0.2, 0.4, 0.5
"""mm: mean radius of the cam, how much larger or smaller it becomes, radius of its hole, and its width."""
SPRING = 0.05
"""MPa, of the block above the follower."""


def profile(angle: float) -> float:
    """Radius of the cam at an angle from where it is least, mm."""
    return RADIUS - LIFT * float(np.cos(angle))


@dataclass(frozen=True)
class Cam:
    """Choices of the scene.

    Attributes
    ----------
    around : int
        Elements around the cam.
    steps : int
        Time steps for one turn.
    contact : str
        Type of the contact.
    params : str
        Of the contact, as XML.
    """

    around: int = 36
    steps: int = 50
    contact: str = "sliding-mixture"
    params: str = "<penalty>100</penalty>"

    def document(self) -> Document:
        """The model."""
        parts = Parts()
        self._add_cam(parts)
        _add_follower(parts)
        materials = (small.rigid("cam", 1), small.rigid("follower", 2), small.elastic("spring", 3, SPRING, 0.3))
        turn = f'<dof>Rv</dof><value lc="1">{2.0 * np.pi:.12g}</value>'
        return Document(
            parts.mesh({"pair": ("cam", "follower-bottom")}),
            materials,
            control=small.control("solid", self.steps, 1.0 / self.steps, retries=5),
            boundary=(small.fixed("follower-top", "x", "y", "z"),),
            rigid=(
                _held("cam", "xyzuw"),
                _held("follower", "xyuvw"),
                f'<rigid_bc name="turn" type="rigid_rotation"><rb>cam</rb>{turn}</rigid_bc>',
            ),
            contacts=(small.contact("cam", "pair", self.contact, self.params),),
            curves=(small.curve(1, (0.0, 0.0), (1.0, 1.0)),),
            rigid_data={2: "z"},
        )

    def _add_cam(self, parts: Parts) -> None:
        """Add a ring of hex8 around the y axis, whose outside is the surface `cam`."""
        first = len(parts.nodes) + 1
        for n in range(self.around):
            angle = 2.0 * np.pi * n / self.around
            for radius in (HOLE, profile(angle)):
                parts.nodes += [(radius * np.sin(angle), y, radius * np.cos(angle)) for y in (0.0, WIDTH)]

        def number(n: int, outer: int, back: int) -> int:
            return first + 4 * (n % self.around) + 2 * outer + back

        elements = [
            tuple(number(n + i, outer, back) for outer in (0, 1) for i, back in ((0, 0), (1, 0), (1, 1), (0, 1)))
            for n in range(self.around)
        ]
        parts.parts.append(Part("cam", "cam", "hex8", elements))
        parts.surfaces["cam"] = [tuple(ids[a] for a in FACES[1]) for ids in elements]


def _add_follower(parts: Parts) -> None:
    """Add a plate that rests on the cam and the block above it, which share nodes."""
    level = profile(0.0)
    parts.box("follower", (-0.8, -0.1, level), (0.8, WIDTH + 0.1, level + 0.8), (8, 2, 4), "follower")
    whole = parts.parts.pop()

    def is_plate(ids: tuple[int, ...]) -> bool:
        return max(parts.nodes[n - 1][2] for n in ids) < level + 0.3

    for name, of_plate in (("follower", True), ("spring", False)):
        parts.parts.append(Part(name, name, "hex8", [ids for ids in whole.elements if is_plate(ids) == of_plate]))


def _held(body: str, dofs: str) -> str:
    """Translations x, y, z and rotations u, v, w of a rigid body that are zero."""
    inner = "".join(f"<R{dof}_dof>1</R{dof}_dof>" for dof in dofs)
    return f'<rigid_bc name="{body} held" type="rigid_fixed"><rb>{body}</rb>{inner}</rigid_bc>'
