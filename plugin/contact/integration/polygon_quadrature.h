/// Quadrature on polygons in a plane, with the exact variations of its points where the polygons vary: convex ones; of
/// orders 1 and 2 any whose edges do not cross.
///
/// Integrals change smoothly with orders 1 and 2 as the polygon gains or loses corners, and with higher orders by the
/// part beyond the degree of the rule. Integrals over a mirrored polygon are mirrored.
#pragma once

#include "geometry/facet.h"
#include "integration/plane.h"

namespace mixture_contact {

/// A quadrature point of a polygon.
template <class Number>
struct PolygonPoint {
  Place<Number> place;
  Number area;  ///< the part of the polygon's area that belongs to it
};

template <class Number>
using PolygonPoints = std::pmr::vector<PolygonPoint<Number>>;

/// The triangle (tri3) or quadrilateral (quad4) that the points are aligned with: the polygon is a part of it.
template <class Number>
struct Alignment {
  FacetType type = FacetType::quad4;
  Place<Number> first;   ///< of two directions in which all sides of a triangle, or those of a square, are equally long
  Place<Number> second;  ///< the other one
};

/// The alignment with a polygon of three or four corners.
template <class Number>
Alignment<Number> alignment(const Polygon<Number>& polygon);

/// The points of a polygon that has an area, in its memory.
///
/// Order 1: the centroid. Order 2: three (triangles) or four points on the ellipse of inertia, which fits times sqrt(2)
/// within any convex figure (Kannan, Lovasz and Simonovits 1995, Discrete Comput Geom 13:541-559); exact for
/// polynomials of the second degree, where the polygon is symmetric about its centroid of the third. These are the
/// 2 x 2 Gauss points of a parallelogram aligned with its sides, and the points of order 2 of triangles. Higher orders:
/// the rule of this order on a quadrilateral, or on the triangles around the centroid.
template <class Number>
PolygonPoints<Number> polygon_quadrature(const Polygon<Number>& polygon, const Alignment<Number>& aligned, int order);

}  // namespace mixture_contact
