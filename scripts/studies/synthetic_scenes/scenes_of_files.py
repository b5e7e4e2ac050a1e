"""Scenes of what model files hold beside bodies and loads: solvers, steps, sets, included files, loads, friction."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from studies import feb
from studies.synthetic_scenes import edits
from studies.synthetic_scenes.collection_of_scenes import SCENES as BODIES
from studies.synthetic_scenes.collection_of_scenes import Scene
from studies.synthetic_scenes.edits import Edit


@dataclass(frozen=True)
class Edited:
    """A scene whose file is changed after it is written."""

    about: str
    """What it stands for."""
    scene: Scene
    edit: Edit

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` into `folder`, and return its path."""
        made = feb.read(self.scene.write(name, folder))
        self.edit(made.root, folder)
        return made.write(folder)


def _edited(about: str, scene: str, edit: Callable[..., None], *given: object) -> Edited:
    return Edited(about, BODIES[scene], partial(edit, *given))


_RUBS = {
    "elements-hex8": 0.2,
    "elements-hex20": 0.2,
    "elements-tet4": 0.2,
    "elements-tet10": 0.2,
    "material-Mooney-Rivlin": 0.1,
    "sphere": 0.3,
    "flat": 0.2,
    "sliding": 0.2,
    "sliding-tet10": 0.1,
    "rigid-block-slides": 0.3,
    "rigid-free": 0.2,
    "stiff-on-soft": 0.2,
    "pressure-load": 0.2,
    "augmented": 0.2,
    "dynamic": 0.2,
    "biphasic": 0.2,
    "biphasic-sliding": 0.1,
    "biphasic-tet4": 0.2,
    "multiphasic": 0.2,
}
"""Friction coefficient of each scene."""
SCENES: Mapping[str, Edited] = {
    "quasi-newton": _edited("10 updates of BFGS between matrices", "elements-hex8", edits.updates, "BFGS", 10),
    "quasi-newton-tet4": _edited("10 updates of BFGS, tetrahedra", "elements-tet4", edits.updates, "BFGS", 10),
    "quasi-newton-biphasic": _edited("10 updates of BFGS, biphasic", "biphasic", edits.updates, "BFGS", 10),
    "broyden": _edited("10 updates of Broyden", "elements-hex8", edits.updates, "Broyden", 10),
    "broyden-biphasic": _edited("10 updates of Broyden, biphasic", "biphasic", edits.updates, "Broyden", 10),
    "symmetric": _edited("symmetric matrix", "elements-hex8", edits.solver, {"symmetric_stiffness": "symmetric"}),
    "explicit": _edited("explicit dynamics", "elements-hex8", edits.explicit_dynamics, 500),
    "explicit-finer": _edited("explicit dynamics, twice as fine", "finer", edits.explicit_dynamics, 1000),
    "explicit-tet4": _edited("explicit dynamics, tetrahedra", "elements-tet4", edits.explicit_dynamics, 2000),
    "no-line-search": _edited("without a line search", "elements-hex8", edits.solver, {"lstol": "0"}),
    "begins-with-a-step": _edited("contact from the second analysis step on", "flat", edits.two_steps, (2,)),
    "ends-with-a-step": _edited("contact in the first analysis step alone", "elements-hex8", edits.two_steps, (1,)),
    "two-steps": _edited("contact in both of two analysis steps", "biphasic", edits.two_steps, (1, 2)),
    "mesh-from-a-file": _edited("the mesh in an included file", "elements-hex8", edits.mesh_from_file),
    "part-lists": _edited("conditions on part lists and surfaces", "multiphasic", edits.by_part_lists),
    "pressure-on-the-contact": _edited(
        "pressure prescribed on the slab's contact surface", "biphasic", edits.pressure_on_the_contact
    ),
    "body-force": _edited("bodies under their weight", "elements-hex8", edits.body_force),
    "penalty-with-a-curve": _edited("a penalty that rises", "elements-hex8", edits.penalty_follows_a_curve),
    "both-ways": _edited("two contacts with exchanged surfaces", "elements-hex8", edits.both_ways),
    "must-points": _edited("steps that follow a load curve", "elements-hex8", edits.must_points),
    "search-radius": _edited("a small search radius", "elements-hex8", edits.in_contact, {"search_radius": "0.2"}),
    "segment-updates": _edited("pairs of facets kept after two updates", "sliding", edits.in_contact, {"seg_up": "2"}),
    "node-reloc": _edited(
        "nodes moved onto the other surface at the start",
        "type-sliding-node-on-facet",
        edits.in_contact,
        {"node_reloc": "1"},
    ),
    "update-penalty": _edited(
        "a penalty that follows the deformation", "rigid-free", edits.in_contact, {"update_penalty": "1"}
    ),
}
RUBBING: Mapping[str, Edited] = {
    f"friction-{name}": _edited(
        f"{BODIES[name].about}, friction {mu:g}", name, edits.in_contact, {"fric_coeff": f"{mu:g}"}
    )
    for name, mu in _RUBS.items()
}
