#include "integration/segments.h"

#include "base/in_order.h"
#include "base/local_memory.h"
#include "integration/facet_overlap.h"
#include "integration/facing_share.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace mixture_contact {
namespace {

/// True if the secondary surface continues, in other pairs of the same primary facet, across every edge of its facets
/// that lies over the facet. `piece`: the only linear piece of the primary facet.
bool goes_on(const FacetPairs& of_facet, const Piece<double>& piece, const IndexedVector<Facet>& others,
             const EdgeNeighbours& neighbours, const Matrix3Xd& x2) {
  const auto is_paired = [&](int other) {
    return std::any_of(of_facet.pairs().begin(), of_facet.pairs().end(),
                       [&](const FacetPair& pair) { return pair.secondary == other; });
  };
  return std::all_of(of_facet.pairs().begin(), of_facet.pairs().end(), [&](const FacetPair& pair) {
    const Facet& facet = others[pair.secondary];
    for (int corner = 0; corner < facet.count(); ++corner) {
      const std::optional<int> next = neighbours.across(pair.secondary, corner);
      if (next && is_paired(*next)) continue;
      const auto seen = [&](int node) { return piece.view.seen(x2.col(facet.node(node % facet.count()))); };
      if (lies_over(piece, seen(corner), seen(corner + 1))) return false;
    }
    return true;
  });
}

/// True if all shape functions of a facet are polynomials of total degree 2 at most.
bool is_quadratic(FacetType type) {
  return type == FacetType::tri3 || type == FacetType::tri6 || type == FacetType::quad4;
}

bool share_a_node(const Facet& one, const Facet& two) {
  return std::any_of(one.nodes.begin(), one.nodes.begin() + node_count(one.type), [&](int node) {
    const auto* end = two.nodes.begin() + node_count(two.type);
    return std::find(two.nodes.begin(), end, node) != end;
  });
}

const IntegrationPoint& heaviest(const PointsOfPair& points) {
  return *std::max_element(points.begin(), points.end(),
                           [](const auto& one, const auto& two) { return one.weight < two.weight; });
}

/// Removes the pairs for which `leaves` is true; all are tested before any is removed. `rest`: memory for the remaining
/// pairs.
template <class Leaves>
void remove_pairs(FacetPairs& pairs, FacetPairs& rest, const Leaves& leaves) {
  if (std::none_of(pairs.pairs().begin(), pairs.pairs().end(), leaves)) return;
  rest.clear();
  for (const FacetPair& pair : pairs.pairs()) {
    if (!leaves(pair)) rest.add(pairs, pair);
  }
  std::swap(pairs, rest);
}

}  // namespace

int default_segment_order(FacetType primary, FacetType secondary) {
  return is_quadratic(primary) && is_quadratic(secondary) ? 2 : 3;
}

Segments::Segments(int order, SelfContact self, EdgeNeighbours neighbours, Visibility visibility)
    : order_(order), self_(std::move(self)), neighbours_(std::move(neighbours)), visibility_(std::move(visibility)) {}

int Segments::order(const FacingFacets& facets, const Facing& facing) const {
  if (order_ > 0) return order_;
  return default_segment_order(facets.primary[facing.primary].type, facets.secondary[facing.secondary].type);
}

bool Segments::is_exact(const FacingFacets& facets, const FacetPair& pair) const {
  const bool flat = is_flat(facets.primary[pair.primary].type) && is_flat(facets.secondary[pair.secondary].type);
  return flat && order(facets, {pair.primary, pair.secondary}) >= 2;
}

bool Segments::sees(const FacetPair& pair, const IntegrationPoint& point, const SearchedSurfaces& at) const {
  const Facet& one = at.facets.primary[pair.primary];
  const Facet& two = at.facets.secondary[pair.secondary];
  const PlacedPoint placed = placed_point(one, two, point, at.x.primary, at.x.secondary);
  const double gap = placed.gap();
  const double tilted = tilted_reach(middle_normal(one, at.x.primary), middle_normal(two, at.x.secondary));
  const bool is_near = self_.is_active() || gap <= tilted * at.reach.ahead(one, at.x.primary);
  const bool is_within = gap <= at.reach.distance && placed.apart.norm() <= at.reach.backwards();
  return is_within && is_near && gap >= -self_.largest_overlap(pair.primary) &&
         !visibility_.is_hidden(placed.ray.origin, placed.ray.direction, gap, pair.primary, pair.secondary);
}

std::vector<int> Segments::candidates(int facet, const SearchedSurfaces& at) const {
  const Ray ray = normal_ray(at.facets.primary[facet], at.x.primary, parametric_centre(at.facets.primary[facet].type),
                             at.reach.distance, 0);
  const double width = radius_around(facet_coordinates(at.facets.primary[facet], at.x.primary), ray.origin);
  std::vector<int> found = at.tree.candidates(ray.origin, ray.direction, at.reach.backwards(), width);
  self_.keep_visible(facet, found);
  return found;
}

