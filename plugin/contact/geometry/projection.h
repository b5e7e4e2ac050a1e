/// Projection of a point along a ray onto a facet.
#pragma once

#include "geometry/facet.h"

#include <optional>

namespace mixture_contact {

/// The point in which a ray meets a facet: x2(eta) = origin + gap * direction.
struct RayHit {
  Vector2d eta;  ///< parametric coordinates on the facet
  double gap;    ///< signed length along the direction [length]
};

/// Intersection of the line through origin along a unit direction with a facet.
///
/// Newton's method on x2(eta) - origin - gap * direction = 0, from the facet's centre and, where the facet is curved or
/// warped and that start fails or the line may meet it twice, from each node. Returns the hit if it lies within the
/// facet's parametric domain enlarged by `tolerance`; of several, the one with the smallest |gap|.
std::optional<RayHit> intersect(FacetType type, const FacetCoordinates& x, const Vector3d& origin,
                                const Vector3d& direction, double tolerance);

}  // namespace mixture_contact
