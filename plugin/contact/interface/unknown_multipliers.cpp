/// Multipliers as unknowns of the Newton solve: their equations, a part of ContactPass.
#include "interface/pass.h"

#include <cmath>

namespace mixture_contact {
namespace {

/// A node's value; where it is zero (sealed facets around it), any of the surface's that is not.
double unit_of(const Eigen::Ref<const VectorXd>& values, Index node) {
  if (values[node] > 0) return values[node];
  const double largest = values.maxCoeff();
  return largest > 0 ? largest : 1.0;
}

}  // namespace

double ContactPass::traction_unit(Index node) const { return unit_of(penalties_.stiffness, node); }

double ContactPass::flux_unit(int field, Index node) const {
  return unit_of(penalties_.conductance.row(field).transpose(), node);
}

VectorXd ContactPass::unknown_multipliers() const {
  const MultiplierLayout layout = multiplier_layout();
  VectorXd mu(layout.size());
  for (Index node = 0; node < primary_.nodes; ++node) {
    if (effects_.traction) mu[layout.traction(node)] = multipliers.traction[node] / traction_unit(node);
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      mu[layout.flux(node, k)] = multipliers.flux(k, node) / flux_unit(k, node);
    }
  }
  return mu;
}

void ContactPass::set_unknown_multipliers(const VectorXd& mu) {
  const MultiplierLayout layout = multiplier_layout();
  for (Index node = 0; node < primary_.nodes; ++node) {
    if (effects_.traction) multipliers.traction[node] = mu[layout.traction(node)] * traction_unit(node);
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      multipliers.flux(k, node) = mu[layout.flux(node, k)] * flux_unit(k, node);
    }
  }
}

VectorXd ContactPass::multiplier_weights(const NodalLoads& loads, const Matrix3Xd& x1) const {
  // Row k A dg_a against column k T_a, with A dg_a = -T_a.dx where the surfaces are flat, and A djump_a = F_a.dphi:
  // the sign of the traction's weight makes the two alike.
  const MultiplierLayout layout = multiplier_layout();
  const VectorXd whole = nodal_areas(primary_, x1);
  VectorXd weights(layout.size());
  for (Index node = 0; node < primary_.nodes; ++node) {
    const bool in_contact = loads.in_contact[static_cast<std::size_t>(node)];
    if (effects_.traction)
      weights[layout.traction(node)] = -traction_unit(node) * (in_contact ? loads.area[node] : whole[node]);
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      const double area = passes(loads, k, node) ? loads.flux_area(k, node) : whole[node];
      weights[layout.flux(node, k)] = flux_unit(k, node) * area;
    }
  }
  return weights;
}

VectorXd ContactPass::present_multiplier_weights(const NodalLoads& loads, const Matrix3Xd& x1) const {
  if (!has_unknown_multipliers()) return {};
  return held_ ? held_->multiplier_weights : multiplier_weights(loads, x1);
}

ConditionValue ContactPass::traction_condition(Index node, const NodalLoads& loads) const {
  const double mu = multipliers.traction[node] / traction_unit(node);
  return multiplier_condition(loads.in_contact[static_cast<std::size_t>(node)], mu, loads.gap[node]);
}

ConditionValue ContactPass::flux_condition(int field, Index node, const NodalLoads& loads) const {
  const double mu = multipliers.flux(field, node) / flux_unit(field, node);
  return multiplier_condition(passes(loads, field, node), mu, loads.jump(field, node));
}

VectorXd ContactPass::multiplier_residual(Index node, const NodalLoads& loads, const VectorXd& weights,
                                          double dt) const {
  const MultiplierLayout all = multiplier_layout();
  const LocalLayout layout = node_patch(node, {}).layout();
  VectorXd residual = VectorXd::Zero(layout.size());
  if (effects_.traction)
    residual[layout.traction_multiplier()] = weights[all.traction(node)] * traction_condition(node, loads).value;
  for (int k = 0; k < effects_.scalar_fields(); ++k) {
    residual[layout.flux_multiplier(k)] = dt * weights[all.flux(node, k)] * flux_condition(k, node, loads).value;
  }
  return residual;
}

TangentBlock ContactPass::traction_multiplier_tangent(Index node, const NodeLinearisation& linear,
                                                      const NodalLoads& loads, const VectorXd& weights) const {
  // The residual holds lambda_a traction_work, with lambda = k mu, and the condition.
  const LocalLayout layout = linear.patch.of_displacements().layout();
  const Index own = layout.traction_multiplier();
  const double weight = weights[multiplier_layout().traction(node)];
  const ConditionValue condition = traction_condition(node, loads);
  MatrixXd tangent = MatrixXd::Zero(layout.size(), layout.size());
  if (loads.in_contact[static_cast<std::size_t>(node)]) {
    tangent.row(own) = weight * condition.with_gap * linear.gap_variation.transpose();
    tangent.col(own) = traction_unit(node) * linear.traction_work;
  }
  tangent(own, own) += weight * condition.with_multiplier;
  return traction_block(linear.patch, std::move(tangent));
}

TangentBlock ContactPass::flux_multiplier_tangent(int field, Index node, const NodeLinearisation& linear,
                                                  const NodalLoads& loads, const VectorXd& weights, double dt) const {
  // The residual holds dt lambda_k A_a weights, with lambda = k mu, and the condition.
  const Patch rows = linear.patch.of_field(field, false);
  const Patch columns = field_columns(linear.patch, field);
  const Index own = rows.layout().flux_multiplier(0);
  const Index with = columns.layout().flux_multiplier(0);
  const double weight = dt * weights[multiplier_layout().flux(node, field)];
  const ConditionValue condition = flux_condition(field, node, loads);
  const NodeLinearisation::Jump& jump = linear.jumps[static_cast<std::size_t>(field)];
  MatrixXd tangent = MatrixXd::Zero(rows.layout().size(), columns.layout().size());
  if (passes(loads, field, node)) {
    tangent.row(own) = weight * condition.with_gap * jump_row(jump, columns).transpose();
    tangent.col(with) = dt * flux_unit(field, node) * loads.flux_area(field, node) * jump.weights;
  }
  tangent(own, with) += weight * condition.with_multiplier;
  return {rows, columns, tangent};
}

std::vector<TangentBlock> ContactPass::multiplier_tangent(Index node, const NodeLinearisation& linear,
                                                          const NodalLoads& loads, const VectorXd& weights,
                                                          double dt) const {
  std::vector<TangentBlock> blocks;
  if (effects_.traction) blocks.push_back(traction_multiplier_tangent(node, linear, loads, weights));
  for (int field = 0; field < effects_.scalar_fields(); ++field) {
    blocks.push_back(flux_multiplier_tangent(field, node, linear, loads, weights, dt));
  }
  return blocks;
}

}  // namespace mixture_contact
