#include "law/point_integral.h"

namespace mixture_contact {
namespace {

/// One row per node of a pair, variations with the nodal positions, shape (n1 + n2, 3 (n1 + n2)).
using PairRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, max_pair_nodes,
                               max_pair_displacements>;

/// Derivative of the weights h = (N1(xi), -N2(eta)) with the nodal positions.
PairRows weight_variation(const PointKinematics& point, const KinematicVariations& vary) {
  PairRows rows(point.nodes(), 3 * point.nodes());
  // Small products: Eigen's kernels for large ones would cost more than they save.
  rows.topRows(point.primary_nodes()) = point.primary_gradient.lazyProduct(vary.xi);
  rows.bottomRows(point.secondary_shape.size()) = -point.secondary_gradient.lazyProduct(vary.eta);
  return rows;
}

/// Derivative of a jump h.phi with the nodal positions, phi1,alpha dxi_alpha - phi2,beta deta_beta.
PairVariation<1> jump_projection_variation(const PointKinematics& point, const KinematicVariations& vary,
                                           const PairVector& values) {
  const Eigen::RowVector2d one = values.head(point.primary_nodes()).transpose() * point.primary_gradient;
  const Eigen::RowVector2d two = values.tail(point.secondary_shape.size()).transpose() * point.secondary_gradient;
  return one * vary.xi - two * vary.eta;
}

/// The force of friction on the primary side, w |a| t_T.
Vector3d friction_force(const PointKinematics& point, const PointLoads& loads) {
  return loads.weight * point.area * loads.friction;
}

PairVariation<3> friction_force_variation(const PointKinematics& point, const KinematicVariations& vary,
                                          const PointLoads& loads) {
  // d[w |a| t_T] = w [ t_T (d|a| + |a| dw/w) + |a| t_T,alpha dxi_alpha ]
  const PairVariation<1> darea = vary.area + point.area * vary.weight;
  const Eigen::Matrix<double, 3, 2> slope = point.area * loads.friction_slope;
  return loads.weight * (loads.friction.lazyProduct(darea) + slope.lazyProduct(vary.xi));
}

}  // namespace

VectorXd point_residual(const PointKinematics& point, const PointLoads& loads, const LocalLayout& layout) {
  const PairVector h = point.jump_weights();
  const Vector3d traction = loads.weight * loads.traction.value * point.area_vector;  // t1 da1
  const double flux_weight = loads.weight * loads.time_increment * point.area;        // dt da1
  VectorXd residual(layout.size());
  for (Index node = 0; node < layout.nodes(); ++node) {
    residual.segment<3>(layout.displacement(node, 0)) = h[node] * traction;
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      residual[layout.scalar(node, k)] = flux_weight * loads.flux[k].value * h[node];
    }
  }
  return residual;
}

MatrixXd traction_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                          const LocalLayout& layout) {
  // d[w t_n h_a a] = w [ h_a ((dt_n + t_n dw/w) a + t_n da) + t_n a dh_a ],  dt_n = t_n' dg + t_n,alpha dxi_alpha
  const PairVector h = point.jump_weights();
  const PairRows dh = weight_variation(point, vary);
  const PairVariation<1> dtn = loads.traction.derivative * vary.gap + loads.traction_slope.transpose() * vary.xi +
                               loads.traction.value * vary.weight;
  PairVariation<3> dforce = loads.weight * (point.area_vector * dtn + loads.traction.value * vary.area_vector);
  Vector3d force = loads.weight * loads.traction.value * point.area_vector;
  if (loads.has_friction()) {
    dforce += friction_force_variation(point, vary, loads);
    force += friction_force(point, loads);
  }
  MatrixXd tangent(layout.size(), layout.size());
  for (Index node = 0; node < layout.nodes(); ++node) {
    tangent.middleRows<3>(layout.displacement(node, 0)) = h[node] * dforce + force * dh.row(node);
  }
  return tangent;
}

void add_friction(const PointKinematics& point, const PointLoads& loads, const LocalLayout& layout,
                  VectorXd& residual) {
  const PairVector h = point.jump_weights();
  const Vector3d force = friction_force(point, loads);
  for (Index node = 0; node < layout.nodes(); ++node)
    residual.segment<3>(layout.displacement(node, 0)) += h[node] * force;
}

MatrixXd flux_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads, Index k,
                      const PairVector& values, const LocalLayout& layout) {
  // d[w dt |a| q h_a] = w dt [ h_a (q (d|a| + |a| dw/w) + |a| dq) + |a| q dh_a ],  dq = q' djump + q,alpha dxi_alpha
  const PairVector h = point.jump_weights();
  const LawValue& flux = loads.flux[k];
  const double weight = loads.weight * loads.time_increment;
  PairVariation<1> dq = flux.derivative * jump_projection_variation(point, vary, values) + flux.value * vary.weight;
  if (loads.flux_slope.rows() > 0) dq += loads.flux_slope.row(k) * vary.xi;
  const PairVariation<1> dflux = weight * (flux.value * vary.area + point.area * dq);
  const PairRows with_motion = h * dflux + weight * point.area * flux.value * weight_variation(point, vary);
  MatrixXd tangent(layout.nodes(), layout.size());
  for (Index column = 0; column < layout.nodes(); ++column) {
    tangent.middleCols<3>(layout.displacement(column, 0)) = with_motion.middleCols<3>(3 * column);
    tangent.col(layout.scalar(column, 0)) = weight * point.area * flux.derivative * h[column] * h;
  }
  return tangent;
}

WeightedVariation gap_variation(const PointKinematics& point, const KinematicVariations& vary,
                                const PointShare& share) {
  const PairVariation<1> area = share.value * vary.area + point.area * share.variation;
  return {share.value * point.area * vary.gap + point.gap * area, area};
}

WeightedVariation jump_variation(const PointKinematics& point, const KinematicVariations& vary, const PointShare& share,
                                 const PairVector& values) {
  const PairVariation<1> area = share.value * vary.area + point.area * share.variation;
  const double jump = point.jump_weights().dot(values);
  return {share.value * point.area * jump_projection_variation(point, vary, values) + jump * area, area};
}

}  // namespace mixture_contact
