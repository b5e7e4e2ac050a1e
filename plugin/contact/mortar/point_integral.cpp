#include "mortar/point_integral.h"

namespace mixture_contact {
namespace {

/// Derivative of the jump weight h_a of one node, h = (N1(xi), -N2(eta)), with the nodal positions.
PairVariation<1> weight_variation(const PointKinematics& point, const KinematicVariations& vary, Index node) {
  const Index first = point.primary_nodes();
  if (node >= first) return -point.secondary_gradient.row(node - first).lazyProduct(vary.eta);
  if (!vary.wanders()) return PairVariation<1>::Zero(vary.eta.cols());
  return point.primary_gradient.row(node).lazyProduct(vary.xi);
}

/// The friction force on the primary side, w |a| t_T.
Vector3d friction_force(const PointKinematics& point, const PointLoads& loads) {
  return loads.weight * point.area * loads.friction;
}

/// The variation d[w t_n a] = w [(dt_n + t_n dw/w) a + t_n da], with dt_n = t_n,alpha dxi_alpha. It has columns for the
/// primary nodes only if the point does not move on its facet.
PairVariation<3> normal_force_variation(const PointKinematics& point, const KinematicVariations& vary,
                                        const PointLoads& loads) {
  if (!vary.wanders()) return loads.weight * loads.traction * vary.area_vector.leftCols(3 * point.primary_nodes());
  const PairVariation<1> dtn = loads.traction_slope.transpose() * vary.xi + loads.traction * vary.weight;
  return loads.weight * (point.area_vector.lazyProduct(dtn) + loads.traction * vary.area_vector);
}

}  // namespace

void add_residual(const PointKinematics& point, const PointLoads& loads, const LocalLayout& layout,
                  VectorXd& residual) {
  const PairVector h = point.jump_weights();
  const Vector3d force = loads.weight * loads.traction * point.area_vector + friction_force(point, loads);  // t1 da1
  const double flux_weight = loads.weight * loads.time_increment * point.area;                              // dt da1
  for (Index node = 0; node < layout.nodes(); ++node) {
    residual.segment<3>(layout.displacement(node, 0)) += h[node] * force;
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      residual[layout.scalar(node, k)] += flux_weight * loads.flux[k] * h[node];
    }
  }
}

PointForce normal_force(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads) {
  return {loads.weight * loads.traction * point.area_vector, normal_force_variation(point, vary, loads)};
}

void add_friction_force(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                        PointForce& force) {
  // d[w |a| t_T] = w [ t_T (d|a| + |a| dw/w) + |a| t_T,alpha dxi_alpha ]
  const Vector3d with_area = loads.weight * loads.friction;
  const Eigen::Matrix<double, 3, 2> with_xi = loads.weight * point.area * loads.friction_slope;
  const bool varies = !loads.friction_slope.isZero(0);
  for (Index column = 0; column < force.variation.cols(); ++column) {
    Vector3d change = vary.area[column] * with_area;
    if (vary.wanders()) change += point.area * vary.weight[column] * with_area;
    if (varies && vary.wanders()) change += with_xi.lazyProduct(vary.xi.col(column));
    force.variation.col(column) += change;
  }
  force.value += friction_force(point, loads);
}

void add_traction_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointForce& force,
                          MatrixXd& tangent) {
  // The derivative of the nodal forces h_a F, three rows per node.
  const Index first = point.primary_nodes();
  const PairVector h = point.jump_weights();
  for (Index column = 0; column < vary.eta.cols(); ++column) {
    const bool varies = column < force.variation.cols();
    const Vector3d with_force = varies ? Vector3d(force.variation.col(column)) : Vector3d::Zero();
    const auto add = [&](Index node, double dh) {
      tangent.col(column).segment<3>(3 * node) += h[node] * with_force + dh * force.value;
    };
    if (vary.wanders()) {
      for (Index a = 0; a < first; ++a) add(a, point.primary_gradient.row(a).dot(vary.xi.col(column)));
    } else if (varies) {
      for (Index a = 0; a < first; ++a) add(a, 0);
    }
    for (Index b = 0; first + b < h.size(); ++b)
      add(first + b, -point.secondary_gradient.row(b).dot(vary.eta.col(column)));
  }
}

void add_flux_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads, Index k,
                      const LocalLayout& layout, MatrixXd& tangent) {
  // d[w dt |a| q h_a] = w dt [ h_a (q (d|a| + |a| dw/w) + |a| dq) + |a| q dh_a ],  dq = q,alpha dxi_alpha
  const PairVector h = point.jump_weights();
  const double flux = loads.flux[k];
  const double weight = loads.weight * loads.time_increment;
  PairVariation<1> change = flux * vary.area;
  if (vary.wanders()) change += point.area * (loads.flux_slope.row(k) * vary.xi + flux * vary.weight);
  const PairVariation<1> dflux = weight * change;
  for (Index node = 0; node < layout.nodes(); ++node) {
    const PairVariation<1> moved = h[node] * dflux + weight * point.area * flux * weight_variation(point, vary, node);
    for (Index column = 0; column < layout.nodes(); ++column)
      tangent.block<1, 3>(node, layout.displacement(column, 0)) += moved.segment<3>(3 * column);
  }
}

PairVariation<1> jump_variation(const PointKinematics& point, const KinematicVariations& vary,
                                const PairVector& values) {
  const Eigen::RowVector2d two = values.tail(point.secondary_shape.size()).transpose() * point.secondary_gradient;
  PairVariation<1> variation = -two.lazyProduct(vary.eta);
  if (!vary.wanders()) return variation;
  const Eigen::RowVector2d one = values.head(point.primary_nodes()).transpose() * point.primary_gradient;
  return variation + one.lazyProduct(vary.xi);
}

}  // namespace mixture_contact
