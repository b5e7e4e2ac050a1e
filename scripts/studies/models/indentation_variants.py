"""The family of problem 3.3: other meshes, the other primary surface, quadratic elements, a ball."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum

from harness.models.indentation import Indentation
from harness.models.indentation_mesh import Grid, Primary

LEVELS = (
    Grid(across=9, down=6, around=3),
    Grid(),
    Grid(across=36, down=24, around=12),
)
"""Three meshes, each with half the element size of the one before."""
MATCHING = Grid(across=6, down=8, around=9)
"""A mesh whose facets are about as long (0.25 mm) on the slab as on the cylinder; on `LEVELS` the ratio is 1 to 4.7."""
BALL = Grid(across=6, down=6, around=3, solid=True)
"""A coarse mesh of the three-dimensional problem."""


class Variant(str, Enum):
    """The members of the family of this problem."""

    PLAIN = "plain"
    SLAB_PRIMARY = "slab-primary"
    SIDE = "side"
    COARSE = "coarse"
    FINE = "fine"
    MATCHING = "matching"
    HEX20 = "hex20"
    BALL = "ball"

    @property
    def problem(self) -> Indentation:
        """The problem with its name; all else has its default."""
        primary = Primary.SLAB if self is Variant.SLAB_PRIMARY else Primary.CYLINDER
        name = "indentation" if self is Variant.PLAIN else f"indentation-{self.value}"
        return Indentation(grid=self._grid, primary=primary, name=name)

    @property
    def _grid(self) -> Grid:
        coarse, medium, fine = LEVELS
        special = {
            Variant.SIDE: replace(medium, side=True),
            Variant.COARSE: coarse,
            Variant.FINE: fine,
            Variant.MATCHING: MATCHING,
            Variant.HEX20: replace(coarse, nodes=20),
            Variant.BALL: BALL,
        }
        return special.get(self, medium)
