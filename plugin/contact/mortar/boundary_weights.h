/// Weights psi_a on facets that the other surface covers only in part. The nodes that are covered least carry no load
/// of such a facet.
#pragma once

#include "geometry/surface.h"

#include <optional>

namespace mixture_contact {

/// A node carries no load of a facet if the covered fraction of its area on the facet is less than this fraction of
/// that of the best covered node. If the other surface ends across a facet and covers a fraction s of it, far nodes are
/// covered to s^2 and near nodes to 2s - s^2: far nodes carry load from s = 0.82 on.
inline constexpr double least_covered = 0.7;

/// Integrals over the part of a facet that faces the other surface, for each of its nodes: INT psi_a da [mm^2] and INT
/// psi_a g da [mm^3], shape (2, n).
using FacetGapSums = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor, 2, max_facet_nodes>;

/// Per facet, 1 for each of its nodes that carries load of the facet and 0 for the others. A facet without a decision
/// has no entries.
using LoadCarriers = IndexedVector<FacetVector>;

/// Decides which nodes carry the load of partly covered facets.
///
/// A decision is constant during the iterations of a step. It changes at the start of the next step only if the
/// coverage has changed clearly: with other weights the averages would be different, and the state from which the step
/// starts would not be in equilibrium.
class BoundaryWeights {
 public:
  /// `facets`: number of facets of the surface.
  explicit BoundaryWeights(Index facets) : facets_(facets) {}

  /// Discards the present decisions such that they are made again from the last accepted ones.
  void reconsider() { carriers_.clear(); }
  /// Accepts the present decisions at the end of a step. Later decisions start from the accepted ones.
  void settle();
  /// True if it has been decided which nodes of a facet carry load.
  bool knows(int facet) const { return is_known(carriers_, facet); }
  /// Decides which nodes of a facet carry load. `covered`: integrals over the part of the facet that faces the other
  /// surface. `all`: INT psi_a da over the whole facet.
  void decide(int facet, const FacetGapSums& covered, const FacetVector& all);

  /// The present decisions; if there are none, the last accepted ones, which may be empty.
  const LoadCarriers& last_decisions() const { return carriers_.empty() ? settled_ : carriers_; }
  /// Sets the last accepted decisions, for example those of a restarted run.
  void restore(LoadCarriers decisions);

  /// The functions psi_a of a facet at the point xi, which weight averages and interpolate loads. They are those of
  /// multiplier_functions(), but the functions of nodes that carry no load are redistributed within the facet.
  ///
  /// Far from its node a psi_a is almost zero: an average with it would hardly depend on the node, and a condition on
  /// it would contradict the conditions of the nodes that carry the load.
  ShapeFunctions shape(int facet, FacetType type, int sub_facet, const Vector2d& xi) const;
  /// The redistribution weights of a facet's nodes (heirs_of()), one column per node; empty if no function of the facet
  /// is redistributed.
  std::optional<MatrixXd> heirs(int facet, FacetType type) const;

  /// Memory of the decisions [bytes].
  std::size_t memory() const { return (carriers_.capacity() + settled_.capacity()) * sizeof(FacetVector); }

 private:
  /// True if a node of the facet carries no load.
  bool redistributes(int facet) const { return knows(facet) && carriers_[facet].minCoeff() == 0; }
  static bool is_known(const LoadCarriers& carriers, int facet) {
    return !carriers.empty() && carriers[facet].size() > 0;
  }

  Index facets_;  ///< number of facets
  /// The present decisions; empty if none has been made.
  LoadCarriers carriers_;
  LoadCarriers settled_;  ///< the last accepted decisions; empty if there are none
};

}  // namespace mixture_contact
