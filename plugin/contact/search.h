/// Search: which facet does a ray meet first.
#pragma once

#include "projection.h"
#include "surface.h"

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>

#include <optional>
#include <vector>

namespace mixture_contact {

/// Curved facets bulge out of the box of their nodes by less than this part of its diagonal.
inline constexpr double box_margin = 0.1;

/// A bounding-volume tree (Eigen's KdBVH) over the facets of a surface in one configuration.
class FacetTree {
 public:
  /// Boxes around the facets' nodes, enlarged by `margin` times their diagonal (curved facets bulge out of their nodes'
  /// box).
  FacetTree(const std::vector<Facet>& facets, const Matrix3Xd& positions, double margin);

  /// Indices, ascending, of the facets whose box meets the segment from origin - reach * direction to origin + reach *
  /// direction; with a width, those that come that near to it along the axes.
  std::vector<int> candidates(const Vector3d& origin, const Vector3d& direction, double reach, double width = 0) const;

 private:
  Eigen::KdBVH<double, 3, int> tree_;
};

/// A ray that looks for the nearest facet that faces it.
struct Ray {
  Vector3d origin;
  Vector3d direction;  ///< unit vector: the normal of the surface it leaves
  double reach;        ///< how far it looks, forwards and backwards [length]
  double tolerance;    ///< how far outside a facet a hit still counts, in parametric coordinates
};

/// Where a ray meets a surface.
struct SurfaceHit {
  int facet;
  Vector2d eta;
  double gap;
};

/// The nearest hit of a ray on the facets of a tree whose outward normals oppose its direction; empty if there is none.
/// A hit outside its facet, within the tolerance, counts as farther by as much as it lies outside: where facets adjoin
/// at less than 45 degrees the one that the ray does meet wins, so that the gap does not jump as the hit crosses their
/// edge. The choice depends on the configuration alone, never on earlier calls; equal lengths go to the lowest facet
/// index.
std::optional<SurfaceHit> nearest_facing(const FacetTree& tree, const std::vector<Facet>& facets,
                                         const Matrix3Xd& positions, const Ray& ray);

}  // namespace mixture_contact
