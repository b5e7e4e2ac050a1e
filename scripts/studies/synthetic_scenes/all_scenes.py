"""Every scene, by name."""

from __future__ import annotations

from collections.abc import Mapping

from studies.synthetic_scenes import collection_of_scenes, drawn_scenes, rubbing_scenes, scenes_of_files
from studies.synthetic_scenes.comparison import Written

SCENES: Mapping[str, Written] = {
    **collection_of_scenes.SCENES,
    **scenes_of_files.SCENES,
    **drawn_scenes.SCENES,
    **rubbing_scenes.SCENES,
}
