/// Clipping of polygons in a plane, with the exact variations of the corners where they vary.
#pragma once

#include "integration/plane.h"

namespace mixture_contact {

/// Twice the area of a polygon; negative if its corners go clockwise.
template <class Number>
double twice_area(const Polygon<Number>& polygon);

/// The part of a polygon within a convex window (Sutherland and Hodgman 1974, Commun ACM 17(1):32).
///
/// Corners within `coincident` [length] of the line along an edge of the window count as within: edges that coincide
/// leave the corners of the polygon, and move with it. Empty if nothing is left. The memory is that of the polygon.
template <class Number>
Polygon<Number> clip(Polygon<Number> polygon, const Polygon<Number>& window, double coincident);

}  // namespace mixture_contact
