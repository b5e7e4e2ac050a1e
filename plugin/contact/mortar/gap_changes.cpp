#include "mortar/gap_changes.h"

#include "base/in_order.h"

namespace mixture_contact {
namespace {

/// INT psi_a dg da over a pair, for each node of its primary facet.
FacetVector changes_of_pair(const MortarSpace& space, const FacetPair& pair, const FacingPositions& displacements) {
  const FacingPairs& facing = space.facing();
  const FacetCoordinates first = facet_coordinates(facing.primary_facet(pair), displacements.primary);
  const FacetCoordinates second = facet_coordinates(facing.secondary_facet(pair), displacements.secondary);
  FacetVector sums = FacetVector::Zero(facing.primary_facet(pair).count());
  const auto by_moments = [&](const FlatPair& flat) {
    const Vector3d along = flat.area_vector;
    sums = flat.moments.secondary * (second.transpose() * along) - flat.moments.primary * (first.transpose() * along);
  };
  const auto add = [&](const IntegrationPoint& place, const PointKinematics& point, const FacetVector& psi) {
    const double change = point.normal.dot(second * point.secondary_shape - first * point.primary_shape);
    sums += place.weight * point.area * change * psi;
  };
  space.integrate(pair, by_moments, [&] { space.for_each_point(pair, add); });
  return sums;
}

}  // namespace

VectorXd gap_changes(const MortarSpace& space, const NodeFlags& nodes, const FacingPositions& displacements) {
  const FacingPairs& facing = space.facing();
  const IndexedVector<FacetPair>& pairs = facing.pairs();
  const VectorXd& area = space.gaps().area;
  VectorXd changes = VectorXd::Zero(space.nodes());
  const auto of_pair = [&](Index pair) {
    return facing.has_node_among(pairs[pair], nodes) ? changes_of_pair(space, pairs[pair], displacements)
                                                     : FacetVector();
  };
  in_order(pairs.count(), of_pair, [&](Index pair, const FacetVector& sums) {
    const Facet& facet = facing.primary_facet(pairs[pair]);
    for (Index a = 0; a < sums.size(); ++a) {
      const int node = facet.node(a);
      if (nodes[node]) changes[node] += sums[a] / area[node];
    }
  });
  return changes;
}

}  // namespace mixture_contact
