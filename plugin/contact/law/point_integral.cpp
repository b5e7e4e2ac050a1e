#include "law/point_integral.h"

namespace mixture_contact {
namespace {

/// Adds the derivative of h_a F, where h = (N1(xi), -N2(eta)) and F is a force on the primary side: three rows per
/// node.
void add_force_tangent(const PointKinematics& point, const KinematicVariations& vary, const Vector3d& force,
                       const PairVariation<3>& dforce, MatrixXd& tangent) {
  const Index first = point.primary_nodes();
  const PairVector h = point.jump_weights();
  for (Index column = 0; column < dforce.cols(); ++column) {
    const Vector3d with_force = dforce.col(column);
    const auto add = [&](Index node, double dh) {
      tangent.col(column).segment<3>(3 * node) += h[node] * with_force + dh * force;
    };
    for (Index a = 0; a < first; ++a) add(a, point.primary_gradient.row(a).dot(vary.xi.col(column)));
    for (Index b = 0; first + b < h.size(); ++b)
      add(first + b, -point.secondary_gradient.row(b).dot(vary.eta.col(column)));
  }
}

/// Derivative of the weights h of one node with the nodal positions.
PairVariation<1> weight_variation(const PointKinematics& point, const KinematicVariations& vary, Index node) {
  const Index first = point.primary_nodes();
  if (node < first) return point.primary_gradient.row(node).lazyProduct(vary.xi);
  return -point.secondary_gradient.row(node - first).lazyProduct(vary.eta);
}

/// The force of friction on the primary side, w |a| t_T.
Vector3d friction_force(const PointKinematics& point, const PointLoads& loads) {
  return loads.weight * point.area * loads.friction;
}

void add_friction_force_variation(const PointKinematics& point, const KinematicVariations& vary,
                                  const PointLoads& loads, PairVariation<3>& dforce) {
  // d[w |a| t_T] = w [ t_T (d|a| + |a| dw/w) + |a| t_T,alpha dxi_alpha ]
  const Vector3d with_area = loads.weight * loads.friction;
  const Eigen::Matrix<double, 3, 2> with_xi = loads.weight * point.area * loads.friction_slope;
  const bool varies = !loads.friction_slope.isZero(0);
  for (Index column = 0; column < dforce.cols(); ++column) {
    const double darea = vary.area[column] + point.area * vary.weight[column];
    Vector3d change = darea * with_area;
    if (varies) change += with_xi.lazyProduct(vary.xi.col(column));
    dforce.col(column) += change;
  }
}

}  // namespace

void add_residual(const PointKinematics& point, const PointLoads& loads, const LocalLayout& layout,
                  VectorXd& residual) {
  const PairVector h = point.jump_weights();
  Vector3d force = loads.weight * loads.traction.value * point.area_vector;  // t1 da1
  if (loads.has_friction()) force += friction_force(point, loads);
  const double flux_weight = loads.weight * loads.time_increment * point.area;  // dt da1
  for (Index node = 0; node < layout.nodes(); ++node) {
    residual.segment<3>(layout.displacement(node, 0)) += h[node] * force;
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      residual[layout.scalar(node, k)] += flux_weight * loads.flux[k].value * h[node];
    }
  }
}

void add_traction_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                          MatrixXd& tangent) {
  // d[w t_n h_a a] = w [ h_a ((dt_n + t_n dw/w) a + t_n da) + t_n a dh_a ],  dt_n = t_n' dg + t_n,alpha dxi_alpha
  const PairVariation<1> dtn = loads.traction.derivative * vary.gap + loads.traction_slope.transpose() * vary.xi +
                               loads.traction.value * vary.weight;
  PairVariation<3> dforce = loads.weight *
                            (point.area_vector.lazyProduct(dtn) + loads.traction.value * vary.area_vector);
  Vector3d force = loads.weight * loads.traction.value * point.area_vector;
  if (loads.has_friction()) {
    add_friction_force_variation(point, vary, loads, dforce);
    force += friction_force(point, loads);
  }
  add_force_tangent(point, vary, force, dforce, tangent);
}

void add_flux_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads, Index k,
                      const PairVector& values, const LocalLayout& layout, MatrixXd& tangent) {
  // d[w dt |a| q h_a] = w dt [ h_a (q (d|a| + |a| dw/w) + |a| dq) + |a| q dh_a ],  dq = q' djump + q,alpha dxi_alpha
  const PairVector h = point.jump_weights();
  const LawValue& flux = loads.flux[k];
  const double weight = loads.weight * loads.time_increment;
  PairVariation<1> dq = flux.derivative * jump_variation(point, vary, values) + flux.value * vary.weight;
  if (loads.flux_slope.rows() > 0) dq += loads.flux_slope.row(k) * vary.xi;
  const PairVariation<1> dflux = weight * (flux.value * vary.area + point.area * dq);
  for (Index node = 0; node < layout.nodes(); ++node) {
    const PairVariation<1> moved = h[node] * dflux +
                                   weight * point.area * flux.value * weight_variation(point, vary, node);
    for (Index column = 0; column < layout.nodes(); ++column) {
      tangent.block<1, 3>(node, layout.displacement(column, 0)) += moved.segment<3>(3 * column);
      tangent(node, layout.scalar(column, 0)) += weight * point.area * flux.derivative * h[column] * h[node];
    }
  }
}

PairVariation<1> jump_variation(const PointKinematics& point, const KinematicVariations& vary,
                                const PairVector& values) {
  const Eigen::RowVector2d one = values.head(point.primary_nodes()).transpose() * point.primary_gradient;
  const Eigen::RowVector2d two = values.tail(point.secondary_shape.size()).transpose() * point.secondary_gradient;
  return one.lazyProduct(vary.xi) - two.lazyProduct(vary.eta);
}

}  // namespace mixture_contact
