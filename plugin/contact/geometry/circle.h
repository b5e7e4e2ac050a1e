/// Circles around facets: a line that misses the circle misses the facet.
#pragma once

#include "geometry/surface.h"

namespace mixture_contact {

/// The largest distance of a node of a facet from a point.
double radius_around(const FacetCoordinates& x, const Vector3d& centre);

/// A circle, or rather a sphere, around a facet or a part of it. A facet whose shape functions leave its nodes' hull
/// may reach out of it.
struct Circle {
  Vector3d centre{0, 0, 0};
  double radius = 0;
};

Circle circle_around(const FacetCoordinates& x);

/// Circles around each of these facets.
IndexedVector<Circle> circles_around(const IndexedVector<Facet>& facets, const Matrix3Xd& x);

/// Whether two circles are apart, seen along the unit vector n, by more than rounding.
bool are_apart(const Circle& one, const Circle& two, const Vector3d& n);

/// Whether the line through a point along the unit vector n passes a circle by more than rounding.
bool is_passed(const Circle& circle, const Vector3d& point, const Vector3d& n);

}  // namespace mixture_contact