bool Segments::occluded(const FacetPair& pair, const FacetPairs& all, const SearchedSurfaces& at) {
  const Facet& one = at.facets.primary[pair.primary];
  const Facet& two = at.facets.secondary[pair.secondary];
  const IntegrationPoint& point = heaviest(all.points(pair));
  const PlacedPoint placed = placed_point(one, two, point, at.x.primary, at.x.secondary);
  const Ray& ray = placed.ray;
  return std::any_of(all.pairs().begin(), all.pairs().end(), [&](const FacetPair& rival) {
    const Facet& facet = at.facets.secondary[rival.secondary];
    if (is_flat(facet.type) && is_passed(at.circles[rival.secondary], ray.origin, ray.direction)) return false;
    if (share_a_node(facet, two)) return false;
    const auto hit = intersect(facet.type, facet_coordinates(facet, at.x.secondary), ray.origin, ray.direction,
                               ray.tolerance);
    return hit && std::abs(hit->gap) < placed.apart.norm();
  });
}

bool Segments::is_kept(const FacetPair& pair) const {
  const auto found = losses_.find({pair.primary, pair.secondary});
  return found != losses_.end() && found->second >= most_losses;
}

bool Segments::keep_lost_points() {
  std::vector<Facing> lost;
  std::set_difference(at_iteration_.begin(), at_iteration_.end(), paired_.begin(), paired_.end(),
                      std::back_inserter(lost));
  bool finds_more = false;
  for (const Facing& pair : lost) finds_more = ++losses_[pair] == most_losses || finds_more;
  at_iteration_ = paired_;
  return finds_more;
}

bool Segments::end_iterations() {
  const bool kept_any = std::any_of(losses_.begin(), losses_.end(),
                                    [](const auto& pair) { return pair.second >= most_losses; });
  at_iteration_.clear();
  losses_.clear();
  return kept_any;
}

void Segments::add_near(int facet, int other, const SampledFacet& one, const SearchedSurfaces& at,
                        FacetPairs& near) const {
  near.add_pair(facet, other);
  const FacetPair& pair = near.pairs().back();
  const int rule = order(at.facets, {facet, other});
  const bool faces = add_points_between(one, at.facets.secondary[other], at.x.secondary, at.circles[other], rule,
                                        near) &&
                     (is_kept(pair) || sees(pair, heaviest(near.points(pair)), at));
  if (!faces) near.remove_last_pair();
}

bool Segments::is_fully_covered(const FacetPairs& of_facet, const SampledFacet& one, const SearchedSurfaces& at) const {
  const auto exact = [&](const FacetPair& pair) {
    return is_exact(at.facets, pair) &&
           facing_share(one.normal, middle_normal(at.facets.secondary[pair.secondary], at.x.secondary)) == 1;
  };
  return std::all_of(of_facet.pairs().begin(), of_facet.pairs().end(), exact) &&
         goes_on(of_facet, one.pieces.front(), at.facets.secondary, neighbours_, at.x.secondary);
}

void Segments::find_pairs(int facet, const SearchedSurfaces& at, FacetPairs& near, FacetPairs& memory) const {
  near.clear();
  const std::vector<int> others = candidates(facet, at);
  if (others.empty()) return;
  LocalMemory<bytes_of_pieces<double>> pieces;
  const SampledFacet one = sampled(at.facets.primary[facet], at.x.primary, pieces.resource());
  for (const int other : others) add_near(facet, other, one, at, near);
  // Hidden pairs count in the test of the other pairs: a hidden facet hides others as well.
  remove_pairs(near, memory, [&](const FacetPair& pair) { return !is_kept(pair) && occluded(pair, near, at); });
  if (is_fully_covered(near, one, at)) near.set_unbroken();
}

FacetPairs Segments::search(const FacingFacets& facets, const FacingPositions& x, const Reach& reach) {
  FacetPairs found;
  paired_.clear();
  if (!surfaces_within_reach(x.primary, x.secondary, reach.backwards())) return found;
  visibility_.move_to(x.primary, x.secondary);
  const SearchedSurfaces at{facets, x, reach, FacetTree(facets.secondary, x.secondary, box_margin),
                            circles_around(facets.secondary, x.secondary)};
  const auto find = [&](Index facet, FacetPairs& near, FacetPairs& memory) {
    find_pairs(static_cast<int>(facet), at, near, memory);
  };
  const auto add_all = [&](Index /*facet*/, const FacetPairs& pairs) {
    for (const FacetPair& pair : pairs.pairs()) {
      paired_.push_back({pair.primary, pair.secondary});
      found.add(pairs, pair);
    }
  };
  in_order_with(FacetPairs(), FacetPairs(), facets.primary.count(), find, add_all);
  return found;
}

FacetPairs Segments::on_same_facets(const FacingFacets& facets, const FacingPositions& x) {
  FacetPairs found;
  for (const Facing& facing : paired_) {
    const Facet& two = facets.secondary[facing.secondary];
    LocalMemory<bytes_of_pieces<double>> memory;
    const SampledFacet one = sampled(facets.primary[facing.primary], x.primary, memory.resource());
    found.add_pair(facing.primary, facing.secondary);
    const Circle circle = circle_around(facet_coordinates(two, x.secondary));
    if (!add_points_between(one, two, x.secondary, circle, order(facets, facing), found)) found.remove_last_pair();
  }
  return found;
}

void Segments::for_each_motion(const FacetPair& pair, const PointsOfPair& points, const FacingFacets& facets,
                               const FacingPositions& x, const UseMotion& use) const {
  if (pair.unbroken) return use_no_motion(points.count(), use);
  for_each_overlap_motion(points, placed(facets.primary[pair.primary], x.primary),
                          placed(facets.secondary[pair.secondary], x.secondary),
                          order(facets, {pair.primary, pair.secondary}), use);
}

}  // namespace mixture_contact
