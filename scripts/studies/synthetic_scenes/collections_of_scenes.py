"""The collections of scenes, what is run of each, and where its results stand."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from studies.pages import reported_results, scene_results
from studies.pages.scene_results import Results, Row
from studies.synthetic_scenes import collection_of_scenes, comparison, drawn_scenes, scenes_of_files
from studies.synthetic_scenes.comparison import Written
from studies.synthetic_scenes.random_bodies import SCENES as RANDOM
from studies.synthetic_scenes.reported.kinds_of_scene import SCENES as REPORTED
from studies.synthetic_scenes.varied_scenes import SCENES as VARIED

SCENES: Mapping[str, Written] = {
    **collection_of_scenes.SCENES,
    **scenes_of_files.SCENES,
    **drawn_scenes.SCENES,
    **scenes_of_files.RUBBING,
}
"""Every scene of `Collection.BLOCKS`, by name."""


class Collection(str, Enum):
    """A collection, as the command line names it."""

    BLOCKS = "blocks"  # mostly a block on a slab: every element, material, module and solver
    REPORTED = "reported"  # kinds of model that users report
    VARIED = "varied"  # reported scenes with random materials, contacts and solvers, `seed-000` to `seed-999`
    BODIES = "bodies"  # bodies with random shapes and meshes, `seed-000` to `seed-999`


@dataclass(frozen=True)
class Study:
    """What a collection is run for."""

    scenes: Mapping[str, Written]
    ways: Sequence[str]  # names of `comparison.WAYS`
    data: Path | None  # below docs/; None where nothing is kept
    pages: Mapping[str, Callable[[Results], str]]  # generated pages below docs/
    # What the results come to.
    summary: Callable[[Sequence[Row]], str]
    table: Callable[[Sequence[Row]], str]


STUDIES: Mapping[Collection, Study] = {
    Collection.BLOCKS: Study(
        SCENES,
        tuple(comparison.WAYS),
        scene_results.DATA,
        {scene_results.PAGE: scene_results.page, scene_results.ALL: scene_results.all_scenes},
        scene_results.summary,
        scene_results.table,
    ),
    Collection.REPORTED: Study(
        REPORTED,
        tuple(reported_results.WAYS),
        reported_results.DATA,
        {reported_results.PAGE: reported_results.page, reported_results.ALL: reported_results.all_scenes},
        reported_results.summary,
        reported_results.table,
    ),
    **{
        collection: Study(
            scenes, tuple(reported_results.WAYS), None, {}, reported_results.compared, reported_results.table
        )
        for collection, scenes in ((Collection.VARIED, VARIED), (Collection.BODIES, RANDOM))
    },
}
