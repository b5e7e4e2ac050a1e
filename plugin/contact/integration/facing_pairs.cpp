#include "integration/facing_pairs.h"

#include "base/bytes.h"
#include "base/parallel.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace mixture_contact {
namespace {

/// True if positions are the same within the rounding of coordinates to which displacements are added. False if a
/// position is not a number.
bool is_same_place(const Matrix3Xd& one, const Matrix3Xd& other) {
  if (one.cols() != other.cols() || one.cols() == 0) return false;
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * one.cwiseAbs().maxCoeff();
  return ((one - other).array().abs() <= rounding).all();
}

/// Per pair, the index of its first point among the points of the pairs for which `counts` is true; last entry: the
/// number of these points.
template <class Counts>
IndexedVector<Index> first_points(const IndexedVector<FacetPair>& pairs, const Counts& counts) {
  IndexedVector<Index> places(1, 0);
  places.reserve(pairs.size() + 1);
  for (const FacetPair& pair : pairs) places.push_back(places.back() + (counts(pair) ? pair.points : 0));
  return places;
}

}  // namespace

FacingPairs::FacingPairs(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                         const Settings& settings, FlatIntegrals integrals)
    : primary_(primary),
      secondary_(secondary),
      effects_(effects),
      integrals_(integrals),
      finder_(point_finder(primary, secondary, settings)) {}

void FacingPairs::search(const FacingPositions& x, const Reach& reach) {
  surface_size_ = half_diagonal(x.primary);
  if (restriction_ && !any(*restriction_)) return clear();
  // If surfaces have moved by rounding only, the overlaps of their facets are unchanged. The gaps have to be evaluated
  // again, because a large penalty turns their rounding into loads.
  const bool has_overlaps = moves_points() && reach == reach_ && is_same_place(searched_at_.primary, x.primary) &&
                            is_same_place(searched_at_.secondary, x.secondary);
  if (has_overlaps) return evaluate_all(x);
  reach_ = reach;
  keep(finder_->search({primary_.facets, secondary_.facets}, x, reach), x);
  searched_at_ = {x.primary, x.secondary};
}

void FacingPairs::project_on_same_facets(const FacingPositions& x) {
  searched_at_ = {};
  keep(finder_->on_same_facets({primary_.facets, secondary_.facets}, x), x);
}

bool FacingPairs::keep_lost_points(const FacingPositions& x) {
  const auto search_anew = [&] {
    searched_at_ = {};  // the search finds other pairs at the same positions
    search(x, reach_);
  };
  const bool finds_less = std::exchange(has_kept_, false);
  if (finds_less) search_anew();
  const bool finds_more = finder_->keep_lost_points();
  if (finds_more) search_anew();
  return finds_less || finds_more;
}

void FacingPairs::keep(FacetPairs found, const FacingPositions& x) {
  if (restriction_) {
    found_.clear();
    for (const FacetPair& pair : found.pairs()) {
      if (has_node_among(pair, *restriction_)) found_.add(found, pair);
    }
  } else {
    found_ = std::move(found);
  }
  first_kept_ = first_points(pairs(), [&](const FacetPair& pair) { return !has_moments(pair); });
  const Index kept = first_kept_.back();
  if (kinematics_.count() < kept) kinematics_ = IndexedVector<PointKinematics>(kept);
  const bool has_flat = kept < found_.points().count();
  if (has_flat && flat_.count() < pairs().count()) flat_.resize(pairs().size());
  evaluate_all(x);
}

void FacingPairs::evaluate_all(const FacingPositions& x) {
  in_parallel(pairs().count(), [&](Index index) { evaluate(pairs()[index], x); });
}

IndexedVector<int> FacingPairs::exchanged_fields(const FacetPair& pair) const {
  const FieldMask both = primary_.permeable[pair.primary] & secondary_.permeable[pair.secondary];
  IndexedVector<int> fields;
  for (int k = 0; k < effects_.scalar_fields(); ++k) {
    if (contains(both, k)) fields.push_back(k);
  }
  return fields;
}

