/// Spheres around facets: a line that misses the sphere misses the facet.
#pragma once

#include "geometry/surface.h"

namespace mixture_contact {

/// The largest distance of a facet's nodes from a point [length].
double radius_around(const FacetCoordinates& x, const Vector3d& centre);

/// A sphere around the nodes of a facet, or of a part of it; along a direction it appears as a circle. A curved facet
/// may extend beyond the sphere where its shape functions leave the convex hull of the nodes.
struct Circle {
  Vector3d centre{0, 0, 0};
  double radius = 0;
};

/// The sphere around the mean of the nodes of a facet with these coordinates.
Circle circle_around(const FacetCoordinates& x);

/// The spheres around all facets, in their order.
IndexedVector<Circle> circles_around(const IndexedVector<Facet>& facets, const Matrix3Xd& x);

/// True if two spheres do not overlap in the projection along the unit vector n, by more than rounding.
bool are_apart(const Circle& one, const Circle& two, const Vector3d& n);

/// True if the line through a point along the unit vector n misses a sphere by more than rounding.
bool is_passed(const Circle& circle, const Vector3d& point, const Vector3d& n);

}  // namespace mixture_contact
