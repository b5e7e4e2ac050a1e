"""Pieces of the models of studies."""

from __future__ import annotations

from dataclasses import dataclass, replace

from harness.models.interface import ContactSettings, InterfaceType, default_settings
from harness.models.parts import Condition, Param, displace

PREDICTOR = Param("predictor", True)
"""Turns the plugin's predictor on."""


@dataclass(frozen=True)
class Solver:
    """A module of FEBio for models with solutes, and further parameters of its solver."""

    module: str
    solver: tuple[Param, ...] = ()


UNCLAMPED = Solver("multiphasic", (Param("force_positive_concentrations", False),))
"""Concentrations may undershoot; FEBio's module 'solute' always sets negative ones to zero."""


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
