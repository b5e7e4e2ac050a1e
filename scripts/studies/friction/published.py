"""Published curves, at some places.

Digitised from the articles' figures by solids4foam/solid-benchmarks on GitHub (hyperElasticity/twistingHemisphere and
compressedSpheres), interpolated here. That collection says, with the meshes it runs, what the articles' texts leave
open: the hemisphere's inner radius of 2/3 (its force before it turns, 12.3 N, is another 1.2 N with 1/2), and that the
force of the spheres is that of the modelled octant.
"""

from collections.abc import Mapping

Curves = Mapping[str, tuple[float, ...]]
FEBIO, SAUER, ABAQUS, AREIAS = "FEBio (2018)", "Sauer, De Lorenzis (2015)", "Abaqus (2018)", "Areias et al. (2015)"
"""Zimmerman and Ateshian (2018), J Biomech Eng 140(8):081013, for FEBio and Abaqus; Sauer and De Lorenzis (2015), Int J
Numer Methods Eng 101(4):251-280; Areias, Rabczuk, Queiros de Melo and Cesar de Sa (2015), Comput Mech 55(1):57-72."""
ANGLES = (20.0, 40.0, 60.0, 80.0, 120.0, 180.0)  # degrees
TORQUE: Curves = {
    FEBIO: (1.443, 2.732, 3.578, 3.950, 4.098, 4.049),
    SAUER: (1.455, 2.667, 3.545, 3.949, 4.026, 4.012),
}
"""N mm."""
PRESSED: Curves = {SAUER: (12.337, 12.449, 12.607, 12.730, 12.820, 12.887)}  # force on the hemisphere, N
WAYS = (2.0, 4.0, 6.0, 8.0, 9.0)  # mm
SPHERES: Curves = {
    FEBIO: (0.83, 1.95, 3.20, 4.34, 5.34),
    ABAQUS: (0.82, 1.92, 3.12, 4.21, 5.48),
    AREIAS: (0.70, 1.70, 3.00, 4.44, 5.03),
}
"""Force on the octant, N."""
SMOOTH_SPHERES: Curves = {FEBIO: (0.78, 1.80, 2.72, 4.04, 4.76)}  # the same without friction, N


def spread(curves: Curves) -> list[tuple[float, float]]:
    """The least and the largest value at each place."""
    return [(min(values), max(values)) for values in zip(*curves.values(), strict=True)]
