#include "search.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

using Box = Eigen::AlignedBox3d;

/// Collects the facets whose boxes a segment meets, in the form that Eigen's BVIntersect asks for.
struct SegmentCollector {
  Vector3d middle;
  Vector3d half;  ///< half the segment as a vector
  double width;   ///< by which boxes are enlarged
  std::vector<int> found;

  /// Separating axes of a box and a segment: the box's axes and their cross products with the segment (Gottschalk et
  /// al. 1996).
  bool intersectVolume(const Box& box) const {
    const Vector3d extent = 0.5 * box.sizes() + Vector3d::Constant(width);
    const Vector3d offset = middle - box.center();
    const Vector3d reach = half.cwiseAbs();
    if ((offset.cwiseAbs().array() > (extent + reach).array()).any()) return false;
    const Vector3d twist = offset.cross(half).cwiseAbs();
    const double rounding = 1e-12 * (offset.cwiseAbs() + extent).sum() * reach.sum();
    for (Index i = 0; i < 3; ++i) {
      const Index j = (i + 1) % 3;
      const Index k = (i + 2) % 3;
      if (twist[i] > extent[j] * reach[k] + extent[k] * reach[j] + rounding) return false;
    }
    return true;
  }

  bool intersectObject(int facet) {
    found.push_back(facet);
    return false;  // continue the search
  }
};

Box enlarged_box(const Facet& facet, const Matrix3Xd& positions, double margin) {
  const FacetCoordinates x = facet_coordinates(facet, positions);
  Box box(x.rowwise().minCoeff(), x.rowwise().maxCoeff());
  const Vector3d pad = Vector3d::Constant(margin * box.diagonal().norm());
  return {box.min() - pad, box.max() + pad};
}

}  // namespace

FacetTree::FacetTree(const std::vector<Facet>& facets, const Matrix3Xd& positions, double margin) {
  std::vector<int> ids;
  std::vector<Box> boxes;
  ids.reserve(facets.size());
  boxes.reserve(facets.size());
  for (const Facet& facet : facets) {
    ids.push_back(static_cast<int>(ids.size()));
    boxes.push_back(enlarged_box(facet, positions, margin));
  }
  tree_.init(ids.begin(), ids.end(), boxes.begin(), boxes.end());
}

std::vector<int> FacetTree::candidates(const Vector3d& origin, const Vector3d& direction, double reach,
                                       double width) const {
  SegmentCollector collector{origin, reach * direction, width, {}};
  Eigen::BVIntersect(tree_, collector);
  std::sort(collector.found.begin(), collector.found.end());
  return std::move(collector.found);
}

std::optional<SurfaceHit> nearest_facing(const FacetTree& tree, const std::vector<Facet>& facets,
                                         const Matrix3Xd& positions, const Ray& ray) {
  std::optional<SurfaceHit> best;
  double best_length = 0;
  for (const int candidate : tree.candidates(ray.origin, ray.direction, ray.reach)) {
    const Facet& facet = facets[static_cast<std::size_t>(candidate)];
    const FacetCoordinates x = facet_coordinates(facet, positions);
    const std::optional<RayHit> hit = intersect(facet.type, x, ray.origin, ray.direction, ray.tolerance);
    if (!hit || std::abs(hit->gap) > ray.reach) continue;
    const Eigen::Matrix<double, 3, 2> tangents = x * shape_functions(facet.type, hit->eta).gradient;
    if (tangents.col(0).cross(tangents.col(1)).dot(ray.direction) >= 0) continue;
    const double outside = distance_outside(facet.type, hit->eta) * tangents.colwise().norm().maxCoeff();
    const double length = std::abs(hit->gap) + outside;
    if (best && length >= best_length) continue;
    best = {candidate, hit->eta, hit->gap};
    best_length = length;
  }
  return best;
}

}  // namespace mixture_contact
