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

/// Derivative of the secondary nodes' weights -N2_b(eta) with the nodal positions; rows of primary nodes are zero.
Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weight_variation(
    const PointKinematics& point, const KinematicVariations& vary) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
      rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>::Zero(point.nodes(),
                                                                                          3 * point.nodes());
  rows.bottomRows(point.secondary_shape.size()) = -point.secondary_gradient * vary.eta;
  return rows;
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

MatrixXd point_tangent(const PointKinematics& point, const PointLoads& loads, const PairFields& fields,
                       const LocalLayout& layout) {
  const KinematicVariations vary = kinematic_variations(point);
  const PairVector h = point.jump_weights();
  const auto dh = weight_variation(point, vary);
  const Index n2 = layout.nodes() - layout.primary_nodes();
  MatrixXd tangent = MatrixXd::Zero(layout.size(), layout.size());

  // d[w t_n h_a a] = w [ h_a (t_n' a dg + t_n da) + t_n a dh_a ]
  const PairVariation<3> dtraction = loads.weight * (loads.traction.derivative * point.area_vector * vary.gap +
                                                     loads.traction.value * vary.area_vector);
  const Vector3d traction = loads.weight * loads.traction.value * point.area_vector;
  for (Index node = 0; node < layout.nodes(); ++node) {
    add_displacement_row(tangent, layout, node, h[node] * dtraction + traction * dh.row(node));
  }

  // d[w dt |a| q h_a] = w dt [ h_a (q d|a| + |a| q' djump) + |a| q dh_a ],  djump = h.dphi - phi2,beta deta_beta
  const double weight = loads.weight * loads.time_increment;
  for (Index k = 0; k < layout.scalar_fields(); ++k) {
    const LawValue& flux = loads.flux[k];
    if (flux.value == 0.0 && flux.derivative == 0.0) continue;
    const Eigen::RowVector2d slope = fields.col(k).tail(n2).transpose() * point.secondary_gradient;
    const PairVariation<1> dflux = weight *
                                   (flux.value * vary.area - point.area * flux.derivative * (slope * vary.eta));
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

WeightedVariation gap_variation(const PointKinematics& point, const KinematicVariations& vary, double weight) {
  return {weight * (point.area * vary.gap + point.gap * vary.area), weight * vary.area};
}

WeightedVariation jump_variation(const PointKinematics& point, const KinematicVariations& vary, double weight,
                                 const PairVector& values) {
  const Eigen::RowVector2d slope = values.tail(point.secondary_shape.size()).transpose() * point.secondary_gradient;
  const double jump = point.jump_weights().dot(values);
  return {weight * (jump * vary.area - point.area * (slope * vary.eta)), weight * vary.area};
}

MatrixXd symmetric_part(const MatrixXd& tangent, const LocalLayout& layout) {
  MatrixXd symmetric = 0.5 * (tangent + tangent.transpose());
  for (Index node = 0; node < layout.nodes(); ++node) {
    for (Index column = 0; column < layout.nodes(); ++column) {
      for (Index k = 0; k < layout.scalar_fields(); ++k) {
        symmetric.block<1, 3>(layout.scalar(node, k), layout.displacement(column, 0)).setZero();
        symmetric.block<3, 1>(layout.displacement(column, 0), layout.scalar(node, k)).setZero();
      }
    }
  }
  return symmetric;
}

}  // namespace mixture_contact
