"""A row of docs/data/knee.csv, and of the results of porous knees."""

import math
from dataclasses import dataclass
from enum import Enum


class Kind(str, Enum):
    """Knees that are measured in one go."""

    ELASTIC = "elastic"
    POROUS = "porous"
    WAYS = "ways"  # the coarse elastic knee in stance, with the plugin in all ways


class Way(str, Enum):
    """Ways to pose the same contacts, by their names in tables."""

    DEFAULTS = "defaults"
    SWAPPED = "the other side primary"
    TWO_PASSES = "two passes"
    AUGLAG = "`AUGLAG`"
    LAGMULT = "`LAGMULT`"


@dataclass(frozen=True)
class KneeRun:
    """One run, and what passes each compartment at the time of the largest force, or at its end."""

    bodies: str
    load: str
    size: str
    contact: str  # type of the six contacts
    factor: float  # of FEBio's automatic penalties; 0 for the plugin's defaults
    # Whether it ended normally, and whether the limit of processor time ended it.
    ended: bool
    limited: bool
    reached: float  # last time with a solution, s
    steps: int
    iterations: int
    retries: int
    # Processor time, s, and the largest memory, MB.
    seconds: float
    memory: float
    # On the femur, N.
    force_medial: float = math.nan
    force_lateral: float = math.nan
    # Of tibia and meniscus under the femur, mm^2.
    area_medial: float = math.nan
    area_lateral: float = math.nan
    # Largest mean pressure of a facet, MPa.
    peak_medial: float = math.nan
    peak_lateral: float = math.nan
    overlap: float = math.nan  # largest mean overlap of a facet under pressure, mm
    fluid_most: float = math.nan
    fluid_last: float = math.nan
    """Part of the load that the fluid bears where the femur is in contact, largest and last, while the load is above
    half of its largest."""
    appeared: float = math.nan  # solute that appeared at nodes which nothing feeds, over the content at the end

    @property
    def scene(self) -> tuple[str, str, str]:
        """The model without its contact."""
        return self.bodies, self.load, self.size
