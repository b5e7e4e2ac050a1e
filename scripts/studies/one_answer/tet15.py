"""Tetrahedra of 15 nodes in place of those of 10: a node more in the middle of each face and element."""

import numpy as np
from lxml import etree

from studies.feb import Feb, only
from studies.models.quadratic import Middles

FACES = ((0, 1, 2), (0, 1, 3), (1, 2, 3), (2, 0, 3))
"""Corners of the faces, in the order in which FEBio has their nodes after those of the edges."""


def _numbers(text: str | None) -> list[int]:
    return [int(number) for number in (text or "").split(",")]


def with_tet15(model: Feb) -> Feb:
    """The same model with tetrahedra of 15 nodes in place of those of 10."""
    made = model.copy()
    mesh = only(made.root, "Mesh")
    nodes = only(mesh, "Nodes")
    middle = Middles(np.array([[float(value) for value in (node.text or "").split(",")] for node in nodes]))
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
        nodes_of.text = ",".join(map(str, middle.grown(_numbers(nodes_of.text))))
    for number, position in enumerate(middle.positions[len(nodes) :], len(nodes) + 1):
        etree.SubElement(nodes, "node", id=str(number)).text = ",".join(f"{value:.12g}" for value in position)
    return made
