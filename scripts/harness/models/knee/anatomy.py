"""Surfaces and dimensions of the knee, in mm: x points laterally, y forwards, z up; the origin is between the condyles.

Sources
-------
Iwaki, Pinskerova and Freeman (2000), J Bone Joint Surg Br 82-B:1189, sagittal circles of the condyles, 22 to 32 mm;
McDermott et al. (2004), Knee Surg Sports Traumatol Arthrosc 12:130, sizes of the menisci, 45.7 mm (medial) and 35.7 mm
(lateral) long, 9.3 to 10.9 mm wide; Shepherd and Seedhom (1999), Ann Rheum Dis 58:27, thickness of cartilage, 1.7 to
2.6 mm; Hashemi et al. (2008), J Bone Joint Surg Am 90:2724, depth of the medial plateau, 2.7 mm over its length.
The shapes are idealised: one circle per section, and both condyles have one axis of flexion.
"""

from dataclasses import dataclass

import numpy as np

from harness.arrays import Array

SAGITTAL, CORONAL = 30.0, 20.0  # radii of a condyle's surface in its sagittal and coronal sections
BACK, FRONT, SIDE = np.deg2rad(75.0), np.deg2rad(45.0), np.deg2rad(48.0)
"""Ends of a condyle's cartilage: behind and before its lowest point, and to either side."""
FEMORAL_CARTILAGE, TIBIAL_CARTILAGE, BONE = 2.2, 2.6, 4.0  # thicknesses
DEPTH = 75.0  # radius of the hollow of the medial plateau, and of the lateral plateau's hill in sagittal sections
PLAY = 0.05  # gap between a meniscus and what is above and below it at the start


@dataclass(frozen=True)
class Compartment:
    """One side of the knee."""

    name: str
    centre: float  # x of the lowest point of the condyle
    length: float  # half the length of the plateau's cartilage, along y
    rim: tuple[float, float]  # semi-axes of the meniscus's rim along x and y
    width: float  # of the meniscus
    opening: float  # half the angle, as parameter of the ellipse, in which the meniscus is open
    hollow: bool  # whether the plateau is concave in all sections; convex in sagittal sections else

    @property
    def inwards(self) -> float:
        """Direction along x to the middle of the knee: 1 or -1."""
        return -float(np.sign(self.centre))

    def plateau(self, x: Array, y: Array) -> Array:
        """Height of the tibial cartilage's surface at a distance x, y from the centre."""
        along_x = x**2 if self.hollow else 0.0 * x
        return np.asarray((along_x + (1.0 if self.hollow else -1.0) * y**2) / (2.0 * DEPTH))


MEDIAL = Compartment("medial", -23.0, 23.0, (13.5, 21.5), 8.0, np.deg2rad(55.0), hollow=True)
LATERAL = Compartment("lateral", 23.0, 20.0, (13.5, 17.5), 8.5, np.deg2rad(35.0), hollow=False)
COMPARTMENTS = (MEDIAL, LATERAL)
PLATEAU_WIDTH = 15.5  # half the width of a plateau's cartilage, along x


def condyle(angle: Array, side: Array, depth: Array) -> Array:
    """Points of a condyle that touches its plateau, relative to that point, shape (..., 3).

    angle, side: around the axis of flexion, from the lowest point forwards, and along the coronal circle, rad.
    depth: below the surface of the cartilage, mm.
    """
    radius = SAGITTAL - CORONAL + (CORONAL - depth) * np.cos(side)
    x, y = (CORONAL - depth) * np.sin(side), radius * np.sin(angle)
    return np.stack([x, y, SAGITTAL - radius * np.cos(angle)], axis=-1)


def condyle_height(x: Array, y: Array) -> Array:
    """Height of the condyle's surface above its lowest point."""
    radius = SAGITTAL - CORONAL + np.sqrt(CORONAL**2 - x**2)
    return np.asarray(SAGITTAL - np.sqrt(radius**2 - y**2))


def rounded(u: Array, v: Array, roundness: float) -> tuple[Array, Array]:
    """Points of the square [-1, 1]^2 moved to a square with round corners; a circle for a roundness of 1."""
    return u * np.sqrt(1.0 - roundness * v**2 / 2.0), v * np.sqrt(1.0 - roundness * u**2 / 2.0)