void FacingPairs::set_patch(const FacetPair& pair, Patch& patch) const {
  const Facet& one = primary_facet(pair);
  const Facet& two = secondary_facet(pair);
  patch.primary.assign(one.begin(), one.end());
  patch.secondary.assign(two.begin(), two.end());
  patch.fields = exchanged_fields(pair);
  patch.multiplier_node.reset();
  patch.displacements = effects_.traction;
}

void FacingPairs::evaluate(const FacetPair& pair, const FacingPositions& x) {
  if (has_moments(pair)) {
    FlatMoments moments;
    for (const IntegrationPoint& point : points(pair)) moments.add(point.weight, point.xi, point.eta);
    flat_[number_of(pair, pairs())] = flat_pair(moments, facet_coordinates(primary_facet(pair), x.primary),
                                                facet_coordinates(secondary_facet(pair), x.secondary));
    return;
  }
  const Facet& one = primary_facet(pair);
  const Facet& two = secondary_facet(pair);
  const FacetCoordinates x1 = facet_coordinates(one, x.primary);
  const FacetCoordinates x2 = facet_coordinates(two, x.secondary);
  const bool flat = is_flat(one.type) && is_flat(two.type);
  const PointsOfPair all = points(pair);
  const Index first = first_kept_[number_of(pair, pairs())];
  for (Index q = 0; q < all.count(); ++q) {
    PointKinematics& here = kinematics_[first + q];
    const ShapeFunctions primary = shape_functions(one.type, all[q].xi);
    const ShapeFunctions secondary = shape_functions(two.type, all[q].eta);
    if (q == 0 || !flat) {
      here = point_kinematics(primary, x1, secondary, x2);
    } else {
      here = kinematics_[first];
      move_on_flat_facets(here, primary.value, x1, secondary.value, x2);
    }
  }
}

PairVector FacingPairs::values(const FacetPair& pair, int field, const FacingFields& fields) const {
  const FacetVector one = facet_values(primary_facet(pair), fields.primary.scalar.col(field));
  const FacetVector two = facet_values(secondary_facet(pair), fields.secondary.scalar.col(field));
  PairVector values(one.size() + two.size());
  values << one, two;
  return values;
}

bool FacingPairs::has_node_among(const FacetPair& pair, const NodeFlags& nodes) const {
  return any_node(primary_facet(pair), nodes);
}

Lists<const FacetPair*> FacingPairs::around(const NodeFlags& nodes) const {
  return {primary_.nodes, [&](const auto& add) {
            for (const FacetPair& pair : pairs()) {
              for (const int node : primary_facet(pair)) {
                if (nodes[node]) add(node, &pair);
              }
            }
          }};
}

std::size_t FacingPairs::memory() const {
  return finder_->memory() + found_.memory() + bytes(kinematics_) + bytes(first_kept_) + bytes(flat_) +
         bytes(searched_at_.primary) + bytes(searched_at_.secondary);
}

Patch patch_of(const FacingPairs& facing, const FacetPair& pair) {
  Patch patch;
  facing.set_patch(pair, patch);
  return patch;
}

double deepest_overlap(const FacingPairs& facing, const FacingPositions& x, const NodeFlags& nodes) {
  double deepest = 0;
  for (const FacetPair& pair : facing.pairs()) {
    if (!facing.has_node_among(pair, nodes)) continue;
    for (const IntegrationPoint& point : facing.points(pair)) {
      const PlacedPoint placed = placed_point(facing.primary_facet(pair), facing.secondary_facet(pair), point,
                                              x.primary, x.secondary);
      if (placed.gap() < 0) deepest = std::max(deepest, placed.apart.norm());
    }
  }
  return deepest;
}

Index point_count(const FacingPairs& facing) {
  const IndexedVector<FacetPair>& pairs = facing.pairs();
  return std::accumulate(pairs.begin(), pairs.end(), Index{0},
                         [](Index sum, const FacetPair& pair) { return sum + pair.points; });
}

}  // namespace mixture_contact
