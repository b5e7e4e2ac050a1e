/// Quadrature on plane polygons, with the exact variations of its points where the corners vary. The polygon has to be
/// convex; for orders 1 and 2 it is enough that its edges do not cross.
///
/// The integral of a function changes smoothly while the polygon gains or loses corners: always for orders 1 and 2, and
/// for higher orders if the rule is exact for the function. The rule for a mirrored polygon is the mirrored rule.
#pragma once

#include "geometry/facet.h"
#include "integration/plane.h"

namespace mixture_contact {

/// A quadrature point of a polygon.
template <class Number>
struct PolygonPoint {
  Place<Number> place;
  Number area;  ///< area of the polygon that the point represents
};

template <class Number>
using PolygonPoints = std::pmr::vector<PolygonPoint<Number>>;

/// The triangle (tri3) or quadrilateral (quad4) that contains the polygon and to whose sides the quadrature points are
/// aligned.
template <class Number>
struct Alignment {
  FacetType type = FacetType::quad4;
  Place<Number>
      first;  ///< first of two axes; in their coordinates the triangle is equilateral, or the parallelogram is a square
  Place<Number> second;  ///< second of the two axes
};

/// The alignment with the sides of a polygon of three or four corners.
template <class Number>
Alignment<Number> alignment(const Polygon<Number>& polygon);

/// The quadrature points of a polygon of positive area. They use the memory resource of the polygon.
///
/// Order 1: the centroid. Order 2: three (triangles) or four points on the ellipse of inertia, which fits within any
/// convex figure if scaled by sqrt(2) (Kannan, Lovasz and Simonovits 1995, Discrete Comput Geom 13:541-559). Order 2 is
/// exact for polynomials of the second degree, and of the third where the polygon is symmetric about its centroid. Its
/// points are the 2 x 2 Gauss points on a parallelogram aligned with its own sides, and the points of the triangle rule
/// of order 2 on a triangle. Higher orders: the rule of this order on a quadrilateral, or on the triangles around the
/// centroid.
template <class Number>
PolygonPoints<Number> polygon_quadrature(const Polygon<Number>& polygon, const Alignment<Number>& aligned, int order);

}  // namespace mixture_contact
