"""A plane problem with a smooth, curved solution across a contact whose facets do not match.

With Poisson's ratio 0 and small strains, u = grad(phi) of a harmonic phi is a state of equilibrium without body force.
phi = A cosh(k z) cos(k x) leaves the plane z = 0 flat and without shear, as a contact without friction does, and a
uniform compression keeps it closed. A harmonic c~ with p~ = -R T c~ is a steady state without flow of solvent (d = d0).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from harness.models import blocks
from harness.models.diffusion import MATERIAL
from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.mesh import Mesh, Part
from harness.models.parts import GAS_CONSTANT, TEMPERATURE, Condition, Param, fix
from scenes.nonmatching import STEADY
from studies.models.quadratic import quadratic
from studies.models.tetrahedra import tetrahedra

Array = NDArray[np.float64]

WAVE = 2.0
"""k, 1/mm."""
COMPRESSION = 1e-6
"""Uniform compression along z: so small that the solid is linear."""
AMPLITUDE = 0.05 * COMPRESSION
"""A, mm^2."""
NEAR = 1e-9
"""Tolerance for positions, mm."""
EXACT = {
    "ux": f"{-AMPLITUDE * WAVE!r}*cosh({WAVE!r}*Z)*sin({WAVE!r}*X)",
    "uz": f"{AMPLITUDE * WAVE!r}*sinh({WAVE!r}*Z)*cos({WAVE!r}*X)-{COMPRESSION!r}*Z",
    "c1": f"0.5+0.05*exp({WAVE!r}*Z)*cos({WAVE!r}*X)",
}
"""The solution as FEBio reads it, in the undeformed position."""
ABOUT = """\
A smooth, curved solution across two blocks whose facets do not match, in contact at z = 0: displacement and
concentration are given on all other faces, where they equal those of the closed form."""


@dataclass(frozen=True)
class Harmonic:
    """Choices of this problem.

    Attributes
    ----------
    level : int
        The lower block has 2 `level` x 2 `level` elements, the upper one 3 `level` x 2 `level`.
    nodes : int
        Of an element: 8 or 20 of a hexahedron, 10 of a tetrahedron, of which a hexahedron has six.
    settings : ContactSettings, optional
    name : str
    """

    level: int
    nodes: int = 8
    settings: ContactSettings | None = None
    interface: InterfaceType = InterfaceType.MIXTURE
    name: str = "harmonic"

    def model(self) -> Model:
        """The model of these choices."""
        mesh = self._mesh()
        return Model(
            self.name,
            header(self.name, ABOUT, self.interface),
            "multiphasic",
            mesh,
            {"gel": MATERIAL},
            _conditions(),
            STEADY,
            contacts(self.interface, mesh, self.settings),
        )

    def _mesh(self) -> Mesh:
        bodies = [self._block(-1.0, 2 * self.level), self._block(0.0, 3 * self.level)]
        offset = len(bodies[0].nodes)
        nodes = np.concatenate([body.nodes for body in bodies])
        faces = [blocks.facets_where(body, lambda x: np.abs(x[..., 2]) < NEAR) + 1 for body in bodies]
        parts = (Part("lower", "gel", bodies[0].elements + 1), Part("upper", "gel", bodies[1].elements + offset + 1))
        surfaces = {"lower-top": faces[0], "upper-bottom": faces[1] + offset}
        mesh = Mesh(nodes, parts, {}, surfaces, {"contact": ("upper-bottom", "lower-top")})
        return _with_sets(quadratic(mesh, 20) if self.nodes in (10, 20) else mesh)

    def _block(self, bottom: float, across: int) -> blocks.Body:
        lines = (np.linspace(0.0, 1.0, across + 1), np.linspace(0.0, 0.5, 2))
        height = np.linspace(bottom, bottom + 1.0, 2 * self.level + 1)
        body = blocks.structured(np.stack(np.meshgrid(*lines, height, indexing="ij"), axis=-1))
        return tetrahedra(body) if self.nodes == 10 else body


def _with_sets(mesh: Mesh) -> Mesh:
    """The mesh with the sets of all nodes and of those on the outer faces."""
    outer = (np.abs(mesh.nodes[:, 0] - 0.5) > 0.5 - NEAR) | (np.abs(mesh.nodes[:, 2]) > 1.0 - NEAR)
    number = np.arange(1, len(mesh.nodes) + 1, dtype=np.int64)
    return replace(mesh, node_sets={"all": number, "outer": number[outer]})


def _conditions() -> tuple[Condition, ...]:
    def given(kind: str, value: str, *params: Param) -> Condition:
        field = Param("value", value, attributes={"type": "math"})
        return Condition("bc", kind, "outer", (*params, field, Param("relative", False)))

    osmotic = f"{-GAS_CONSTANT * TEMPERATURE!r}*({EXACT['c1']})"
    return (
        fix("all", "y"),
        given("prescribed displacement", EXACT["ux"], Param("dof", "x")),
        given("prescribed displacement", EXACT["uz"], Param("dof", "z")),
        given("prescribed concentration", EXACT["c1"], Param("dof", "c1")),
        given("prescribed fluid pressure", osmotic),
    )
