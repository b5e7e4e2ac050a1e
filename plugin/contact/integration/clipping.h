/// Clipping of plane polygons. Corners that are numbers with derivatives (plane.h) keep their exact variations.
#pragma once

#include "integration/plane.h"

namespace mixture_contact {

/// Twice the signed area of a polygon: positive for counter-clockwise corners, negative for clockwise ones.
template <class Number>
double twice_area(const Polygon<Number>& polygon);

/// Clips a polygon against a convex window with counter-clockwise corners (Sutherland and Hodgman 1974, Commun ACM
/// 17(1):32).
///
/// A corner of the polygon within `coincident` [length] of an edge's line counts as inside the window: where edges
/// coincide, the result keeps the polygon's own corners and their variations. Returns an empty polygon if nothing is
/// inside. The result uses the memory resource of the polygon.
template <class Number>
Polygon<Number> clip(Polygon<Number> polygon, const Polygon<Number>& window, double coincident);

}  // namespace mixture_contact
