#include "integration/search.h"

#include "base/bytes.h"
#include "integration/facing_share.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mixture_contact {
namespace {

/// Largest distance at which a node's ray may miss a facet that counts as hit, as a fraction of the gap.
constexpr double largest_miss = 0.2;

using Box = Eigen::AlignedBox3d;

/// The slack of a moving surface, as a fraction of the mean diagonal of its facets' boxes. A smaller slack requires
/// more frequent searches of the tree, a larger one leaves more facets to test.
constexpr double slack_fraction = 0.25;

/// A segment for the search of boxes.
struct Segment {
  Vector3d middle;
  Vector3d half;  ///< vector from the middle to an end
  double width;   ///< distance by which boxes are enlarged [length]

  /// Intersection test of a box and the segment. Separating axes are the axes of the box and their cross products with
  /// the segment (Gottschalk et al. 1996).
  bool meets(const Box& box) const {
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
};

/// The segment of a ray within its search distances.
Segment looked_along(const Ray& ray) {
  const double forwards = std::min(ray.reach, largest_tilted_reach() * ray.ahead);
  const double backwards = ray.backwards();
  return {ray.origin + 0.5 * (forwards - backwards) * ray.direction, 0.5 * (forwards + backwards) * ray.direction, 0};
}

/// The facets of a list whose boxes meet a segment.
std::vector<int> meeting(const Segment& segment, const std::vector<int>& facets, const std::vector<Box>& boxes) {
  std::vector<int> met;
  for (const int facet : facets) {
    if (segment.meets(at(boxes, facet))) met.push_back(facet);
  }
  return met;
}

/// Collects the facets whose boxes meet a segment, in the form that Eigen's BVIntersect requires.
struct SegmentCollector {
  Segment segment;
  std::vector<int> found;

