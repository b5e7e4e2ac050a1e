/// The integration points of a pair in the averages of the nodes of its primary facet.
#pragma once

#include "mortar/loaded_points.h"

#include <iterator>

namespace mixture_contact {

/// The positions of a pair's nodes in a larger patch.
template <class Nodes>
PairPlaces dof_map(const Nodes& primary, const Nodes& secondary, const Patch& patch) {
  PairPlaces map(std::distance(primary.begin(), primary.end()) + std::distance(secondary.begin(), secondary.end()));
  Index n = 0;
  for (const int node : primary) map[n++] = position_in(patch.primary, node);
  for (const int node : secondary) map[n++] = patch.primary.count() + position_in(patch.secondary, node);
  return map;
}

/// Adds the variation of a pair, in the order of its nodes, to that of a patch.
template <class Part>
void add_variation(VectorXd& sum, const Eigen::MatrixBase<Part>& part, const PairPlaces& place) {
  for (Index n = 0; n < place.size(); ++n) sum.segment<3>(3 * place[n]) += part.template segment<3>(3 * n);
}

/// An integration point in the averages of one node of its primary facet.
struct CornerPoint {
  const VaryingPoint& point;
  Index number;  ///< number of the point in its pair
  Index corner;
  int node;
  double share;              ///< weight w psi_a
  Eigen::RowVector2d slope;  ///< gradient w psi_a,alpha of the weight

  /// Variation w psi_a,alpha dxi_alpha, for a point that moves on its facet.
  auto wandering() const { return slope.lazyProduct(point.vary.xi); }
  /// Variation d(w psi_a |a|).
  PairVariation<1> area_variation() const {
    PairVariation<1> variation = share * point.weighted_area_variation();
    if (point.vary.wanders()) variation += point.contact.kinematics.area * wandering();
    return variation;
  }
};

}  // namespace mixture_contact
