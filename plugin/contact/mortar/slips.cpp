#include "mortar/slips.h"

#include "base/in_order.h"

#include <algorithm>

namespace mixture_contact {
namespace {

/// The integrals over a pair for the averages of friction, per node of its primary facet; empty if no node of the facet
/// is in contact.
struct SlipSums {
  FacetCoordinates slip;         ///< integrals INT psi_a r da of the slip
  FacetCoordinates area_vector;  ///< integrals INT psi_a n da of the normal
  FacetVector pressure;          ///< integrals INT psi_a (p~ - p*) da of the excess pressure
};

SlipSums slip_sums(const MortarSpace& space, const FacetPair& pair, const FacingFields& fields,
                   const NodeFlags& in_contact) {
  const FacingPairs& facing = space.facing();
  SlipSums sums;
  if (!facing.has_node_among(pair, in_contact)) return sums;
  const Index count = facing.primary_facet(pair).count();
  const BearingPressure pressure = bearing_pressure(space, pair, fields);
  const PastFacets past = past_facets(space, pair);
  sums = {FacetCoordinates::Zero(3, count), FacetCoordinates::Zero(3, count), FacetVector::Zero(count)};
  space.for_each_point(pair, [&](const IntegrationPoint& place, const PointKinematics& point, const FacetVector& psi) {
    const FacetVector share = place.weight * psi;
    const Vector3d slipped = point.area * slip(point, past.primary, past.secondary);
    sums.slip += slipped.lazyProduct(share.transpose());
    sums.area_vector += point.area_vector.lazyProduct(share.transpose());
    sums.pressure += pressure_at(pressure, point) * point.area * share;
  });
  return sums;
}

/// The side whose fluid pressure acts on the friction of a pair: the primary one if its facet has fluid, else the
/// secondary one; empty if neither has fluid.
std::optional<Side> bearing_side(const FacingPairs& facing, const FacetPair& pair) {
  const FieldMask bearing = facing.effects().bearing_fields();
  if ((bearing & facing.primary().permeable[pair.primary]) != 0) return Side::primary;
  if ((bearing & facing.secondary().permeable[pair.secondary]) != 0) return Side::secondary;
  return std::nullopt;
}

/// Calls use(facet, convection at the node) for each primary facet of the pairs around a node. Returns the sum of the
/// facets' areas at the node.
template <class Use>
double for_each_facet_around(const MortarSpace& space, Index node, const PairsAround& pairs, const Use& use) {
  double areas = 0;
  int done = -1;
  for (const FacetPair* pair : pairs) {
    if (pair->primary == done) continue;  // pairs come in the order of their primary facets
    done = pair->primary;
    const Facet& facet = space.facing().primary_facet(*pair);
    const Index corner = number_in(facet, node);
    const Convection& there = space.slips().convections(pair->primary)[corner];
    use(facet, there);
    areas += there.area;
  }
  return areas;
}

/// The convection F = sum_b x_b C_b^T at a node of a facet with nodal positions x.
Eigen::Matrix3d convected(const Convection& there, const FacetCoordinates& x) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Index b = 0; b < x.cols(); ++b) sum += x.col(b).lazyProduct(there.coefficients.col(b).transpose());
  return sum;
}

/// Calls use(index, facet) for each primary facet that has a pair.
template <class Use>
void for_each_primary_facet(const MortarSpace& space, const Use& use) {
  int done = -1;
  for (const FacetPair& pair : space.facing().pairs()) {
    if (pair.primary == done) continue;  // pairs come in the order of their primary facets
    done = pair.primary;
    use(done, space.facing().primary_facet(pair));
  }
}

}  // namespace

NodalFriction average_slips(const MortarSpace& space, const NodalLoads& loads, const FacingFields& fields) {
  NodalFriction friction;
  if (!convects(space)) return friction;
  const Index nodes = space.nodes();
  friction.slip.setZero(3, nodes);
  friction.area_vector.setZero(3, nodes);
  VectorXd pressure = VectorXd::Zero(nodes);
  const IndexedVector<FacetPair>& pairs = space.facing().pairs();
  const auto sums_of = [&](Index index) { return slip_sums(space, pairs[index], fields, loads.in_contact); };
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
  set_convection(friction, space, loads.in_contact, fields.primary.position);
  return friction;
}

