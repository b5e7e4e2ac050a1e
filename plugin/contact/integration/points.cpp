#include "integration/points.h"

#include "base/bytes.h"
#include "base/in_order.h"
#include "geometry/quadrature.h"
#include "geometry/sub_facets.h"
#include "integration/facing_share.h"
#include "integration/segments.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// Groups the points of a primary surface, which are added facet by facet, by their pairs of facets.
class ByPair {
 public:
  void add(int primary, int secondary, const IntegrationPoint& point) {
    if (primary != primary_) finish_facet();
    primary_ = primary;
    of_facet_.push_back({secondary, point});
  }
  FacetPairs finish() {
    finish_facet();
    return std::move(pairs_);
  }

 private:
  struct PairedPoint {
    int secondary;
    IntegrationPoint point;
  };
  /// Makes the pairs of the current primary facet, in the order of their first points.
  void finish_facet() {
    for (auto first = of_facet_.begin(); first != of_facet_.end();) {
      const int secondary = first->secondary;
      pairs_.add_pair(primary_, secondary);
      const auto others = std::stable_partition(first, of_facet_.end(),
                                                [&](const PairedPoint& point) { return point.secondary == secondary; });
      for (; first != others; ++first) pairs_.add_point(first->point);
    }
    of_facet_.clear();
  }

  FacetPairs pairs_;
  int primary_ = 0;
  std::vector<PairedPoint> of_facet_;
};

/// The facing share of a primary and a secondary facet.
double share_of(const FacingFacets& facets, int primary, int secondary, const FacingPositions& x) {
  return facing_share(middle_normal(facets.primary[primary], x.primary),
                      middle_normal(facets.secondary[secondary], x.secondary));
}

}  // namespace

void FacetPairs::clear() {
  pairs_.clear();
  points_.clear();
}

void FacetPairs::add_point(const IntegrationPoint& point) {
  points_.push_back(point);
  ++pairs_.back().points;
}

void FacetPairs::add(const FacetPairs& others, const FacetPair& pair) {
  add_pair(pair.primary, pair.secondary);
  pairs_.back().unbroken = pair.unbroken;
  const PointsOfPair of_pair = others.points(pair);
  points_.insert(points_.end(), of_pair.begin(), of_pair.end());
  pairs_.back().points = of_pair.count();
}

void FacetPairs::set_unbroken() {
  for (FacetPair& pair : pairs_) pair.unbroken = true;
}

void FacetPairs::remove_last_pair() {
  points_.resize(indexing::entries(pairs_.back().first));
  pairs_.pop_back();
}

std::size_t FacetPairs::memory() const { return bytes(pairs_) + bytes(points_); }

Ray normal_ray(FacetType type, const FacetCoordinates& x, const Vector2d& xi, double reach, double tolerance) {
  const ShapeFunctions shape = shape_functions(type, xi);
  const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
  return {x * shape.value, tangents.col(0).cross(tangents.col(1)).normalized(), reach, tolerance};
}

PlacedPoint placed_point(const Facet& primary, const Facet& secondary, const IntegrationPoint& point,
                         const Matrix3Xd& x1, const Matrix3Xd& x2) {
  const Ray ray = normal_ray(primary, x1, point.xi, 0, 0);
  return {ray, facet_coordinates(secondary, x2) * shape_functions(secondary.type, point.eta).value - ray.origin};
}

void use_no_motion(Index points, const UseMotion& use) {
  for (Index q = 0; q < points; ++q) use({});
}

std::unique_ptr<PointFinder> point_finder(const SurfaceMesh& primary, const SurfaceMesh& secondary,
                                          const Settings& settings) {
  SelfContact self(primary, secondary);
  Visibility visibility(primary, secondary);
  if (settings.integration == Integration::segments) {
    return std::make_unique<Segments>(settings.integration_order, std::move(self), EdgeNeighbours(secondary),
                                      std::move(visibility));
  }
  return std::make_unique<GaussPoints>(primary.facets, settings.integration_order, settings.search.tolerance,
                                       std::move(self), std::move(visibility));
}

GaussPoints::GaussPoints(const IndexedVector<Facet>& primary, int order, double tolerance, SelfContact self,
                         Visibility visibility)
    : tolerance_(tolerance), self_(std::move(self)), visibility_(std::move(visibility)) {
  for (int f = 0; f < primary.count(); ++f) {
    const FacetType type = primary[f].type;
    for (const QuadraturePoint& q : quadrature(type, order > 0 ? order : default_quadrature_order(type))) {
      points_.push_back({f, q.xi, q.weight, sub_facet_at(type, q.xi)});
    }
  }
  histories_.resize(points_.size());
  neighbours_.resize(points_.size());
}

bool GaussPoints::keep_lost_points() {
  bool finds_more = false;
  for (ProjectionHistory& history : histories_) {
    const bool lost = history.at_iteration != unpaired && history.facet == unpaired;
    if (lost && ++history.losses == most_losses) finds_more = true;
    if (history.facet != unpaired) history.last = history.facet;
    history.at_iteration = history.facet;
  }
  return finds_more;
}

