"""The contact types that `check` and `convert` know, and the parameters that each of them has in FEBio 4.11."""

from __future__ import annotations

from dataclasses import dataclass

from harness.preflight.plugin_types import PLUGIN_TYPES

MIXTURE = "sliding-mixture"
TIED = "tied-mixture"
STICKY = "sticky"
"""FEBio's type that ties what touches, and lets it go at a tension."""

_COMMON = ("laugon", "tolerance", "gaptol", "penalty", "auto_penalty", "update_penalty", "two_pass", "knmult")
_SEARCH = ("search_tol", "search_radius", "seg_up", "minaug", "maxaug", "node_reloc", "smooth_aug")
_HIDDEN = ("penalty_sf", "max_penalty_sf")
_SOLVENT = ("ptol", "pressure_penalty")
_SOLUTE = ("ctol", "concentration_penalty", "ambient_pressure", "ambient_concentration")
_FRICTION = ("fric_coeff", "contact_frac", "smooth_fls")
_SHELLS = ("flip_primary", "flip_secondary", "shell_bottom_primary", "shell_bottom_secondary")
_BASE = (*_COMMON, *_SEARCH, *_HIDDEN)


@dataclass(frozen=True)
class ContactType:
    """A contact type of FEBio's, or this plugin's.

    Attributes
    ----------
    name : str
        The attribute `type` in a model file.
    home : str
        FEBio's module that brings it; empty where every module has it.
    parameters : frozenset of str
        Its parameters, the hidden ones too.
    solvent, solutes : bool
        Whether it exchanges them.
    """

    name: str
    home: str
    parameters: frozenset[str]
    solvent: bool = False
    solutes: bool = False

    @property
    def is_mixture(self) -> bool:
        """Whether it is this plugin's."""
        return self.name in (MIXTURE, TIED)

    @property
    def is_tie(self) -> bool:
        """Whether it joins bodies."""
        return self.name.startswith("tied") or self.name == STICKY

    @property
    def modules(self) -> tuple[str, ...]:
        """FEBio's modules in which it works: those that include its home; contact moves nodes, so they have a solid."""
        return tuple(name for name, included in MODULES.items() if {"solid", self.home or "solid"} <= included)


_SOLID = frozenset({"solid"})
_BIPHASIC = _SOLID | {"biphasic"}
_SOLUTE_MODULE = _BIPHASIC | {"solute"}
_MULTIPHASIC = _SOLUTE_MODULE | {"multiphasic"}
_FLUID = frozenset({"fluid"})

MODULES = {
    "solid": _SOLID,
    "explicit-solid": _SOLID,
    "CG-solid": _SOLID,
    "biphasic": _BIPHASIC,
    "solute": _SOLUTE_MODULE,
    "multiphasic": _MULTIPHASIC,
    "fluid": _FLUID,
    "fluid-FSI": _FLUID | _BIPHASIC,
    "fluid-solutes": _FLUID | _MULTIPHASIC,
    "multiphasic-FSI": _FLUID | _MULTIPHASIC,
    "thermo-fluid": _FLUID,
    "polar fluid": _FLUID,
}
"""FEBio's modules, and those whose classes each of them has."""


def _of_plugin(name: str) -> frozenset[str]:
    """Parameters of one of the plugin's types; FEBio gives every sliding contact the hidden ones."""
    return frozenset([parameter.name for parameter in PLUGIN_TYPES[name]]).union(_HIDDEN)


def _febio(name: str, home: str, *more: str, solvent: bool = False, solutes: bool = False) -> ContactType:
    return ContactType(name, home, frozenset((*_BASE, "symmetric_stiffness", *more)), solvent, solutes)


UNLIMITED_SEARCH = ("sliding-facet-on-facet", "sliding-node-on-facet")
"""The types whose search has no limit where the radius is 0, which is their default."""
_NODE_ON_FACET = (set(_BASE) - {"smooth_aug"}) | {"fric_coeff", "fric_penalty", "ktmult"}
_FACET_ON_FACET = set(_BASE) | {"dxtol", "fric_coeff", "fric_penalty"}

TYPES = {
    known.name: known
    for known in (
        ContactType(MIXTURE, "", _of_plugin(MIXTURE), solvent=True, solutes=True),
        _febio("sliding-elastic", "solid", *_SHELLS, "tension", "offset", "fric_coeff"),
        _febio("sliding-biphasic", "biphasic", *_SOLVENT, *_FRICTION, *_SHELLS, solvent=True),
        _febio("sliding-biphasic-mixed", "biphasic", *_SOLVENT, *_FRICTION, *_SHELLS, solvent=True),
        _febio("sliding2", "biphasic", *_SOLVENT, "dual_proj", solvent=True),
        _febio("sliding-biphasic-solute", "solute", *_SOLVENT, *_SOLUTE, solvent=True, solutes=True),
        _febio("sliding-multiphasic", "multiphasic", *_SOLVENT, *_SOLUTE, *_FRICTION, solvent=True, solutes=True),
        ContactType("sliding-node-on-facet", "solid", frozenset(_NODE_ON_FACET)),
        ContactType("sliding-facet-on-facet", "solid", frozenset(_FACET_ON_FACET)),
    )
}
"""Every sliding type, by its name in a model file."""

CONVERTIBLE = (
    "sliding-elastic",
    "sliding-biphasic",
    "sliding-biphasic-mixed",
    "sliding2",
    "sliding-biphasic-solute",
    "sliding-multiphasic",
    "sliding-facet-on-facet",
    "sliding-node-on-facet",
)
"""The types of FEBio's that `sliding-mixture` takes the place of."""
