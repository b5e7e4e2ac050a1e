/// Clipping of polygons in space seen along a direction, with the exact variations of the corners.
#pragma once

#include "integration/varying.h"

#include <vector>

namespace mixture_contact {

/// Corners in counter-clockwise order, seen from where the direction n points to. Only where they appear along n
/// counts.
using Polygon = std::vector<VaryingVector>;

/// Twice the area of a polygon seen along -n; negative if its corners go clockwise.
double twice_area(const Polygon& polygon, const Vector3d& n);

/// The part of a polygon within a convex window, both seen along n (Sutherland and Hodgman 1974, Commun ACM 17(1):32).
///
/// Corners within `coincident` [length] of the line along an edge of the window count as within: edges that coincide
/// leave the corners of the polygon, and move with it. Empty if nothing is left.
Polygon clip(Polygon polygon, const Polygon& window, const VaryingVector& n, double coincident);

}  // namespace mixture_contact
