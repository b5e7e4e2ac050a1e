/// Nodal averages over the integration points around each node of the surface that a pass integrates over.
#pragma once

#include "base/timings.h"
#include "conditions/nodal_loads.h"
#include "geometry/slip.h"
#include "integration/facing_pairs.h"
#include "mortar/boundary_weights.h"

#include <optional>

namespace mixture_contact {

class MortarSpace {
 public:
  /// Keeps references to the surfaces and their effects.
  MortarSpace(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings);

  /// The pairs, for changes: all dependent quantities are computed again.
  FacingPairs& change_facing() {
    gaps_.reset();
    return facing_;
  }
  const FacingPairs& facing() const { return facing_; }
  /// Begins an iteration of the pairs. Returns whether their number has grown.
  bool begin_iteration(const FacingPositions& x);
  const Effects& effects() const { return facing_.effects(); }
  Index nodes() const { return facing_.primary().nodes; }

  /// Decides which nodes bear load, for new facets that face the other surface.
  void update_boundary_weights(const FacingPositions& x);
  BoundaryWeights& boundary_weights() {
    gaps_.reset();
    return weights_;
  }
  const BoundaryWeights& boundary_weights() const { return weights_; }
  /// Functions psi_a (see BoundaryWeights::shape).
  ShapeFunctions shape(int primary_facet, int sub_facet, const Vector2d& xi) const {
    return weights_.shape(primary_facet, sub_facet, xi);
  }

  /// A flat pair with these functions; empty of any other (see FacingPairs::flat).
  std::optional<FlatPair> flat(const FacetPair& pair) const;

  /// Sets the reference positions of slips, those of an accepted state.
  void measure_slips_from(const FacingPositions& past);
  FacingPositions past() const { return seen_from(Side::primary, past_); }
  /// Convections of the nodes of a primary facet, from the positions at the start of the step.
  const IndexedVector<Convection>& convections(int primary_facet) const { return convections_[primary_facet]; }
  double ambient_pressure() const { return friction_.ambient_pressure; }

  /// The gaps at which the pairs were found.
  const NodalGaps& gaps() const;
  /// The gaps of a state, and the jumps of nodes of a status there; without loads.
  NodalLoads averages(NodalGaps gaps, const FacingFields& fields, ContactStatus status) const;

  /// Whether multipliers are unknowns, so that every node has equations of its own.
  bool has_unknown_multipliers() const { return unknown_multipliers_; }
  /// Whether the averages of a node of a pair's primary facet, or of any that is among those given, are taken over
  /// points of the pair: the psi_a of a quadratic facet's node is zero on the sub-facets that do not have the node.
  bool is_averaged_over(const FacetPair& pair, Index node) const;
  bool is_averaged_over(const FacetPair& pair, const NodeFlags& nodes) const;
  /// The nodes and fields that the averages of a node are taken over, given the pairs around it; with friction also the
  /// nodes of all facets around it, which it convects with.
  Patch node_patch(Index node, const PairsAround& pairs) const;
  /// The unknowns that the rows of one field of a patch depend on.
  Patch columns_of(const Patch& patch, int field) const;
  /// Whether the settings require the symmetric part of the tangent.
  bool symmetric() const { return symmetric_; }
  /// Distance of the surfaces from which gaps are measured [mm].
  double offset() const { return offset_; }
  /// Sets the distance of the surfaces from which gaps are measured [mm].
  void measure_gaps_from(double offset);

  /// The time that linearising and tangents spend on single effects; the clock of the task takes it over.
  EffectTimings& effect_times() const { return effect_times_; }
  std::size_t memory() const;
  /// Integrals over a pair of facets that gaps are averaged from.
  FacetGapSums gap_sums(const FacetPair& pair) const;

 private:
  NodalGaps averaged_gaps() const;
  /// Sets the jumps, and the fields' own values at nodes.
  void average_jumps(const FacingFields& fields, NodalLoads& loads) const;

  FacingPairs facing_;
  BoundaryWeights weights_;
  bool redistributes_;  ///< on segments alone
  bool unknown_multipliers_;
  bool symmetric_;
  double offset_;
  const FrictionRule& friction_;
  IndexedVector<IndexedVector<Convection>> convections_;  ///< per primary facet and node, where there is friction
  PerSide<Matrix3Xd> past_;  ///< primary and secondary positions at the start of the step; empty without friction
  mutable EffectTimings effect_times_;     ///< a measurement, which no result depends on
  mutable std::optional<NodalGaps> gaps_;  ///< of these pairs and weights, computed on demand
};

/// Values of the exchanged fields at the primary nodes, in the order of NodalLoads::own.
inline MatrixXd own_values(const FacingFields& fields, const Effects& effects) {
  return fields.primary.scalar.leftCols(effects.scalar_fields()).transpose();
}

/// Nodes of facets a part of which overlaps the other surface, though averages around them may be open.
NodeFlags overlapped_nodes(const MortarSpace& space);

}  // namespace mixture_contact
