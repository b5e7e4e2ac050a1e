/// Nodal averages over the integration points around each node of the primary surface of a pass.
#pragma once

#include "mortar/boundary_weights.h"
#include "mortar/slips.h"

#include <memory>
#include <optional>

namespace mixture_contact {

/// The pairs of a pass with the weights of its nodal averages. It computes gaps, jumps and slips at nodes.
class MortarSpace {
 public:
  /// Keeps references to the meshes and to the effects.
  MortarSpace(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings);

  /// The pairs for modification. It discards the nodal gaps, which are then computed again.
  FacingPairs& change_facing() {
    gaps_.reset();
    return facing_;
  }
  const FacingPairs& facing() const { return facing_; }
  /// Begins an iteration of the pairs. Returns true if other pairs were found.
  bool keep_lost_points(const FacingPositions& x);
  const Effects& effects() const { return facing_.effects(); }
  Index nodes() const { return facing_.primary().nodes; }

  /// Decides which nodes bear load, for facets that newly face the other surface.
  void update_boundary_weights(const FacingPositions& x);
  /// The boundary weights for modification. It discards the nodal gaps, which are then computed again.
  BoundaryWeights& boundary_weights() {
    gaps_.reset();
    return weights_;
  }
  const BoundaryWeights& boundary_weights() const { return weights_; }
  /// The functions psi_a at a point of a primary facet (see BoundaryWeights::shape).
  ShapeFunctions shape(int primary_facet, int sub_facet, const Vector2d& xi) const {
    return weights_.shape(primary_facet, facing_.primary().facets[primary_facet].type, sub_facet, xi);
  }

  /// Calls by_moments(flat) for a pair that is integrated by moments (see FacingPairs::flat), with the redistributed
  /// functions psi_a; else by_points(). No other code makes this choice.
  template <class ByMoments, class ByPoints>
  void integrate(const FacetPair& pair, const ByMoments& by_moments, const ByPoints& by_points) const {
    if (const FlatPair* flat = facing_.flat(pair)) return by_moments(redistributed(*flat, pair));
    by_points();
  }
  /// Calls use(point, kinematics, psi) for each point of a pair, in order. `psi`: functions psi_a at the point.
  template <class Use>
  void for_each_point(const FacetPair& pair, const Use& use) const {
    const PointsOfPair points = facing_.points(pair);
    for (Index q = 0; q < points.count(); ++q) {
      const FacetVector psi = shape(pair.primary, points[q].sub_facet, points[q].xi).value;
      use(points[q], facing_.kinematics(pair, q), psi);
    }
  }

  /// The averages of slips; those of a contact without friction while no tractions are exchanged.
  const SlipAverages& slips() const;
  /// The averages of slips with the start of the step, which they keep while no tractions are exchanged.
  SlipAverages& kept_slips() const { return *slips_; }

  /// The average gaps at the positions of the last search or projection.
  const NodalGaps& gaps() const;
  /// The averages of a state: the given gaps, and the jumps and slips of nodes with the given contact status. Loads are
  /// not set.
  NodalLoads averages(NodalGaps gaps, const FacingFields& fields, ContactStatus status) const;

  /// True if multipliers are unknowns of the equation system; every node then has equations of its own.
  bool has_unknown_multipliers() const { return unknown_multipliers_; }
  /// True if a node's averages include points of a pair, whose primary facet contains the node. The psi_a of a
  /// quadratic facet's node is zero on the linear pieces that do not contain the node.
  bool is_averaged_over(const FacetPair& pair, Index node) const;
  /// True if the averages of any of the given nodes include points of a pair.
  bool is_averaged_over(const FacetPair& pair, const NodeFlags& nodes) const;
  /// The nodes and fields on which a node's averages depend. `pairs`: the pairs around the node. With friction, the
  /// patch also contains the nodes of all primary facets around the node, on which its convection depends.
  Patch node_patch(Index node, const PairsAround& pairs) const;
  /// The unknowns on which the rows of one field of a patch depend.
  Patch columns_of(const Patch& patch, int field) const;
  /// True if the tangent is symmetrised.
  bool symmetric() const { return symmetric_; }
  /// The gap at which the surfaces touch [mm]; average gaps are relative to it.
  double offset() const { return offset_; }
  /// Sets the gap at which the surfaces touch [mm].
  void measure_gaps_from(double offset);

  /// The time that linearisations and tangents spend on each effect.
  EffectTimings& effect_times() const { return effect_times_; }
  /// Memory of pairs, weights and convections [bytes].
  std::size_t memory() const;
  /// Integrals over a pair from which nodal gaps are averaged.
  FacetGapSums gap_sums(const FacetPair& pair) const;

 private:
  /// A flat pair with the redistributed functions psi_a.
  FlatPair redistributed(FlatPair flat, const FacetPair& pair) const;
  NodalGaps averaged_gaps() const;
  /// Sets NodalLoads::jump, flux_area and own.
  void average_jumps(const FacingFields& fields, NodalLoads& loads) const;

  std::unique_ptr<SlipAverages> slips_;
  FacingPairs facing_;
  BoundaryWeights weights_;
  bool redistributes_;  ///< true if functions of partly covered facets are redistributed, which segments require
  bool unknown_multipliers_;
  bool symmetric_;
  double offset_;
  mutable EffectTimings effect_times_;  ///< measured times, on which no result depends
  /// Average gaps with the present pairs and weights, computed when first needed.
  mutable std::optional<NodalGaps> gaps_;
};

/// Values of the exchanged fields at the primary nodes, in the order of NodalLoads::own.
inline MatrixXd own_values(const FacingFields& fields, const Effects& effects) {
  return fields.primary.scalar.leftCols(effects.scalar_fields()).transpose();
}

/// Nodes of facets that overlap with the other surface in part, even if the nodes' average gaps are open.
NodeFlags overlapped_nodes(const MortarSpace& space);
/// Nodes of the facets that are nearest to the other surface, if a small part of a facet's size separates them. None if
/// surfaces overlap or are farther away.
NodeFlags nearest_nodes(const MortarSpace& space);

}  // namespace mixture_contact
