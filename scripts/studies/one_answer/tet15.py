"""Tetrahedra of 15 nodes in place of those of 10: a node more in the middle of each face and element."""

from collections.abc import Sequence

import numpy as np
from lxml import etree

from studies.feb import Element, Feb, only

FACES = ((0, 1, 2), (0, 1, 3), (1, 2, 3), (2, 0, 3))
"""Corners of the faces, in the order in which FEBio has their nodes after those of the edges."""


def _numbers(text: str | None) -> list[int]:
    return [int(number) for number in (text or "").split(",")]


class _Middles:
    """Nodes in the middle of corners, each made once."""

    def __init__(self, nodes: Element) -> None:
        self.nodes = nodes
        self.place = {int(n.get("id", "0")): np.array([float(v) for v in (n.text or "").split(",")]) for n in nodes}
        self.of: dict[frozenset[int], int] = {}

    def __call__(self, corners: Sequence[int]) -> int:
        key = frozenset(corners)
        if key not in self.of:
            number = self.of[key] = len(self.place) + 1
            self.place[number] = np.mean([self.place[corner] for corner in corners], axis=0)
            made = etree.SubElement(self.nodes, "node", id=str(number))
            made.text = ",".join(f"{value:.12g}" for value in self.place[number])
        return self.of[key]


def with_tet15(model: Feb) -> Feb:
    """The same model with tetrahedra of 15 nodes in place of those of 10."""
    made = model.copy()
    mesh = only(made.root, "Mesh")
    middle = _Middles(only(mesh, "Nodes"))
    for group in mesh.iter("Elements"):
        group.set("type", "tet15")
        for element in group:
            ids = _numbers(element.text)
            faces = [middle([ids[corner] for corner in face]) for face in FACES]
            element.text = ",".join(map(str, [*ids, *faces, middle(ids[:4])]))
    for facet in list(mesh.iter("tri6")):
        ids = _numbers(facet.text)
        facet.tag = "tri7"
        facet.text = ",".join(map(str, [*ids, middle(ids[:3])]))
    for nodes_of in mesh.iter("NodeSet"):
        own = set(_numbers(nodes_of.text))
        own |= {number for corners, number in middle.of.items() if corners <= own}
        nodes_of.text = ",".join(map(str, sorted(own)))
    return made
