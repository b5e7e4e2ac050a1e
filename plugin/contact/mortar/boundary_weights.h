/// Weights psi_a where the other surface ends across a facet: nodes that are covered least carry no load of it.
#pragma once

#include "geometry/surface.h"

namespace mixture_contact {

/// Of what faces one facet, per node of it: INT psi_a da [mm^2] and INT psi_a g da [mm^3], shape (2, n).
using FacetGapSums = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor, 2, max_facet_nodes>;

class BoundaryWeights {
 public:
  /// Keeps a reference to the facets.
  explicit BoundaryWeights(const IndexedVector<Facet>& facets) : facets_(facets) {}

  /// Forgets which nodes carry load.
  void clear() { carriers_.clear(); }
  /// Whether it has been decided for a facet.
  bool knows(int facet) const { return !carriers_.empty() && carriers_[facet].size() > 0; }
  /// Decides it for a facet: `covered` are its sums over the part that faces the other surface, `all` is INT psi_a da
  /// over all of it.
  void decide(int facet, const FacetGapSums& covered, const FacetVector& all);

  /// Functions psi_a of a facet at a place on it, which weight averages and interpolate loads: those of
  /// multiplier_functions(), but that nodes covered least have theirs redistributed among the others of the facet. Far
  /// from its node a psi_a says next to nothing, and conditions on such averages contradict those of the nodes that
  /// carry the load.
  ShapeFunctions shape(int facet, int sub_facet, const Vector2d& xi) const;

  std::size_t memory() const { return carriers_.capacity() * sizeof(FacetVector); }

 private:
  const IndexedVector<Facet>& facets_;
  IndexedVector<FacetVector> carriers_;  ///< per facet which of its nodes carry load, 1 or 0; empty: not decided
};

}  // namespace mixture_contact
