"""Three bodies that share nodes of a contact surface, and a body that a load brings into contact."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from harness.arrays import Ids
from harness.models.document import Model
from harness.models.mesh import Box, Layer, Mesh, Part, assemble, conforming_column
from harness.models.parts import Curve, Solid, displace, fix, normal_load
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from studies.hard_cases.press import HOLD, RAMP, ambient_at, stress, stretches
from studies.hard_cases.scene import GEL, Fineness, Interface, finished, timed

SHORTENING = 0.05  # of a block and the slab of `Seesaw`, mm
GAP, LOAD = 0.02, 0.03  # of `Dropped`, mm and MPa
CUSHION = Solid(0.01)  # the regularisation of `Dropped`: 1 mm of it


@dataclass(frozen=True)
class Seesaw:
    """A slab under two blocks, each with a contact of its own; the two contacts share the nodes of the middle."""

    left: tuple[tuple[float, float], ...]
    right: tuple[tuple[float, float], ...]
    """Way of the tops of the blocks over time (s): 1 shortens a block and the slab by `SHORTENING`, below 0 is open."""
    name: str = "seesaw"

    def model(self, mesh: Fineness, interface: Interface) -> Model:
        """The model, laterally confined."""
        made = self._mesh(mesh)
        control, steps = timed((*RAMP, *HOLD), 3)
        conditions = (
            fix("all", "xy"),
            fix("slab-bottom", "z"),
            displace("left-top", "z", -SHORTENING, 1),
            displace("right-top", "z", -SHORTENING, 2),
            *ambient_at("slab-bottom", (1.0,)),
            *ambient_at("left-top", (0.0,)),
            *ambient_at("right-top", (0.0,)),
        )
        curves = (Curve(self.left), Curve(self.right), steps)
        about = (self.name, f"Hard case {self.name}: two blocks on one slab.", "multiphasic")
        model = Model(*about, made, {"gel": GEL}, conditions, control, interface.contacts(made), curves)
        return finished(model, interface)

    def _mesh(self, mesh: Fineness) -> Mesh:
        n, thick = (1, 3) if mesh is Fineness.COARSE else (2, 5)
        made = assemble(
            [
                Box("slab", "gel", (0.0, 0.0, 0.0), (2.0, 1.0, 1.0), (2, 1, thick)),
                Box("left", "gel", (0.0, 0.0, 1.0), (1.0, 1.0, 1.0), (n, n, thick)),
                Box("right", "gel", (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (n, n, thick)),
            ]
        )
        return two_patches(made, "slab-top", ("left-bottom", "right-bottom"))

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """Force of both blocks at the end: that of the closed form where both press, else none on the open one."""
        exact = -stress(GEL.solid, stretches(GEL.solid, GEL.solid, SHORTENING)[0])
        measures = []
        for name, path in (("left", self.left), ("right", self.right)):
            top = run.model.mesh.node_sets[f"{name}-top"] - 1
            force = float(run.nodes["Rz"][-1, top].sum()) / exact
            if path[-1][1] < 0.0:
                measures.append(Measure(f"force on the open {name} block, relative", abs(force), 1e-6))
            elif self.left == self.right:
                measures.append(Measure(f"force on the {name} block, relative error", abs(force - 1.0), 2e-3))
            else:  # the slab beside it, which is not loaded, helps to carry
                measures.append(Measure(f"force on the {name} block, relative", force, 2.0, lowest=1.0))
        return measures


@dataclass(frozen=True)
class Dropped:
    """A block that a load alone moves; until it touches, a soft cushion between it and a ceiling holds it."""

    name: str = "dropped"

    def model(self, mesh: Fineness, interface: Interface) -> Model:
        """The model, laterally confined."""
        made = self._mesh(mesh)
        control, steps = timed((*RAMP, *HOLD), 2)
        conditions = (
            fix("all", "xy"),
            fix("lower-bottom", "z"),
            fix("ceiling", "z"),
            *ambient_at("lower-bottom", (1.0,)),
            *ambient_at("ceiling", (0.0,)),
            normal_load("loaded", LOAD, 1),
        )
        materials = {"gel": GEL, "cushion": replace(GEL, solid=CUSHION)}
        curves = (Curve(((0.0, 0.0), (RAMP[-1], 1.0))), steps)
        about = (self.name, f"Hard case {self.name}: a block that a load moves.", "multiphasic")
        model = Model(*about, made, materials, conditions, control, interface.contacts(made), curves)
        return finished(model, interface)

    def _mesh(self, mesh: Fineness) -> Mesh:
        thick = 3 if mesh is Fineness.COARSE else 5
        below = assemble([Box("lower", "gel", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (1, 1, thick))])
        layers = [Layer("upper", "gel", 1.0, thick), Layer("cushion", "cushion", 1.0, thick)]
        above = conforming_column(layers, bottom=1.0 + GAP)
        offset = len(below.nodes)
        shifted = tuple(Part(part.name, part.material, part.elements + offset) for part in above.parts)
        sets = {"all": np.arange(1, offset + len(above.nodes) + 1), "lower-bottom": below.node_sets["lower-bottom"]}
        surfaces = {
            "lower-top": below.surfaces["lower-top"],
            "upper-bottom": above.surfaces["bottom"] + offset,
            "loaded": shifted[0].elements[-1:, 4:],
        }
        return Mesh(
            np.concatenate([below.nodes, above.nodes]),
            (*below.parts, *shifted),
            sets | {"ceiling": above.node_sets["top"] + offset},
            surfaces,
            {"lower/upper": ("lower-top", "upper-bottom")},
        )

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """Way of the loaded nodes: both blocks under compression and the cushion under tension carry the load."""

        def balance(shortening: float) -> float:
            pressed = stress(GEL.solid, stretches(GEL.solid, GEL.solid, shortening)[0])
            return LOAD + pressed - stress(CUSHION, 1.0 + GAP + shortening)

        exact = GAP + float(brentq(balance, 1e-9, 0.5))
        loaded = np.unique(run.model.mesh.surfaces["loaded"]) - 1
        way = -run.nodes["uz"][-1, loaded]
        return [Measure("way of the block, relative error", float(np.max(np.abs(way / exact - 1.0))), 2e-3)]


def two_patches(mesh: Mesh, primary: str, secondaries: tuple[str, str]) -> Mesh:
    """Cut the two facets of `primary` into surfaces of their own, each facing one of `secondaries`."""
    first, second = (mesh.surfaces[primary][k : k + 1] for k in range(2))
    patches: dict[str, Ids] = {"patch-1": first, "patch-2": second}
    pairs = {f"pair-{k + 1}": (f"patch-{k + 1}", secondaries[k]) for k in range(2)}
    return replace(mesh, surfaces=mesh.surfaces | patches, pairs=pairs)