  bool intersectVolume(const Box& box) const { return segment.meets(box); }

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

std::vector<Box> enlarged_boxes(const IndexedVector<Facet>& facets, const Matrix3Xd& positions, double margin) {
  std::vector<Box> boxes;
  boxes.reserve(facets.size());
  for (const Facet& facet : facets) boxes.push_back(enlarged_box(facet, positions, margin));
  return boxes;
}

/// A box that contains a surface, including curved facets that extend beyond the box of their nodes.
Box surface_box(const Matrix3Xd& positions) {
  Box box(positions.rowwise().minCoeff(), positions.rowwise().maxCoeff());
  const Vector3d pad = Vector3d::Constant(box_margin * box.diagonal().norm());
  return {box.min() - pad, box.max() + pad};
}

double mean_diagonal(const std::vector<Box>& boxes) {
  double sum = 0;
  for (const Box& box : boxes) sum += box.diagonal().norm();
  return boxes.empty() ? 0 : sum / static_cast<double>(boxes.size());
}

/// The hit of nearest_facing() among facets in ascending order.
std::optional<SurfaceHit> nearest_among(const std::vector<int>& candidates, const IndexedVector<Facet>& facets,
                                        const Matrix3Xd& positions, const Ray& ray, const AcceptHit& accept) {
  const auto length = [](const SurfaceHit& hit) { return std::abs(hit.gap) + hit.outside; };
  std::optional<SurfaceHit> best;
  for (const int candidate : candidates) {
    const std::optional<SurfaceHit> hit = facing_hit(candidate, facets, positions, ray);
    if (hit && (!best || length(*hit) < length(*best)) && (!accept || accept(*hit))) best = hit;
  }
  return best;
}

}  // namespace

FacetTree::FacetTree(const IndexedVector<Facet>& facets, const Matrix3Xd& positions, double margin) {
  std::vector<int> ids(facets.size());
  std::iota(ids.begin(), ids.end(), 0);
  const std::vector<Box> boxes = enlarged_boxes(facets, positions, margin);
  tree_.init(ids.begin(), ids.end(), boxes.begin(), boxes.end());
}

std::vector<int> FacetTree::candidates(const Vector3d& origin, const Vector3d& direction, double reach,
                                       double width) const {
  SegmentCollector collector{{origin, reach * direction, width}, {}};
  Eigen::BVIntersect(tree_, collector);
  std::sort(collector.found.begin(), collector.found.end());
  return std::move(collector.found);
}

double Reach::ahead(const Facet& facet, const Matrix3Xd& position) const {
  if (!by_facet) return Ray::unlimited;
  return parallel_reach * longest_edge(facet, position) + std::max(offset, 0.0);
}

bool surfaces_within_reach(const Matrix3Xd& x1, const Matrix3Xd& x2, double reach) {
  if (x1.cols() == 0 || x2.cols() == 0) return false;
  return surface_box(x1).exteriorDistance(surface_box(x2)) <= reach;
}

std::optional<SurfaceHit> facing_hit(int index, const IndexedVector<Facet>& facets, const Matrix3Xd& positions,
                                     const Ray& ray) {
  const Facet& facet = facets[index];
  const FacetCoordinates x = facet_coordinates(facet, positions);
  const std::optional<RayHit> hit = intersect(facet.type, x, ray.origin, ray.direction, ray.tolerance);
  if (!hit || hit->gap > ray.reach || hit->gap < -ray.backwards()) return std::nullopt;
  const Eigen::Matrix<double, 3, 2> tangents = x * shape_functions(facet.type, hit->eta).gradient;
  const Vector3d area = tangents.col(0).cross(tangents.col(1));
  if (area.dot(ray.direction) >= 0) return std::nullopt;
  const Vector3d& normal = ray.normal.isZero(0) ? ray.direction : ray.normal;
  const Vector3d middle = middle_normal(facet.type, x);
  if (facing_share(normal, middle) == 0 || hit->gap > tilted_reach(normal, middle) * ray.ahead) return std::nullopt;
  const double outside = distance_outside(facet.type, hit->eta) * tangents.colwise().norm().maxCoeff();
  return SurfaceHit{index, hit->eta, hit->gap, outside};
}

std::optional<SurfaceHit> nearest_facing(const FacetTree& tree, const IndexedVector<Facet>& facets,
                                         const Matrix3Xd& positions, const Ray& ray, const AcceptHit& accept) {
  const Segment looked = looked_along(ray);
  return nearest_among(tree.candidates(looked.middle, ray.direction, looked.half.norm()), facets, positions, ray,
                       accept);
}

std::optional<SurfaceHit> nearest_facing_or_passed(const FacetTree& tree, const IndexedVector<Facet>& facets,
                                                   const Matrix3Xd& positions, Ray ray, const AcceptHit& accept) {
  std::optional<SurfaceHit> hit = nearest_facing(tree, facets, positions, ray, accept);
  if (hit) return hit;
  ray.tolerance = widest_miss;
  hit = nearest_facing(tree, facets, positions, ray, accept);
  if (hit && hit->outside > largest_miss * std::abs(hit->gap)) hit.reset();
  return hit;
}

void MovingSurface::move_to(const IndexedVector<Facet>& facets, const Matrix3Xd& positions) {
  positions_ = positions;
  boxes_ = enlarged_boxes(facets, positions, box_margin);
  if (tree_) {
    const double moved = (positions - reference_).cwiseAbs().maxCoeff();
    if (moved * (1 + 2 * std::sqrt(3.0) * box_margin) <= slack_) return;
  }
  reference_ = positions;
  tree_.emplace(facets, positions, box_margin);
  slack_ = slack_fraction * mean_diagonal(boxes_);
  ++references_;
}

bool MovingSurface::holds(const RayNeighbours& neighbours, const std::array<Vector3d, 2>& ends) const {
  return neighbours.reference == references_ && (ends[0] - neighbours.ends[0]).cwiseAbs().maxCoeff() <= slack_ &&
         (ends[1] - neighbours.ends[1]).cwiseAbs().maxCoeff() <= slack_;
}

std::optional<SurfaceHit> MovingSurface::nearest_facing(const IndexedVector<Facet>& facets, const Ray& ray,
                                                        RayNeighbours& neighbours,
                                                        const std::function<void(std::vector<int>&)>& keep_visible,
                                                        const AcceptHit& accept) const {
  const Segment looked = looked_along(ray);
  const std::array<Vector3d, 2> ends{looked.middle - looked.half, looked.middle + looked.half};
  if (!tree_) return std::nullopt;
  if (!holds(neighbours, ends)) {
    neighbours = {ends, references_, tree_->candidates(looked.middle, ray.direction, looked.half.norm(), 2 * slack_)};
    if (keep_visible) keep_visible(neighbours.facets);
  }
  return nearest_among(meeting(looked, neighbours.facets, boxes_), facets, positions_, ray, accept);
}

std::vector<int> MovingSurface::met(const Vector3d& from, const Vector3d& direction, double length) const {
  if (!tree_) return {};
  const Segment way{from + 0.5 * length * direction, 0.5 * length * direction, 0};
  return meeting(way, tree_->candidates(way.middle, direction, 0.5 * length, 2 * slack_), boxes_);
}

std::size_t MovingSurface::memory() const {
  return bytes(positions_) + bytes(reference_) + boxes_.capacity() * sizeof(Eigen::AlignedBox3d);
}

}  // namespace mixture_contact
