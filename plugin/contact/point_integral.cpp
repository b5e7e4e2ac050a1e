#include "point_integral.h"

namespace mixture_contact {
namespace {

/// Adds a 3-row block (rows: a node's displacement) given with three columns per node.
void add_displacement_row(MatrixXd& tangent, const LocalLayout& layout, Index node, const PairVariation<3>& row) {
  for (Index column = 0; column < layout.nodes(); ++column) {
    tangent.block<3, 3>(layout.displacement(node, 0), layout.displacement(column, 0)) += row.middleCols<3>(3 * column);
  }
}

/// Adds a row of a scalar field's equation given with three columns per node.
void add_field_row(MatrixXd& tangent, const LocalLayout& layout, Index node, Index field, const PairVariation<1>& row) {
  for (Index column = 0; column < layout.nodes(); ++column) {
    tangent.block<1, 3>(layout.scalar(node, field), layout.displacement(column, 0)) += row.segment<3>(3 * column);
  }
}

/// Derivative of the weights h = (N1(xi), -N2(eta)) with the nodal positions.
Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weight_variation(
    const PointKinematics& point, const KinematicVariations& vary) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(point.nodes(), 3 * point.nodes());
  rows << point.primary_gradient * vary.xi, -point.secondary_gradient * vary.eta;
  return rows;
}

/// Derivative of a jump h.phi with the nodal positions, phi1,alpha dxi_alpha - phi2,beta deta_beta.
PairVariation<1> jump_drift(const PointKinematics& point, const KinematicVariations& vary, const PairVector& values) {
  const Eigen::RowVector2d one = values.head(point.primary_nodes()).transpose() * point.primary_gradient;
  const Eigen::RowVector2d two = values.tail(point.secondary_shape.size()).transpose() * point.secondary_gradient;
  return one * vary.xi - two * vary.eta;
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

MatrixXd point_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                       const PairFields& fields, const LocalLayout& layout) {
  const PairVector h = point.jump_weights();
  const auto dh = weight_variation(point, vary);
  MatrixXd tangent = MatrixXd::Zero(layout.size(), layout.size());

  // d[w t_n h_a a] = w [ h_a ((dt_n + t_n dw/w) a + t_n da) + t_n a dh_a ],  dt_n = t_n' dg + t_n,alpha dxi_alpha
  const PairVariation<1> dtn = loads.traction.derivative * vary.gap + loads.traction_slope.transpose() * vary.xi +
                               loads.traction.value * vary.weight;
  const PairVariation<3> dtraction = loads.weight * (point.area_vector * dtn + loads.traction.value * vary.area_vector);
  const Vector3d traction = loads.weight * loads.traction.value * point.area_vector;
  for (Index node = 0; node < layout.nodes(); ++node) {
    add_displacement_row(tangent, layout, node, h[node] * dtraction + traction * dh.row(node));
  }

  // d[w dt |a| q h_a] = w dt [ h_a (q (d|a| + |a| dw/w) + |a| dq) + |a| q dh_a ],  dq = q' djump + q,alpha dxi_alpha
  const double weight = loads.weight * loads.time_increment;
  for (Index k = 0; k < layout.scalar_fields(); ++k) {
    const LawValue& flux = loads.flux[k];
    const bool drifts = loads.flux_slope.rows() > 0 && loads.flux_slope.row(k).any();
    if (flux.value == 0.0 && flux.derivative == 0.0 && !drifts) continue;
    PairVariation<1> dq = flux.derivative * jump_drift(point, vary, fields.col(k)) + flux.value * vary.weight;
    if (drifts) dq += loads.flux_slope.row(k) * vary.xi;
    const PairVariation<1> dflux = weight * (flux.value * vary.area + point.area * dq);
    for (Index node = 0; node < layout.nodes(); ++node) {
      add_field_row(tangent, layout, node, k, h[node] * dflux + weight * point.area * flux.value * dh.row(node));
      for (Index column = 0; column < layout.nodes(); ++column) {
        tangent(layout.scalar(node, k), layout.scalar(column, k)) = weight * point.area * flux.derivative * h[node] *
                                                                    h[column];
      }
    }
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
  return {share.value * point.area * jump_drift(point, vary, values) + jump * area, area};
}

MatrixXd symmetric_part(const MatrixXd& tangent, const LocalLayout& layout) {
  MatrixXd symmetric = 0.5 * (tangent + tangent.transpose());
  for (Index node = 0; node < layout.blocks(); ++node) {
    for (Index column = 0; column < layout.blocks(); ++column) {
      for (Index k = 0; k < layout.scalar_fields(); ++k) {
        symmetric.block<1, 3>(layout.scalar(node, k), layout.displacement(column, 0)).setZero();
        symmetric.block<3, 1>(layout.displacement(column, 0), layout.scalar(node, k)).setZero();
      }
    }
  }
  return symmetric;
}

}  // namespace mixture_contact
