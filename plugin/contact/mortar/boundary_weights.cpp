#include "mortar/boundary_weights.h"

#include "geometry/sub_facets.h"

#include <cmath>
#include <utility>

namespace mixture_contact {
namespace {

/// Thresholds with hysteresis: a node that carried load keeps it down to s = 0.5, and a node that did not takes it up
/// from s = 0.97 on. Sliding by the size of a facet changes a decision once, and oscillation by a tenth of it does not.
constexpr double least_covered_of_carrier = 1.0 / 3;
constexpr double least_covered_of_other = 0.95;
/// Nodes whose average gap is larger than this fraction of the facet's size have no load that would have to be carried
/// by others, and keep their functions.
constexpr double far_away = 0.01;

double least_covered_part(bool is_decided, bool carries) {
  if (!is_decided) return least_covered;
  return carries ? least_covered_of_carrier : least_covered_of_other;
}

}  // namespace

void BoundaryWeights::decide(int facet, const FacetGapSums& covered, const FacetVector& all) {
  carriers_.resize(indexing::entries(facets_));
  const FacetVector area = covered.row(0);
  const FacetVector part = area.cwiseQuotient(all);
  const double near = far_away * std::sqrt(all.sum());
  const bool is_decided = is_known(settled_, facet);
  FacetVector& carriers = carriers_[facet];
  carriers = FacetVector::Ones(all.size());
  for (Index a = 0; a < all.size(); ++a) {
    const double enough = least_covered_part(is_decided, is_decided && settled_[facet][a] > 0) * part.maxCoeff();
    if (part[a] < enough && covered(1, a) <= near * area[a]) carriers[a] = 0;
  }
}

void BoundaryWeights::settle() {
  if (!carriers_.empty()) settled_ = std::move(carriers_);
  carriers_.clear();
}

void BoundaryWeights::restore(LoadCarriers decisions) {
  settled_ = std::move(decisions);
  carriers_.clear();
}

ShapeFunctions BoundaryWeights::shape(int facet, FacetType type, int sub_facet, const Vector2d& xi) const {
  const ShapeFunctions psi = multiplier_functions(type, sub_facet, xi);
  return redistributes(facet) ? redistributed(type, psi, carriers_[facet]) : psi;
}

std::optional<MatrixXd> BoundaryWeights::heirs(int facet, FacetType type) const {
  if (!redistributes(facet)) return std::nullopt;
  const FacetVector& carriers = carriers_[facet];
  MatrixXd heirs(carriers.size(), carriers.size());
  for (int node = 0; node < carriers.size(); ++node) heirs.col(node) = heirs_of(type, node, carriers);
  return heirs;
}

}  // namespace mixture_contact
