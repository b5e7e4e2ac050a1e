"""Linear springs between nodes."""

from dataclasses import dataclass

from harness.arrays import Ids
from harness.models.parts import Element, Param, child


@dataclass(frozen=True)
class Springs:
    """Springs of one stiffness, which pull and push."""

    name: str
    stiffness: float  # of each spring, N/mm
    ends: Ids  # shape (n_springs, 2): node numbers, from 1
    curve: int | None = None  # number of a load curve that is a factor of the stiffness

    def write_mesh(self, parent: Element) -> None:
        """Append the pairs of nodes to the section ``Mesh``."""
        made = child(parent, "DiscreteSet", name=self.name)
        for pair in self.ends:
            child(made, "delem", tuple(map(int, pair)))

    def write_material(self, parent: Element, number: int) -> None:
        """Append the material to the section ``Discrete``."""
        made = child(parent, "discrete_material", id=str(number), name=self.name, type="linear spring")
        Param("E", self.stiffness, self.curve).write(made)

    def write_set(self, parent: Element, number: int) -> None:
        """Append the springs to the section ``Discrete``."""
        child(parent, "discrete", dmat=str(number), discrete_set=self.name)
