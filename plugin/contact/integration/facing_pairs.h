/// Two surfaces with the pairs of facets that face each other, and the integration points in between, with their
/// kinematics where the pairs were found last.
#pragma once

#include "base/patch.h"
#include "base/timings.h"
#include "geometry/flat_pair.h"
#include "integration/points.h"

#include <iterator>
#include <optional>

namespace mixture_contact {

/// The number of a pair among these pairs, of which it is one, and not a copy.
inline Index number_of(const FacetPair& pair, const IndexedVector<FacetPair>& pairs) {
  return std::distance(pairs.data(), &pair);
}

class FacingPairs {
 public:
  /// Keeps references to the surfaces and their effects.
  FacingPairs(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings);

  /// Finds the facets that face each other within reach, the nearest of them for each point.
  void search(const FacingPositions& x, const Reach& reach);
  /// Finds the points at new positions without a search: they keep to the facets that the last search() found for them.
  void project_on_same_facets(const FacingPositions& x);
  /// Begins and ends the iterations of the points (see PointFinder). An iteration that begins makes a search if that
  /// would now find others, and returns so.
  bool begin_iteration(const FacingPositions& x);
  void end_iterations() { has_kept_ = finder_->end_iterations() || has_kept_; }
  /// Lets only facets with one of these nodes take part, from the next search on.
  void restrict_to(NodeFlags nodes) {
    restriction_ = std::move(nodes);
    searched_at_ = {};
  }
  bool is_restricted() const { return restriction_.has_value(); }
  void clear() {
    found_.clear();
    kinematics_.clear();
    first_kept_.clear();
    flat_.clear();
    searched_at_ = {};
  }

  const SurfaceMesh& primary() const { return primary_; }
  const SurfaceMesh& secondary() const { return secondary_; }
  const Effects& effects() const { return effects_; }
  const IndexedVector<FacetPair>& pairs() const { return found_.pairs(); }
  PointsOfPair points(const FacetPair& pair) const { return found_.points(pair); }
  /// Half the diagonal of the primary surface where the last search was made [mm].
  double surface_size() const { return surface_size_; }

  const Facet& primary_facet(const FacetPair& pair) const { return primary_.facets[pair.primary]; }
  const Facet& secondary_facet(const FacetPair& pair) const { return secondary_.facets[pair.secondary]; }
  /// The fields that both facets of a pair let through.
  IndexedVector<int> exchanged_fields(const FacetPair& pair) const;
  /// The nodes of both facets with their displacements and exchanged fields, in the memory of those of another pair.
  void set_patch(const FacetPair& pair, Patch& patch) const;
  /// Nodal values of a field on both facets.
  PairVector values(const FacetPair& pair, int field, const FacingFields& fields) const;
  /// Whether any of the nodes of the primary facet is among those given.
  bool has_node_among(const FacetPair& pair, const NodeFlags& nodes) const;
  /// The pairs whose primary facet contains a node, for each of the given nodes.
  Lists<const FacetPair*> around(const NodeFlags& nodes) const;
  /// Whether points move over the primary facets as the surfaces move.
  bool moves_points() const { return finder_->moves_points(); }
  /// How the points of a pair move with the nodes: calls `use` for each in their order.
  void for_each_motion(const FacetPair& pair, const FacingPositions& x, const UseMotion& use) const {
    finder_->for_each_motion(pair, points(pair), x.primary, x.secondary, use);
  }

  /// Kinematics of a point of a pair that is not flat, at the positions where it was found.
  const PointKinematics& kinematics(const FacetPair& pair, Index point) const {
    return kinematics_[first_kept_[number_of(pair, pairs())] + point];
  }
  /// A fully covered pair, where it was found; null of any other, and with friction, which takes points alone.
  const FlatPair* flat(const FacetPair& pair) const {
    return has_moments(pair) ? &flat_[number_of(pair, pairs())] : nullptr;
  }
  std::size_t memory() const;

 private:
  void keep(FacetPairs found, const FacingPositions& x);
  bool has_moments(const FacetPair& pair) const {
    return pair.unbroken && effects_.traction && !effects_.has_friction();
  }
  void evaluate(const FacetPair& pair, const FacingPositions& x);
  void evaluate_all(const FacingPositions& x);

  const SurfaceMesh& primary_;
  const SurfaceMesh& secondary_;
  const Effects& effects_;
  std::unique_ptr<PointFinder> finder_;
  FacetPairs found_;
  IndexedVector<PointKinematics>
      kinematics_;                   ///< of points of pairs that are not flat, with start values of the next search
  IndexedVector<Index> first_kept_;  ///< per pair the place of its first point among those
  IndexedVector<FlatPair> flat_;     ///< per pair, of those that are
  std::optional<NodeFlags> restriction_;
  Reach reach_ = 0;  ///< of the last search
  struct Positions {
    Matrix3Xd primary;
    Matrix3Xd secondary;
  };
  Positions searched_at_;  ///< where the pairs were found; empty if another search is due
  bool has_kept_ = false;  ///< whether pairs may be among these that iterations have kept, which have ended
  double surface_size_ = 0;
};

/// The nodes of both facets of a pair with their displacements and exchanged fields.
Patch patch_of(const FacingPairs& facing, const FacetPair& pair);

/// Points of all pairs.
Index point_count(const FacingPairs& facing);

/// The number of pairs for which one of them stands where it is timed.
inline Index stands_for(const FacingPairs& facing, const FacetPair& pair) {
  return stands_for(number_of(pair, facing.pairs()), facing.pairs().count());
}

}  // namespace mixture_contact
