#include "mortar/boundary_weights.h"

#include <cmath>

namespace mixture_contact {
namespace {

/// A node carries no load of a facet where the covered part of its share of the facet is less than this part of the
/// best covered node's. Where the other surface ends across a facet and covers s of it, far nodes have s^2 and near
/// ones 2s - s^2 of theirs: they carry load from s = 0.82 on.
constexpr double least_covered = 0.7;
/// But nodes this far away, as a part of the facet's size, have no load that others could carry.
constexpr double far_away = 0.01;

}  // namespace

void BoundaryWeights::decide(int facet, const FacetGapSums& covered, const FacetVector& all) {
  carriers_.resize(facets_.size());
  const FacetVector area = covered.row(0);
  const FacetVector part = area.cwiseQuotient(all);
  const double enough = least_covered * part.maxCoeff();
  const double near = far_away * std::sqrt(all.sum());
  FacetVector& carriers = carriers_[facet];
  carriers = FacetVector::Ones(all.size());
  for (Index a = 0; a < all.size(); ++a) {
    if (part[a] < enough && covered(1, a) <= near * area[a]) carriers[a] = 0;
  }
}

ShapeFunctions BoundaryWeights::shape(int facet, int sub_facet, const Vector2d& xi) const {
  const FacetType type = facets_[facet].type;
  ShapeFunctions psi = multiplier_functions(type, sub_facet, xi);
  if (!knows(facet) || carriers_[facet].minCoeff() > 0) return psi;
  return redistributed(type, psi, carriers_[facet]);
}

}  // namespace mixture_contact
