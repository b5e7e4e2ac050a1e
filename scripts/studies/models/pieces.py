"""Pieces of the models of studies."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from harness.arrays import Array
from harness.models.interface import ContactSettings, InterfaceType, default_settings
from harness.models.mesh import Mesh
from harness.models.parts import Condition, Control, Curve, Param, TimeStepper, displace

Motion = Callable[[Array, float], Array]
"""Displacements (n, 3) of nodes at reference positions (n, 3) at a time (s), mm."""
PREDICTOR = Param("predictor", True)  # turns the plugin's predictor on


UNCLAMPED = (Param("force_positive_concentrations", False),)
"""Of the solver `multiphasic`: concentrations may undershoot; the solver `solute` always sets negative ones to zero."""


def hold(where: str, axes: str) -> tuple[Condition, ...]:
    """As `fix`, but as prescribed displacements of zero: of these alone FEBio logs the reactions."""
    return tuple(displace(where, axis, 0.0) for axis in axes)


def move_rigid(material: str, axis: str, value: float, curve: int | None = None) -> Condition:
    """Prescribe the displacement (mm) of a rigid body along one axis."""
    params = (Param("dof", axis), Param("value", value, curve), Param("relative", False))
    return Condition("rigid_bc", "rigid_displacement", material, params)


def ambient(pressure: float, concentration: float, curve: int | None = None) -> tuple[Param, ...]:
    """Ambient values of what is not in contact: effective pressure p~ (MPa) and effective concentration c~ (mM)."""
    return (Param("ambient_pressure", pressure, curve), Param("ambient_concentration", concentration, curve))


def with_friction(
    interface: InterfaceType, coefficient: float, *, solid_fraction: float | None = None
) -> ContactSettings:
    """The default settings with a friction coefficient mu_eq and, between porous bodies, the solid fraction phi."""
    given = default_settings(interface)
    fraction = () if solid_fraction is None else (Param("contact_frac", solid_fraction),)
    return replace(given, extra=(*given.extra, Param("fric_coeff", coefficient), *fraction))


def timed(times: Sequence[float], curve: int, **given: Any) -> tuple[Control, Curve]:
    """Time steps that end at `times` (s), and the load curve, of number `curve`, that makes them; cut back at need."""
    stepper = TimeStepper(0.0, retries=8, optimal_iterations=15, must_points=curve, aggressive=True, force=True)
    control = Control(len(times), times[0], stepper=stepper, end=times[-1], **given)
    return control, Curve(tuple((float(t), float(times[-1])) for t in times), "STEP")


def driven(
    mesh: Mesh, times: Sequence[float], motion: Motion, axes: str = "xyz"
) -> tuple[Mesh, list[Condition], tuple[Curve, ...]]:
    """Move each node of the set ``grip`` along load curves of its own, which begin at 0 s; each has a node set."""
    nodes = mesh.node_sets["grip"]
    way = np.stack([motion(mesh.nodes[nodes - 1], time) for time in (0.0, *times)])
    conditions, curves = [], []
    for place, number in enumerate(nodes.tolist()):
        for axis in axes:
            points = zip((0.0, *times), way[:, place, "xyz".index(axis)].tolist(), strict=True)
            curves.append(Curve(tuple(points)))
            conditions.append(displace(f"grip-{number}", axis, 1.0, len(curves)))
    grip = {f"grip-{number}": np.array([number]) for number in nodes.tolist()}
    return replace(mesh, node_sets=mesh.node_sets | grip), conditions, tuple(curves)
