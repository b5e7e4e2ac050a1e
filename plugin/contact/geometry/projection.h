/// Projection of a point along a ray onto a facet.
#pragma once

#include "geometry/facet.h"

#include <optional>

namespace mixture_contact {

/// Intersection of a ray with a facet: x2(eta) = origin + gap * direction.
struct RayHit {
  Vector2d eta;  ///< parametric coordinates of the intersection on the facet
  double gap;    ///< signed distance of the intersection from `origin`, positive along `direction` [length]
};

/// Intersection of a facet with the line through `origin` along the unit vector `direction`.
std::optional<RayHit> intersect(FacetType type, const FacetCoordinates& x, const Vector3d& origin,
                                const Vector3d& direction, double tolerance);

}  // namespace mixture_contact
