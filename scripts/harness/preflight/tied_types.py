"""The tied contact types that `check` and `convert` know, and the parameters that each of them has in FEBio 4.11."""

from __future__ import annotations

from harness.preflight.contact_types import STICKY, TIED, ContactType
from harness.preflight.plugin_types import PLUGIN_TYPES

_ENFORCED = ("laugon", "tolerance", "penalty", "minaug", "maxaug")
_AUTOMATIC = (*_ENFORCED, "gaptol", "auto_penalty", "update_penalty", "search_tol", "search_radius")
_SOLVENT = ("ptol", "pressure_penalty")
_SOLUTE = ("ctol", "concentration_penalty")
_OF_FEBIO = ("two_pass", "knmult", "symmetric_stiffness")
_FLIPS = ("flip_primary", "flip_secondary")
_OWN = tuple(parameter.name for parameter in PLUGIN_TYPES[TIED])


def _tied(name: str, home: str, *parameters: str, solvent: bool = False, solutes: bool = False) -> ContactType:
    return ContactType(name, home, frozenset(parameters), solvent, solutes)


TIED_TYPES = {
    known.name: known
    for known in (
        _tied(TIED, "", *_OWN, solvent=True, solutes=True),
        _tied("tied-elastic", "solid", *_AUTOMATIC, *_OF_FEBIO, *_FLIPS),
        _tied("tied-biphasic", "biphasic", *_AUTOMATIC, *_OF_FEBIO, *_SOLVENT, solvent=True),
        _tied(
            "tied-multiphasic",
            "multiphasic",
            *(*_AUTOMATIC, *_OF_FEBIO, *_SOLVENT, *_SOLUTE),
            solvent=True,
            solutes=True,
        ),
        _tied(
            "tied-node-on-facet",
            "solid",
            *(*_ENFORCED, "search_tolerance", "offset_shells", "max_distance", "special", "node_reloc"),
        ),
        _tied("tied-facet-on-facet", "solid", *_ENFORCED, "search_tolerance", "gap_offset"),
        _tied(
            STICKY,
            "solid",
            *(*_ENFORCED, "search_tolerance", "gap_offset", "flip_secondary", "max_traction", "snap_tol"),
        ),
    )
}
"""Every tied type, by its name in a model file."""

CONVERTIBLE_TIES = tuple(name for name in TIED_TYPES if name != TIED)
"""The types of FEBio's that `tied-mixture` takes the place of."""
ANY_DISTANCE = ("tied-node-on-facet", "tied-facet-on-facet", STICKY)
"""The types that look for the closest point, at any distance where none is given."""


def keeps_gaps(kind: ContactType, *, has_offset: bool) -> bool:
    """Whether a type of FEBio's leaves an initial gap as it is; the others draw the surfaces together.

    `has_offset`: <gap_offset> is on.
    """
    return kind.name not in ANY_DISTANCE or (kind.name == "tied-facet-on-facet" and has_offset)
