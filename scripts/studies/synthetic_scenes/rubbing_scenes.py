"""The scenes with friction: those in which bodies slide, stick, or both, with FEBio's friction and with ours."""

from __future__ import annotations

from collections.abc import Mapping

from studies.synthetic_scenes import edits
from studies.synthetic_scenes.collection_of_scenes import SCENES as BODIES
from studies.synthetic_scenes.scenes_of_files import Edited

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


def _with_friction(name: str, coefficient: float) -> Edited:
    scene = BODIES[name]
    rubs = edits.in_contact(fric_coeff=f"{coefficient:g}")
    return Edited(f"{scene.about}, friction {coefficient:g}", scene, (rubs,))


SCENES: Mapping[str, Edited] = {f"friction-{name}": _with_friction(name, mu) for name, mu in _RUBS.items()}
"""By name."""
