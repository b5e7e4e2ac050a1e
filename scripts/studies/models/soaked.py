"""The bodies of problem 3.3 at rest and apart, each at ambient values on the face that would be in contact."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from harness.models.document import Model
from harness.models.indentation import CONCENTRATION, Indentation
from harness.models.interface import InterfaceType, header
from harness.models.parts import GAS_CONSTANT, TEMPERATURE, concentration, fix, initial_concentration, initial_pressure
from harness.models.parts import pressure as prescribed_pressure

ABOUT = """\
The bodies of problem 3.3 by themselves: undeformed and without contact, with the same meshes, materials and time
steps. The slab is at 1 mM with 0 mM on its top, the cylinder at 0 mM with 1 mM on its arc."""


def soaked(base: Indentation) -> Model:
    """The bodies of `base`, without contact and at rest: the front that its meshes and time steps make alone."""
    made = base.model()
    osmotic = GAS_CONSTANT * TEMPERATURE * base.gel.osmotic
    mesh = made.mesh
    faces = {f"{body}-face": np.unique(mesh.surfaces[f"{body}-contact"]) for body in ("slab", "cylinder")}
    conditions = (
        fix("all", "xyz"),
        concentration("slab-face", 0.0),
        prescribed_pressure("slab-face", 0.0),
        concentration("cylinder-face", CONCENTRATION),
        prescribed_pressure("cylinder-face", -osmotic * CONCENTRATION),
        initial_concentration("slab", CONCENTRATION),
        initial_pressure("slab", -osmotic * CONCENTRATION),
    )
    name = f"{base.name}-soaked"
    bare = replace(mesh, node_sets={**mesh.node_sets, **faces}, surfaces={}, pairs={})
    return replace(
        made,
        name=name,
        header=header(name, ABOUT, InterfaceType.CONFORMING),
        mesh=bare,
        conditions=conditions,
        contacts=(),
    )
