"""The contact types that `check` and `convert` know, and the parameters that each of them has in FEBio 4.11."""

from dataclasses import dataclass

from harness.preflight.plugin_types import PLUGIN_TYPES

MIXTURE = "sliding-mixture"
TIED = "tied-mixture"
STICKY = "sticky"  # FEBio's type that ties what touches, and lets it go at a tension

_COMMON = ("laugon", "tolerance", "gaptol", "penalty", "auto_penalty", "update_penalty", "two_pass", "knmult")
_SEARCH = ("search_tol", "search_radius", "seg_up", "minaug", "maxaug", "node_reloc", "smooth_aug")
_HIDDEN = ("penalty_sf", "max_penalty_sf")
_SOLVENT = ("ptol", "pressure_penalty")
_SOLUTE = ("ctol", "concentration_penalty")
_FRICTION = ("fric_coeff", "contact_frac", "smooth_fls")
_SHELLS = ("flip_primary", "flip_secondary", "shell_bottom_primary", "shell_bottom_secondary")
_BASE = (*_COMMON, *_SEARCH, *_HIDDEN)
_SLIDING = (*_BASE, "symmetric_stiffness")


@dataclass(frozen=True)
class ContactType:
    """A contact type of FEBio's, or this plugin's."""

    name: str  # the attribute `type` in a model file
    home: str  # FEBio's module that brings it; empty where every module has it
    parameters: frozenset[str]  # its parameters, the hidden ones too

    @property
    def solvent(self) -> bool:
        """Whether it exchanges solvent."""
        return "pressure_penalty" in self.parameters

    @property
    def solutes(self) -> bool:
        """Whether it exchanges solutes."""
        return "concentration_penalty" in self.parameters

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


def _type(name: str, home: str, *parameters: str) -> ContactType:
    return ContactType(name, home, frozenset(parameters))


UNLIMITED_SEARCH = ("sliding-facet-on-facet", "sliding-node-on-facet")
"""The types whose search has no limit where the radius is 0, which is their default."""
_NODE_ON_FACET = (set(_BASE) - {"smooth_aug"}) | {"fric_coeff", "fric_penalty", "ktmult"}

_CONVECTIVE = (*_SLIDING, *_SOLVENT, *_SOLUTE, "ambient_pressure", "ambient_concentration")

TYPES = {
    known.name: known
    for known in (
        _type(MIXTURE, "", *(parameter.name for parameter in PLUGIN_TYPES[MIXTURE]), *_HIDDEN),
        _type("sliding-elastic", "solid", *_SLIDING, *_SHELLS, "tension", "offset", "fric_coeff"),
        _type("sliding-biphasic", "biphasic", *_SLIDING, *_SOLVENT, *_FRICTION, *_SHELLS),
        _type("sliding-biphasic-mixed", "biphasic", *_SLIDING, *_SOLVENT, *_FRICTION, *_SHELLS),
        _type("sliding2", "biphasic", *_SLIDING, *_SOLVENT, "dual_proj"),
        _type("sliding-biphasic-solute", "solute", *_CONVECTIVE),
        _type("sliding-multiphasic", "multiphasic", *_CONVECTIVE, *_FRICTION),
        _type("sliding-node-on-facet", "solid", *_NODE_ON_FACET),
        _type("sliding-facet-on-facet", "solid", *_BASE, "dxtol", "fric_coeff", "fric_penalty"),
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

_ENFORCED = ("laugon", "tolerance", "penalty", "minaug", "maxaug")
_AUTOMATIC = (*_ENFORCED, "gaptol", "auto_penalty", "update_penalty", "search_tol", "search_radius")
_TIED = (*_AUTOMATIC, "two_pass", "knmult", "symmetric_stiffness")
_OLD_TIE = (*_ENFORCED, "search_tolerance")

TIED_TYPES = {
    known.name: known
    for known in (
        _type(TIED, "", *(parameter.name for parameter in PLUGIN_TYPES[TIED])),
        _type("tied-elastic", "solid", *_TIED, "flip_primary", "flip_secondary"),
        _type("tied-biphasic", "biphasic", *_TIED, *_SOLVENT),
        _type("tied-multiphasic", "multiphasic", *_TIED, *_SOLVENT, *_SOLUTE),
        _type("tied-node-on-facet", "solid", *_OLD_TIE, "offset_shells", "max_distance", "special", "node_reloc"),
        _type("tied-facet-on-facet", "solid", *_OLD_TIE, "gap_offset"),
        _type(STICKY, "solid", *_OLD_TIE, "gap_offset", "flip_secondary", "max_traction", "snap_tol"),
    )
}
"""Every tied type, by its name in a model file."""

CONVERTIBLE_TIES = tuple(name for name in TIED_TYPES if name != TIED)
"""The types of FEBio's that `tied-mixture` takes the place of."""
ANY_DISTANCE = ("tied-node-on-facet", "tied-facet-on-facet", STICKY)
"""The types that look for the closest point, at any distance where none is given."""
