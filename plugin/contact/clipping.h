/// Clipping of polygons in space seen along a direction, with the exact variations of the corners.
///
/// Variations are taken with the nodal positions of a pair of facets, three columns per node. Where only values are
/// wanted the variations have no columns, and all operations on them are empty.
#pragma once

#include "types.h"

#include <vector>

namespace mixture_contact {

/// A number with its variation.
struct VaryingNumber {
  double value = 0;
  PairVariation<1> variation;
};

/// A point or vector with its variation.
struct VaryingVector {
  Vector3d value{0, 0, 0};
  PairVariation<3> variation;
};

VaryingVector operator+(const VaryingVector& one, const VaryingVector& two);
VaryingVector operator-(const VaryingVector& one, const VaryingVector& two);
VaryingVector operator*(double factor, const VaryingVector& vector);
VaryingVector operator*(const VaryingNumber& factor, const VaryingVector& vector);

/// n.(a x b): of two edges of a triangle twice its area seen along -n, positive where they turn counter-clockwise.
VaryingNumber triple(const VaryingVector& n, const VaryingVector& a, const VaryingVector& b);

/// A vector over its length.
VaryingVector normalized(const VaryingVector& vector);

/// Corners in counter-clockwise order, seen from where the direction n points to. Only where they appear along n
/// counts.
using Polygon = std::vector<VaryingVector>;

/// Twice the area of a polygon seen along -n; negative if its corners go clockwise.
double twice_area(const Polygon& polygon, const Vector3d& n);

/// Centre of the area of a polygon seen along n; it must have an area.
VaryingVector centroid(const Polygon& polygon, const VaryingVector& n);

/// The part of a polygon within a convex window, both seen along n (Sutherland and Hodgman 1974, Commun ACM 17(1):32).
///
/// Corners within `coincident` [length] of the line along an edge of the window count as within: edges that coincide
/// leave the corners of the polygon, and move with it. Empty if nothing is left.
Polygon clip(Polygon polygon, const Polygon& window, const VaryingVector& n, double coincident);

}  // namespace mixture_contact
