/// Weights psi_a where the other surface ends across a facet: nodes that are covered least carry no load of it.
#pragma once

#include "geometry/surface.h"

#include <optional>

namespace mixture_contact {

/// Sums over the part of a facet that faces the other surface, per node: INT psi_a da [mm^2] and INT psi_a g da [mm^3],
/// shape (2, n).
using FacetGapSums = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor, 2, max_facet_nodes>;

/// Per facet which of its nodes carry load, 1 or 0; empty: not decided.
using LoadCarriers = IndexedVector<FacetVector>;

/// A decision holds during iterations. The one after it, at the start of the next step, changes it only where it is
/// clearly wrong by then: averages over other weights are others, so that the state in equilibrium, of which the step
/// starts, would not be one any more.
class BoundaryWeights {
 public:
  /// Keeps a reference to the facets.
  explicit BoundaryWeights(const IndexedVector<Facet>& facets) : facets_(facets) {}

  /// Has all decisions made again, from the last ones that counted.
  void reconsider() { carriers_.clear(); }
  /// The present decisions count as the last ones from now on, and all are made again.
  void settle();
  /// Whether it has been decided for a facet.
  bool knows(int facet) const { return is_known(carriers_, facet); }
  /// Decides it for a facet: `covered` are its sums over the part that faces the other surface, `all` is INT psi_a da
  /// over all of it.
  void decide(int facet, const FacetGapSums& covered, const FacetVector& all);

  /// The last decisions, which those to come depend on; empty if there are none.
  const LoadCarriers& last_decisions() const { return carriers_.empty() ? settled_ : carriers_; }
  /// Continues from those.
  void restore(LoadCarriers decisions);

  /// Functions psi_a of a facet at a place on it, which weight averages and interpolate loads: those of
  /// multiplier_functions(), except that nodes covered least have theirs redistributed within the facet. Far
  /// from its node a psi_a says next to nothing, and conditions on such averages contradict those of the nodes that
  /// carry the load.
  ShapeFunctions shape(int facet, int sub_facet, const Vector2d& xi) const;
  /// The parts in which the nodes of a linear facet take the shape function of each, one column for each of them; empty
  /// where each takes its own.
  std::optional<MatrixXd> heirs(int facet) const;

  std::size_t memory() const { return (carriers_.capacity() + settled_.capacity()) * sizeof(FacetVector); }

 private:
  bool redistributes(int facet) const { return knows(facet) && carriers_[facet].minCoeff() == 0; }
  static bool is_known(const LoadCarriers& carriers, int facet) {
    return !carriers.empty() && carriers[facet].size() > 0;
  }

  const IndexedVector<Facet>& facets_;
  LoadCarriers carriers_;
  LoadCarriers settled_;  ///< the last decisions
};

}  // namespace mixture_contact
