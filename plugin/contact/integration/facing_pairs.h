/// The pairs of facing facets of two surfaces, with their integration points and the kinematics of these points.
#pragma once

#include "base/patch.h"
#include "base/timings.h"
#include "geometry/flat_pair.h"
#include "integration/points.h"

#include <iterator>
#include <optional>

namespace mixture_contact {

/// The number of a pair in a list of pairs. `pair` must be an element of the list, not a copy.
inline Index number_of(const FacetPair& pair, const IndexedVector<FacetPair>& pairs) {
  return std::distance(pairs.data(), &pair);
}

/// The integrals over a fully covered pair of flat facets on which averages depend.
enum class FlatIntegrals : std::uint8_t {
  moments,  ///< the moments of FlatPair
  points    ///< sums over points, of functions that have no such moments
};

/// The pairs of facing facets between a primary and a secondary surface, their integration points, and the kinematics
/// at the positions of the last search or projection.
class FacingPairs {
 public:
  /// Keeps references to both meshes and to the effects.
  FacingPairs(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings, FlatIntegrals integrals);

  /// Finds all pairs of facets that face each other within reach, and their integration points. Each point is paired
  /// with the nearest facing facet.
  void search(const FacingPositions& x, const Reach& reach);
  /// Projects the points at new positions onto the secondary facets that the last search() found for them.
  void project_on_same_facets(const FacingPositions& x);
  /// Begins a Newton iteration of the point finder (see PointFinder::keep_lost_points()). If the finder would now find
  /// other pairs, it searches again and returns true.
  bool keep_lost_points(const FacingPositions& x);
  /// Ends the Newton iterations of the point finder (see PointFinder::end_iterations()).
  void end_iterations() { has_kept_ = finder_->end_iterations() || has_kept_; }
  /// Restricts the pairs to those whose primary facet has at least one of these nodes, from the next search on.
  void restrict_to(NodeFlags nodes) {
    restriction_ = std::move(nodes);
    searched_at_ = {};
  }
  bool is_restricted() const { return restriction_.has_value(); }
  /// Removes all pairs and their points.
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
  /// Half the diagonal of the box around the primary surface at the last search [mm].
  double surface_size() const { return surface_size_; }

  const Facet& primary_facet(const FacetPair& pair) const { return primary_.facets[pair.primary]; }
  const Facet& secondary_facet(const FacetPair& pair) const { return secondary_.facets[pair.secondary]; }
  /// Indices of the scalar fields to which both facets of a pair are permeable.
  IndexedVector<int> exchanged_fields(const FacetPair& pair) const;
  /// Sets the patch of a pair: the nodes of both facets, their displacements and their exchanged fields. It reuses the
  /// memory of `patch`.
  void set_patch(const FacetPair& pair, Patch& patch) const;
  /// Nodal values of a field at the nodes of the primary facet, then of the secondary facet.
  PairVector values(const FacetPair& pair, int field, const FacingFields& fields) const;
  /// True if a node of the pair's primary facet is among the given nodes.
  bool has_node_among(const FacetPair& pair, const NodeFlags& nodes) const;
  /// For each given node, the pairs whose primary facet contains the node.
  Lists<const FacetPair*> around(const NodeFlags& nodes) const;
  /// True if the integration points or their weights vary with the nodal positions.
  bool moves_points() const { return finder_->moves_points(); }
  /// Calls `use` with the motion of each point of a pair, in the order of the points.
  void for_each_motion(const FacetPair& pair, const FacingPositions& x, const UseMotion& use) const {
    finder_->for_each_motion(pair, points(pair), {primary_.facets, secondary_.facets}, x, use);
  }

  /// Kinematics of a point of a pair without moments (see flat()), at the positions of the last search or projection.
  const PointKinematics& kinematics(const FacetPair& pair, Index point) const {
    return kinematics_[first_kept_[number_of(pair, pairs())] + point];
  }
  /// The moments of a fully covered pair of flat facets. Null for any other pair, and for every pair of a contact whose
  /// averages need sums over points.
  const FlatPair* flat(const FacetPair& pair) const {
    return has_moments(pair) ? &flat_[number_of(pair, pairs())] : nullptr;
  }
  std::size_t memory() const;

 private:
  /// Takes over the pairs that a search or a projection at positions x found, and evaluates them.
  void keep(FacetPairs found, const FacingPositions& x);
  /// True if the pair is integrated by moments (FlatPair) and not point by point.
  bool has_moments(const FacetPair& pair) const {
    return pair.unbroken && effects_.traction && integrals_ == FlatIntegrals::moments;
  }
  /// Evaluates the moments of a pair, or the kinematics of its points.
  void evaluate(const FacetPair& pair, const FacingPositions& x);
  void evaluate_all(const FacingPositions& x);

  const SurfaceMesh& primary_;
  const SurfaceMesh& secondary_;
  const Effects& effects_;
  FlatIntegrals integrals_;
  std::unique_ptr<PointFinder> finder_;
  FacetPairs found_;
  IndexedVector<PointKinematics> kinematics_;  ///< kinematics of the points of all pairs without moments
  IndexedVector<Index> first_kept_;            ///< per pair, index of its first point in `kinematics_`
  IndexedVector<FlatPair> flat_;               ///< per pair; valid for pairs with moments only
  std::optional<NodeFlags> restriction_;       ///< nodes of the primary surface to which the pairs are restricted
  Reach reach_ = 0;                            ///< reach of the last search
  struct Positions {
    Matrix3Xd primary;
    Matrix3Xd secondary;
  };
  Positions searched_at_;  ///< positions at the last search; empty if the next search may not reuse its pairs
  bool has_kept_ = false;  ///< true if pairs may remain that were kept only until the iterations ended
  /// Half the diagonal of the box around the primary surface [mm].
  double surface_size_ = 0;
};

/// The patch of a pair: the nodes of both facets with their displacements and exchanged fields.
Patch patch_of(const FacingPairs& facing, const FacetPair& pair);

/// The deepest overlap of points at these positions, over the pairs with a primary node among the given ones [length];
/// 0 if none overlaps.
double deepest_overlap(const FacingPairs& facing, const FacingPositions& x, const NodeFlags& nodes);

/// The number of integration points of all pairs.
Index point_count(const FacingPairs& facing);

/// The number of pairs that a timed pair represents, if only a sample of the pairs is timed; 0 for a pair that is not
/// timed.
inline Index stands_for(const FacingPairs& facing, const FacetPair& pair) {
  return stands_for(number_of(pair, facing.pairs()), facing.pairs().count());
}

}  // namespace mixture_contact
