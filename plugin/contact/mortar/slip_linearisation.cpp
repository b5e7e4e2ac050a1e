#include "mortar/slip_linearisation.h"

#include "base/bytes.h"
#include "mortar/bearing_pressure.h"
#include "mortar/corner_point.h"

namespace mixture_contact {
namespace {

/// Sets the variations of friction of a node or of a pair to zero, except the average_variation.
template <class Friction>
void set_rest_zero(Friction& friction, const LocalLayout& displacements, const Effects& effects) {
  friction.area_variation.setZero(displacements.size());
  friction.work.setZero(displacements.nodes());
  if (effects.bearing_fields() == 0) return;
  friction.pressure_variation.setZero(displacements.size());
  friction.pressure_weights.setZero(displacements.nodes());
}

/// The quantities of a point on which friction depends, the same for all nodes of its facet. The averages around node a
/// are sums of w psi_a y over the points, y = (|a| r, a), divided by the area A_a.
struct SlidingPoint {
  Eigen::Matrix<double, 6, 1> value;    ///< value of y
  PairVariation<6> variation;           ///< variation dy + y dw/w
  PairVector work;                      ///< work |a| h of the nodes
  Index turning = 0;                    ///< as SlipLinearisation::turning, for the nodes of the pair
  double pressure = 0;                  ///< pressure |a| (p~ - p*); without fluid, the next two members are empty
  PairVariation<1> pressure_variation;  ///< variation of |a| (p~ - p*) at fixed nodal values, plus |a| (p~ - p*) dw/w
  PairVector pressure_weights;          ///< derivatives of |a| (p~ - p*) with respect to the nodal values of p~
};

void set_pressure(SlidingPoint& sliding, const BearingPressure& pressure, const VaryingPoint& point) {
  const PointKinematics& kinematics = point.contact.kinematics;
  const double here = pressure_at(pressure, kinematics);
  sliding.pressure = kinematics.area * here;
  sliding.pressure_variation = kinematics.area * pressure_variation(pressure, kinematics, point.vary) +
                               here * point.weighted_area_variation();
  sliding.pressure_weights = kinematics.area * pressure_weights(pressure, kinematics);
}

/// Slope r,xi of the slip at a point of the primary facet.
Eigen::Matrix<double, 3, 2> slope_over_primary(const FacetCoordinates& past1, const PastPoint& past, FacetType type,
                                               const Vector2d& xi) {
  return slip_slope_with_xi(past, normal_slope(past, past1 * shape_hessian(type, xi)));
}

/// `past1`, `past2`: positions of the facets' nodes at the start of the step [mm].
SlidingPoint sliding_point(const FacingPairs& facing, const FacetPair& pair, const FacetCoordinates& past1,
                           const FacetCoordinates& past2, const CornerPoint& at) {
  const auto& [contact, vary] = at.point;
  const PointKinematics& kinematics = contact.kinematics;
  const PastPoint past = past_point(kinematics, past1, past2);
  const Vector3d r = slip(past);
  const PairVariation<1> darea = at.point.weighted_area_variation();
  SlidingPoint sliding;
  sliding.turning = vary.wanders() ? kinematics.nodes() : kinematics.primary_nodes();
  sliding.value << kinematics.area * r, kinematics.area_vector;
  sliding.variation.resize(6, darea.size());
  const Eigen::Matrix<double, 3, 2> with_eta = kinematics.area * slip_slope_with_eta(past);
  Eigen::Matrix<double, 3, 2> with_xi = Eigen::Matrix<double, 3, 2>::Zero();
  if (vary.wanders()) {
    const FacetType type = facing.primary_facet(pair).type;
    with_xi = kinematics.area * slope_over_primary(past1, past, type, facing.points(pair)[at.number].xi);
  }
  for (Index column = 0; column < darea.size(); ++column) {
    Vector3d moved = with_eta.lazyProduct(vary.eta.col(column));
    Vector3d normal = vary.area_vector.col(column);
    if (vary.wanders()) {
      moved += with_xi.lazyProduct(vary.xi.col(column));
      normal += vary.weight[column] * kinematics.area_vector;
    }
    sliding.variation.col(column).head<3>() = moved + darea[column] * r;
    sliding.variation.col(column).tail<3>() = normal;
  }
  sliding.work = kinematics.area * kinematics.jump_weights();
  return sliding;
}

/// Adds the part of a point to the sums around a node: d(w psi_a y) = w psi_a (dy + y dw/w) + y w psi_a,alpha
/// dxi_alpha.
void add_sliding(PairSlip& sum, const CornerPoint& at, const SlidingPoint& sliding) {
  const double share = at.share;
  const bool wanders = at.point.vary.wanders();
  PairVariation<1> wandering;
  if (wanders) wandering = at.wandering();
  sum.area_variation += at.area_variation();
  sum.work += share * sliding.work;
  const bool has_fluid = sum.pressure_weights.size() > 0;
  if (has_fluid) {
    sum.pressure_variation += share * sliding.pressure_variation;
    sum.pressure_weights += share * sliding.pressure_weights;
  }
  for (Index n = 0; n < sliding.turning; ++n) {
    Eigen::Matrix<double, 6, 3> change = share * sliding.variation.middleCols<3>(3 * n);
    if (wanders) change += sliding.value.lazyProduct(wandering.segment<3>(3 * n));
    sum.average_variation.middleCols<3>(3 * n) += change;
  }
  for (Index n = sliding.turning; n < sum.work.size(); ++n)
    sum.average_variation.block<3, 3>(0, 3 * n) += share * sliding.variation.block<3, 3>(0, 3 * n);
  if (has_fluid && wanders) sum.pressure_variation += sliding.pressure * wandering;
}

/// The change of the convection F_a of a node by displacements `moved`, in the order of gap_variation.
Eigen::Matrix3d convection_change(const SlipLinearisation& linear, const VectorXd& moved) {
  Eigen::Matrix3d change = Eigen::Matrix3d::Zero();
  const Matrix3Xd& c = linear.convection;
  for (Index b = 0; b < c.cols(); ++b) change += moved.segment<3>(3 * b) * c.col(b).transpose();
  return change;
}

}  // namespace

void MeasuredSlips::set_zero(SlipLinearisation& linear, const MortarSpace& space, Index node, const Patch& patch,
                             const PairsAround& pairs) const {
  const LocalLayout layout = patch.displacement_layout();
  linear.average_variation.fill(layout.nodes(), Eigen::Matrix<double, 6, 3>::Zero());
  set_rest_zero(linear, layout, space.effects());
  linear.pressure_field = space.effects().pressure_field();
  linear.turning = space.facing().moves_points() ? layout.nodes() : layout.primary_nodes();
  linear.convection = convection_around(space.facing(), node, pairs, patch.primary);
}

Matrix3Xd MeasuredSlips::convection_around(const FacingPairs& facing, Index node, const PairsAround& pairs,
                                           const IndexedVector<int>& primary) const {
  Matrix3Xd sum = Matrix3Xd::Zero(3, primary.count());
  double areas = 0;
  int done = -1;
  for (const FacetPair* pair : pairs) {
    if (pair->primary == done) continue;  // pairs come in the order of their primary facets
    done = pair->primary;
    const Facet& facet = facing.primary_facet(*pair);
    const Convection& there = convections_[done][number_in(facet, node)];
    for (Index b = 0; b < there.coefficients.cols(); ++b)
      sum.col(position_in(primary, facet.node(b))) += there.area * there.coefficients.col(b);
    areas += there.area;
  }
  if (areas > 0) sum /= areas;
  return sum;
}

void MeasuredSlips::set_pair(IndexedVector<PairSlip>& corners, const MortarSpace& space, const FacetPair& pair,
                             const LocalLayout& displacements, const std::vector<CornerPoint>& points,
                             const FacingFields& fields, ScopedTimer& laps) const {
  const FacingPairs& facing = space.facing();
  corners.resize(indexing::entries(displacements.primary_nodes()));
  for (PairSlip& corner : corners) {
    corner.average_variation.setZero(6, displacements.size());
    set_rest_zero(corner, displacements, space.effects());
  }
  const FacetCoordinates past1 = facet_coordinates(facing.primary_facet(pair), past_[Side::primary]);
  const FacetCoordinates past2 = facet_coordinates(facing.secondary_facet(pair), past_[Side::secondary]);
  const BearingPressure pressure = bearing_pressure(facing, pair, fields, ambient_pressure_);
  for (auto at = points.begin(); at != points.end();) {
    const Index number = at->number;
    SlidingPoint sliding = sliding_point(facing, pair, past1, past2, *at);
    if (corners[at->corner].has_fluid()) set_pressure(sliding, pressure, at->point);
    for (; at != points.end() && at->number == number; ++at) add_sliding(corners[at->corner], *at, sliding);
  }
  laps.friction();
}

void MeasuredSlips::scatter(const IndexedVector<PairSlip>& corners, Index corner, const PairPlaces& place,
                            SlipLinearisation& sum) const {
  const PairSlip& pair = corners[corner];
  for (Index n = 0; n < place.size(); ++n) {
    if (place[n] < sum.turning) {
      sum.average_variation[place[n]] += pair.average_variation.middleCols<3>(3 * n);
      sum.area_variation.segment<3>(3 * place[n]) += pair.area_variation.segment<3>(3 * n).transpose();
    } else {
      sum.average_variation[place[n]].topRows<3>() += pair.average_variation.block<3, 3>(0, 3 * n);
    }
    sum.work[place[n]] += pair.work[n];
    if (!sum.has_fluid()) continue;
    sum.pressure_variation.segment<3>(3 * place[n]) += pair.pressure_variation.segment<3>(3 * n).transpose();
    sum.pressure_weights[place[n]] += pair.pressure_weights[n];
  }
}

void MeasuredSlips::divide_by_area(SlipLinearisation& sum, const NodalLoads& loads, Index node) const {
  const double per_area = 1 / loads.area[node];
  const NodalFriction& friction = loads.friction;
  Eigen::Matrix<double, 6, 1> average;
  average << friction.slip.col(node), friction.area_vector.col(node);
  for (Index n = 0; n < sum.turning; ++n) {
    const Eigen::RowVector3d area_variation = sum.area_variation.segment<3>(3 * n);
    sum.average_variation[n] = per_area * (sum.average_variation[n] - average.lazyProduct(area_variation));
  }
  for (Index n = sum.turning; n < sum.average_variation.count(); ++n) sum.average_variation[n].topRows<3>() *= per_area;
  if (!sum.has_fluid()) return;
  sum.pressure_variation = per_area * (sum.pressure_variation - friction.pressure[node] * sum.area_variation);
  sum.pressure_weights *= per_area;
}

void MeasuredSlips::predict(NodalFriction& friction, Index node, const SlipLinearisation& linear, const Patch& patch,
                            const VectorXd& moved, const FacingFields& change) const {
  Eigen::Matrix<double, 6, 1> averages = Eigen::Matrix<double, 6, 1>::Zero();
  Vector3d trial = Vector3d::Zero();
  for (Index n = 0; n < linear.average_variation.count(); ++n) {
    for (Index axis = 0; axis < 3; ++axis) {
      averages += linear.average_variation[n].col(axis) * moved[3 * n + axis];
      trial += linear.trial_variation.col(3 * n + axis) * moved[3 * n + axis];
    }
  }
  friction.slip.col(node) += averages.head<3>();
  friction.area_vector.col(node) += averages.tail<3>();
  friction.trial.col(node) += trial;
  friction.convection[node] += convection_change(linear, moved);
  if (!linear.has_fluid()) return;
  friction.pressure[node] += linear.pressure_variation.dot(moved);
  const LocalLayout layout = patch.displacement_layout();
  for (Index n = 0; n < layout.nodes(); ++n) {
    const double weight = linear.pressure_weights[n];
    if (weight == 0) continue;
    const SurfaceFields& surface = n < layout.primary_nodes() ? change.primary : change.secondary;
    friction.pressure[node] += weight * surface.scalar(patch.node(n), linear.pressure_field);
  }
}

void MeasuredSlips::add_force(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                              PointForce& force) const {
  add_friction_force(point, vary, loads, force);
}

std::size_t bytes_of(const SlipLinearisation& linear) {
  return bytes(linear.average_variation) + bytes(linear.area_variation) + bytes(linear.trial_variation) +
         bytes(linear.convection) + bytes(linear.work) + bytes(linear.pressure_variation) +
         bytes(linear.pressure_weights);
}

}  // namespace mixture_contact
