#include "mortar/slips.h"

#include "base/bytes.h"
#include "base/in_order.h"
#include "conditions/friction.h"
#include "mortar/bearing_pressure.h"
#include "mortar/mortar_space.h"

namespace mixture_contact {
namespace {

/// The integrals over a pair for the averages of friction, per node of its primary facet; empty if no node of the facet
/// is in contact.
struct SlipSums {
  FacetCoordinates slip;         ///< integrals INT psi_a r da of the slip
  FacetCoordinates area_vector;  ///< integrals INT psi_a n da of the normal
  FacetVector pressure;          ///< integrals INT psi_a (p~ - p*) da of the excess pressure
};

SlipSums slip_sums(const MortarSpace& space, const FacetPair& pair, const FacingPositions& past,
                   const FacingFields& fields, double ambient_pressure, const NodeFlags& in_contact) {
  const FacingPairs& facing = space.facing();
  SlipSums sums;
  if (!facing.has_node_among(pair, in_contact)) return sums;
  const Index count = facing.primary_facet(pair).count();
  const BearingPressure pressure = bearing_pressure(facing, pair, fields, ambient_pressure);
  const FacetCoordinates past1 = facet_coordinates(facing.primary_facet(pair), past.primary);
  const FacetCoordinates past2 = facet_coordinates(facing.secondary_facet(pair), past.secondary);
  sums = {FacetCoordinates::Zero(3, count), FacetCoordinates::Zero(3, count), FacetVector::Zero(count)};
  space.for_each_point(pair, [&](const IntegrationPoint& place, const PointKinematics& point, const FacetVector& psi) {
    const FacetVector share = place.weight * psi;
    const Vector3d slipped = point.area * slip(point, past1, past2);
    sums.slip += slipped.lazyProduct(share.transpose());
    sums.area_vector += point.area_vector.lazyProduct(share.transpose());
    sums.pressure += pressure_at(pressure, point) * point.area * share;
  });
  return sums;
}

/// The convection F = sum_b x_b C_b^T at a node of a facet with nodal positions x.
Eigen::Matrix3d convected(const Convection& there, const FacetCoordinates& x) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Index b = 0; b < x.cols(); ++b) sum += x.col(b).lazyProduct(there.coefficients.col(b).transpose());
  return sum;
}

/// Calls use(pair) for the first pair of each primary facet.
template <class Use>
void for_each_primary_facet(const FacingPairs& facing, const Use& use) {
  int done = -1;
  for (const FacetPair& pair : facing.pairs()) {
    if (pair.primary == done) continue;  // pairs come in the order of their primary facets
    done = pair.primary;
    use(pair);
  }
}

}  // namespace

std::unique_ptr<SlipAverages> slip_averages(FrictionKind kind, double ambient_pressure) {
  return by_friction<std::unique_ptr<SlipAverages>>(
      kind, [] { return std::make_unique<SlipAverages>(); },
      [&] { return std::make_unique<MeasuredSlips>(ambient_pressure); });
}

void MeasuredSlips::measure_from(const FacingPairs& facing, const FacingPositions& past) {
  is_set_ = true;
  past_ = {{past.primary, past.secondary}};
  const IndexedVector<Facet>& facets = facing.primary().facets;
  convections_ = IndexedVector<IndexedVector<Convection>>(facets.count());
  in_parallel(facets.count(), [&](Index index) {
    const FacetCoordinates x = facet_coordinates(facets[index], past.primary);
    for (Index corner = 0; corner < x.cols(); ++corner)
      convections_[index].push_back(convection(facets[index], corner, x));
  });
}

void MeasuredSlips::begin_at(const FacingPairs& facing, const FacingPositions& x) {
  if (!is_set_) measure_from(facing, x);
}

bool MeasuredSlips::accept(const MortarSpace& space, const FacingPositions& x, NodalLoads& loads) {
  measure_from(space.facing(), x);
  convect(loads.friction, space.facing(), loads.in_contact, x.primary);
  return true;
}

void MeasuredSlips::restore(const FacingPairs& facing, const FacingPositions& past) {
  forget();
  if (past.primary.cols() > 0) measure_from(facing, past);
}

std::size_t MeasuredSlips::memory() const {
  std::size_t sum = bytes(convections_) + bytes(past_[Side::primary]) + bytes(past_[Side::secondary]);
  for (const IndexedVector<Convection>& facet : convections_) sum += bytes(facet);
  return sum;
}

NodalFriction MeasuredSlips::averages(const MortarSpace& space, const NodalLoads& loads,
                                      const FacingFields& fields) const {
  NodalFriction friction;
  const Index nodes = space.nodes();
  friction.slip.setZero(3, nodes);
  friction.area_vector.setZero(3, nodes);
  VectorXd pressure = VectorXd::Zero(nodes);
  const IndexedVector<FacetPair>& pairs = space.facing().pairs();
  const FacingPositions past = seen_from(Side::primary, past_);
  const auto sums_of = [&](Index index) {
    return slip_sums(space, pairs[index], past, fields, ambient_pressure_, loads.in_contact);
  };
  in_order(pairs.count(), sums_of, [&](Index index, const SlipSums& sums) {
    const Facet& facet = space.facing().primary_facet(pairs[index]);
    for (Index a = 0; a < sums.pressure.size(); ++a) {
      const int node = facet.node(a);
      if (!loads.in_contact[node]) continue;
      friction.slip.col(node) += sums.slip.col(a) / loads.area[node];
      friction.area_vector.col(node) += sums.area_vector.col(a) / loads.area[node];
      pressure[node] += sums.pressure[a] / loads.area[node];
    }
  });
  if (space.effects().bearing_fields() != 0) friction.pressure = std::move(pressure);
  convect(friction, space.facing(), loads.in_contact, fields.primary.position);
  return friction;
}

void MeasuredSlips::convect(NodalFriction& friction, const FacingPairs& facing, const NodeFlags& in_contact,
                            const Matrix3Xd& x1) const {
  const Index nodes = facing.primary().nodes;
  friction.convection.fill(nodes, Eigen::Matrix3d::Zero());
  VectorXd areas = VectorXd::Zero(nodes);
  for_each_primary_facet(facing, [&](const FacetPair& pair) {
    const Facet& facet = facing.primary_facet(pair);
    const FacetCoordinates x = facet_coordinates(facet, x1);
    for (Index corner = 0; corner < facet.count(); ++corner) {
      const int node = facet.node(corner);
      if (!in_contact[node]) continue;
      const Convection& there = convections_[pair.primary][corner];
      friction.convection[node] += there.area * convected(there, x);
      areas[node] += there.area;
    }
  });
  for (Index node = 0; node < nodes; ++node) {
    if (areas[node] > 0) friction.convection[node] /= areas[node];
  }
}

void MeasuredSlips::add_nodes(IndexedVector<int>& nodes, const Facet& facet) const { merge_unique(nodes, facet); }

}  // namespace mixture_contact