bool GaussPoints::end_iterations() {
  const bool kept_any = std::any_of(histories_.begin(), histories_.end(),
                                    [](const ProjectionHistory& history) { return history.is_kept(); });
  for (ProjectionHistory& history : histories_) history = {history.facet};
  return kept_any;
}

Ray GaussPoints::ray_from(const Point& point, const Facet& facet, const Matrix3Xd& x1, const Reach& reach) const {
  Ray ray = normal_ray(facet, x1, point.xi, reach.distance, tolerance_);
  ray.overlap = self_.largest_overlap(point.facet);
  ray.beyond = reach.beyond;
  if (!self_.is_active()) ray.ahead = reach.ahead(facet, x1);
  ray.normal = middle_normal(facet, x1);
  return ray;
}

FacetPairs GaussPoints::paired(const std::function<std::optional<Partner>(Index)>& partner_of) {
  has_shares_ = false;
  ByPair pairs;
  in_order(points_.count(), partner_of, [&](Index q, const std::optional<Partner>& partner) {
    if (!partner || partner->share == 0) return;
    const Point& point = points_[q];
    histories_[q].facet = partner->facet;
    has_shares_ = has_shares_ || partner->share < 1;
    pairs.add(point.facet, partner->facet, {point.xi, partner->eta, partner->share * point.weight, point.sub_facet});
  });
  return pairs.finish();
}

FacetPairs GaussPoints::search(const FacingFacets& facets, const FacingPositions& x, const Reach& reach) {
  for (ProjectionHistory& history : histories_) history.facet = unpaired;
  has_shares_ = false;
  if (!surfaces_within_reach(x.primary, x.secondary, reach.backwards())) return {};
  moving_.move_to(facets.secondary, x.secondary);
  visibility_.move_to(x.primary, x.secondary);
  const auto hit_of = [&](Index q) {
    const Point& point = points_[q];
    Ray ray = ray_from(point, facets.primary[point.facet], x.primary, reach);
    std::optional<SurfaceHit> hit = moving_.nearest_facing(
        facets.secondary, ray, neighbours_[q], [&](std::vector<int>& near) { self_.keep_visible(point.facet, near); },
        [&](const SurfaceHit& found) {
          return !visibility_.is_hidden(ray.origin, ray.direction, found.gap, point.facet, found.facet);
        });
    if (hit || !histories_[q].is_kept()) return hit;
    ray.tolerance = widest_miss;
    return facing_hit(histories_[q].last, facets.secondary, x.secondary, ray);
  };
  return paired([&](Index q) -> std::optional<Partner> {
    const std::optional<SurfaceHit> hit = hit_of(q);
    if (!hit) return std::nullopt;
    return Partner{hit->facet, hit->eta, share_of(facets, points_[q].facet, hit->facet, x)};
  });
}

std::size_t GaussPoints::memory() const {
  std::size_t sum = self_.memory() + visibility_.memory() +
                    points_.size() * (sizeof(Point) + sizeof(ProjectionHistory) + sizeof(RayNeighbours));
  for (const RayNeighbours& ray : neighbours_) sum += ray.facets.capacity() * sizeof(int);
  return sum;
}

void GaussPoints::for_each_motion(const FacetPair& pair, const PointsOfPair& points, const FacingFacets& facets,
                                  const FacingPositions& x, const UseMotion& use) const {
  if (!has_shares_ || share_of(facets, pair.primary, pair.secondary, x) == 1) return use_no_motion(points.count(), use);
  const Facet& one = facets.primary[pair.primary];
  const Facet& two = facets.secondary[pair.secondary];
  PointMotion motion;
  motion.weight = facing_share_variation(one.type, facet_coordinates(one, x.primary), two.type,
                                         facet_coordinates(two, x.secondary));
  motion.xi = PairVariation<2>::Zero(2, motion.weight.cols());
  for (Index q = 0; q < points.count(); ++q) use(motion);
}

FacetPairs GaussPoints::on_same_facets(const FacingFacets& facets, const FacingPositions& x) {
  return paired([&](Index q) -> std::optional<Partner> {
    const ProjectionHistory& history = histories_[q];
    if (history.facet == unpaired) return std::nullopt;
    const Point& point = points_[q];
    const Facet& facet = facets.secondary[history.facet];
    const double tolerance = history.is_kept() ? widest_miss : tolerance_;
    const Ray ray = normal_ray(facets.primary[point.facet], x.primary, point.xi, 0, tolerance);
    const auto hit = intersect(facet.type, facet_coordinates(facet, x.secondary), ray.origin, ray.direction,
                               ray.tolerance);
    if (!hit) return std::nullopt;
    return Partner{history.facet, hit->eta, share_of(facets, point.facet, history.facet, x)};
  });
}

}  // namespace mixture_contact
