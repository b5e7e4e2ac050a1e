"""Two nearly incompressible blocks with free sides, pressed together at once: undrained first, drained in the end."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from harness.models.document import Model
from harness.models.mesh import Box, Mesh, assemble
from harness.models.parts import Curve, Solid, displace, fix
from harness.post.compare import Measure
from harness.run.runner import Runner, RunResult
from studies.hard_cases.press import ambient_at
from studies.hard_cases.scene import GEL, NEWTON, Fineness, Interface, finished, timed

SOLID = Solid(1.0, 0.49)
SHORTENING = 0.1  # of both blocks, mm
TIMES = (2e-3, *(2e-3 * 10.0 ** (k / 2) for k in range(1, 17)))  # ends of the time steps, s
OVERLAP = 2.0**-10
"""mm at the start: surfaces that touch without one may count as open or closed, which the pressure depends on."""


def drained(solid: Solid, stretch: float) -> float:
    """Nominal stress (MPa) of FEBio's neo-Hookean solid under uniaxial stress: its sides are free.

    With J = s q^2: sigma_t = [mu (q^2 - 1) + lambda ln J]/J = 0 gives q; P = [mu (s^2 - 1) + lambda ln J]/J q^2.
    """
    shear = solid.modulus / (2.0 * (1.0 + solid.poisson))
    lame = solid.modulus * solid.poisson / ((1.0 + solid.poisson) * (1.0 - 2.0 * solid.poisson))

    def sideways(q: float) -> float:
        return float(shear * (q**2 - 1.0) + lame * np.log(stretch * q**2))

    q = brentq(sideways, 0.5, 2.0, xtol=1e-15, rtol=1e-14)
    return float((shear * (stretch**2 - 1.0) + lame * np.log(stretch * q**2)) / (stretch * q**2) * q**2)


@dataclass(frozen=True)
class Uniaxial:
    """A quarter of two blocks of 1 mm with lubricated ends, shortened within a millionth of the diffusion time."""

    name: str = "uniaxial"

    def model(self, mesh: Fineness, interface: Interface) -> Model:
        """The model; sides and ends are impermeable to the solute, which is nowhere, and the ends drain."""
        made = self._mesh(mesh)
        control, steps = timed(TIMES, 2, 1e-3 * NEWTON)
        conditions = (
            fix("x0", "x"),
            fix("y0", "y"),
            fix("lower-bottom", "z"),
            displace("upper-top", "z", OVERLAP - SHORTENING, 1),
            *ambient_at("lower-bottom", (0.0,)),
            *ambient_at("upper-top", (0.0,)),
        )
        load = Curve(((0.0, 0.0), (TIMES[0], 1.0)))
        gel = replace(GEL, solid=SOLID)
        text = f"Hard case {self.name}: two nearly incompressible blocks, pressed together at once."
        about, joined = (self.name, text, "multiphasic"), interface.contacts(made)
        return finished(Model(*about, made, {"gel": gel}, conditions, control, joined, (load, steps)), interface)

    def _mesh(self, mesh: Fineness) -> Mesh:
        below, above = ((2, 2, 4), (2, 2, 4)) if mesh is Fineness.COARSE else ((4, 4, 8), (2, 2, 4))
        unit = (1.0, 1.0, 1.0)
        made = assemble(
            [
                Box("lower", "gel", (0.0, 0.0, 0.0), unit, below),
                Box("upper", "gel", (0.0, 0.0, 1.0 - OVERLAP), unit, above),
            ]
        )
        planes = {f"{axis}0": 1 + np.flatnonzero(made.nodes[:, k] < 1e-9) for k, axis in enumerate("xy")}
        pairs = {"lower/upper": ("lower-top", "upper-bottom")}
        return replace(made, node_sets=made.node_sets | planes, pairs=pairs)

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """Force at the end against uniaxial stress, and that the undrained blocks were stiffer."""
        top = run.model.mesh.node_sets["upper-top"] - 1
        force = run.nodes["Rz"][:, top].sum(axis=1)
        exact = -drained(SOLID, 1.0 - SHORTENING / 2.0)
        return [
            Measure("force at the end, relative error", abs(float(force[-1]) / exact - 1.0), 5e-3),
            Measure("force at the end over the first, both pressing", float(force[-1] / force[1]), 1.0, lowest=0.1),
        ]