void set_convection(NodalFriction& friction, const MortarSpace& space, const NodeFlags& in_contact,
                    const Matrix3Xd& x1) {
  if (friction.empty()) return;
  friction.convection.fill(space.nodes(), Eigen::Matrix3d::Zero());
  VectorXd areas = VectorXd::Zero(space.nodes());
  for_each_primary_facet(space, [&](int index, const Facet& facet) {
    const FacetCoordinates x = facet_coordinates(facet, x1);
    for (Index corner = 0; corner < facet.count(); ++corner) {
      const int node = facet.node(corner);
      if (!in_contact[node]) continue;
      const Convection& there = space.slips().convections(index)[corner];
      friction.convection[node] += there.area * convected(there, x);
      areas[node] += there.area;
    }
  });
  for (Index node = 0; node < space.nodes(); ++node) {
    if (areas[node] > 0) friction.convection[node] /= areas[node];
  }
}

Matrix3Xd convection_around(const MortarSpace& space, Index node, const PairsAround& pairs,
                            const IndexedVector<int>& primary) {
  Matrix3Xd sum = Matrix3Xd::Zero(3, primary.count());
  const auto add = [&](const Facet& facet, const Convection& there) {
    for (Index b = 0; b < there.coefficients.cols(); ++b) {
      sum.col(position_in(primary, facet.node(b))) += there.area * there.coefficients.col(b);
    }
  };
  const double areas = for_each_facet_around(space, node, pairs, add);
  if (areas > 0) sum /= areas;
  return sum;
}

PastFacets past_facets(const MortarSpace& space, const FacetPair& pair) {
  const FacingPositions past = space.slips().past();
  return {facet_coordinates(space.facing().primary_facet(pair), past.primary),
          facet_coordinates(space.facing().secondary_facet(pair), past.secondary)};
}

BearingPressure bearing_pressure(const MortarSpace& space, const FacetPair& pair, const FacingFields& fields) {
  const FacingPairs& facing = space.facing();
  const std::optional<Side> side = bearing_side(facing, pair);
  if (!side) return {};
  const int field = space.effects().pressure_field();
  const bool primary = *side == Side::primary;
  const Facet& facet = primary ? facing.primary_facet(pair) : facing.secondary_facet(pair);
  const SurfaceFields& surface = primary ? fields.primary : fields.secondary;
  const FacetVector values = facet_values(facet, surface.scalar.col(field));
  return {primary ? 0 : facing.primary_facet(pair).count(), values.array() - space.slips().ambient_pressure()};
}

double pressure_at(const BearingPressure& pressure, const PointKinematics& point) {
  if (pressure.empty()) return 0;
  return (pressure.first == 0 ? point.primary_shape : point.secondary_shape).dot(pressure.value);
}

PairVariation<1> pressure_variation(const BearingPressure& pressure, const PointKinematics& point,
                                    const KinematicVariations& vary) {
  const bool on_primary = pressure.first == 0;
  if (pressure.empty() || (on_primary && !vary.wanders())) return PairVariation<1>::Zero(vary.gap.size());
  if (on_primary) return (pressure.value.transpose() * point.primary_gradient).eval().lazyProduct(vary.xi);
  return (pressure.value.transpose() * point.secondary_gradient).eval().lazyProduct(vary.eta);
}

PairVector pressure_weights(const BearingPressure& pressure, const PointKinematics& point) {
  PairVector weights = PairVector::Zero(point.nodes());
  if (pressure.empty()) return weights;
  const FacetVector& shape = pressure.first == 0 ? point.primary_shape : point.secondary_shape;
  weights.segment(pressure.first, shape.size()) = shape;
  return weights;
}

}  // namespace mixture_contact
