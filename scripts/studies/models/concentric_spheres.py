"""Two concentric spherical shells pressed between rigid planes: the inner one buckles."""

from dataclasses import dataclass

import numpy as np

from harness.models.document import Model
from harness.models.interface import InterfaceType, default_settings, header
from harness.models.mesh import Mesh
from harness.models.parts import Contact, Control, Curve, Elastic, Solid, TimeStepper, displace, fix
from studies.models import spherical_shells
from studies.models.assembly import assembled, box, everywhere, plane, sphere
from studies.models.pieces import hold, with_friction

INNER, MIDDLE, OUTER = 10.0, 12.0, 14.0
"""Radii of the inner shell's inner face, of the contact between the shells, and of the outer shell's outer face, mm."""
SOLID = Solid(1.0, 0.3)
WAY = 9.0  # mm by which the upper plane comes down
WIDTH, THICK = 20.0, 1.0  # of the planes, mm
ABOUT = """\
Two concentric spherical shells (radii 10, 12 and 14 mm) are pressed together between rigid planes by 9 mm on each side:
an octant of example 3.7 of Zimmerman and Ateshian (2018), J Biomech Eng 140(8):081013, after Puso and Laursen (2004),
Comput Methods Appl Mech Eng 193(6-8):601-629. The planes have no friction. The inner shell buckles and meets the plane
of symmetry."""


@dataclass(frozen=True)
class ConcentricSpheres:
    friction: float = 0.5  # coefficient between the shells
    elements: int = 8
    """Of the outer shell along each edge of a patch, of which the octant has three; the inner shell has one less."""
    through: int = 3  # elements through each shell
    steps: int = 90
    name: str = "concentric-spheres"

    def model(self) -> Model:
        mesh, end = self._mesh(), float(self.steps)
        stepper = TimeStepper(1.0, retries=10, optimal_iterations=15, aggressive=True)
        return Model(
            self.name,
            header(self.name, ABOUT, InterfaceType.MIXTURE),
            "solid",
            mesh,
            {"inner": Elastic(SOLID), "outer": Elastic(SOLID), "floor": Elastic(SOLID), "lid": Elastic(SOLID)},
            (
                fix("x-symmetry", "x"),
                fix("y-symmetry", "y"),
                fix("inner-rim", "z"),
                fix("outer-rim", "z"),
                *hold("floor", "xyz"),
                *hold("lid", "xy"),
                displace("lid", "z", -WAY, 1),
            ),
            Control(self.steps, 1.0, 1e-4, 1e-6, reformations=40, stepper=stepper),
            self._contacts(),
            (Curve(((0.0, 0.0), (end, 1.0))),),
            further_columns=("Rz",),
        )

    def _contacts(self) -> tuple[Contact, ...]:
        shells = with_friction(InterfaceType.MIXTURE, self.friction)
        smooth = default_settings(InterfaceType.MIXTURE).params()
        planes = (Contact(InterfaceType.MIXTURE.value, pair, smooth) for pair in ("top", "bottom"))
        return (Contact(InterfaceType.MIXTURE.value, "shells", shells.params()), *planes)

    def _mesh(self) -> Mesh:
        bodies = {
            "inner": spherical_shells.octant(self.elements - 1, np.linspace(INNER, MIDDLE, self.through + 1)),
            "outer": spherical_shells.octant(self.elements, np.linspace(MIDDLE, OUTER, self.through + 1)),
            "floor": box((0.0, 0.0, -THICK), (WIDTH, WIDTH, 0.0), (1, 1, 1)),
            "lid": box((0.0, 0.0, OUTER), (WIDTH, WIDTH, OUTER + THICK), (1, 1, 1)),
        }
        sets = {
            "x-symmetry": plane("x", 0.0),
            "y-symmetry": plane("y", 0.0),
            "inner-rim": plane("z", 0.0, "inner"),
            "outer-rim": plane("z", 0.0, "outer"),
            "floor": everywhere("floor"),
            "lid": everywhere("lid"),
        }
        surfaces = {
            "inner-inside": sphere(INNER, "inner"),
            "inner-outside": sphere(MIDDLE, "inner"),
            "outer-inside": sphere(MIDDLE, "outer"),
            "outer-outside": sphere(OUTER, "outer"),
            "floor": plane("z", 0.0, "floor"),
            "lid": plane("z", OUTER, "lid"),
        }
        pairs = {
            "shells": ("inner-outside", "outer-inside"),
            "top": ("outer-outside", "lid"),
            "bottom": ("inner-inside", "floor"),
        }
        return assembled(bodies, sets, surfaces, pairs)
